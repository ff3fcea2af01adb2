#ifndef snug_mesh_file_face_gaps_h
#define snug_mesh_file_face_gaps_h

#include <deal.II/base/point.h>

#include <set>
#include <vector>

namespace snug::mesh_file {
/// Outer faces of a body, with corners in the order of faces_of(), as indices of points.
using Faces = std::vector<std::vector<unsigned int>>;

/// The distances of the corners of faces from the nearest faces that face them.
struct FaceGaps
{
  std::set<unsigned int> faces;   ///< indices of faces with a corner within reach
  double                 least;   ///< least and largest distance within reach; negative inside of
  double                 largest; ///< the other body [length]
  bool                   is_whole = true; ///< whether all corners are within reach
};

/**
 * Return the gaps of the faces @p of from the faces @p from. Faces face each other if their normals
 * are more than 120 degrees apart, and a corner is within reach if its distance is at most @p reach
 * and at most 45 degrees from the normal. Quadrilaterals count as two triangles.
 */
FaceGaps face_gaps(const std::vector<dealii::Point<3>> &points,
                   const Faces                         &of,
                   const Faces                         &from,
                   double                               reach);

/// Return the mean length of the edges of faces.
double mean_size(const std::vector<dealii::Point<3>> &points, const Faces &faces);
} // namespace snug::mesh_file

#endif
