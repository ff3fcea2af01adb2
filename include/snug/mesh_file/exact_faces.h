#ifndef snug_mesh_file_exact_faces_h
#define snug_mesh_file_exact_faces_h

#include <snug/geometry/known_surface.h>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace snug::mesh_file {
/**
 * The faces of a body, in 2D its edges, whose surfaces are known exactly, as those of a CAD part.
 * A mesh of second order has all nodes of the boundary on these faces.
 */
template <int dim>
struct ExactFaces
{
  using Point      = dealii::Point<dim>;
  using Vector     = dealii::Tensor<1, dim>;
  using Projection = std::shared_ptr<const geometry::Projection<dim>>;

  /// The first member that is set is the surface of the face.
  struct Face
  {
    std::optional<Vector>                      plane; ///< unit normal, with any sign
    std::optional<geometry::KnownSurface<dim>> known; ///< with any orientation
    Projection                                 projection = {};
  };

  std::vector<Face> faces;
  /// all projections that faces and curves have, in the order of their numbers
  std::vector<std::shared_ptr<geometry::PartProjection<dim>>> projections;
  /// group of elements of the mesh file -> index of its face
  std::map<std::string, unsigned int> face_of_group;
  /// function that returns the curve between two faces that is closest to a point; null if there is
  /// none
  std::function<Projection(unsigned int, unsigned int, const Point &)> curve;
};
} // namespace snug::mesh_file

#endif
