#ifndef snug_cad_near_faces_h
#define snug_cad_near_faces_h

#include <snug/cad/part.h>

#include <array>

namespace snug::cad {
/// Two faces of different parts that touch or almost touch.
struct NearFaces
{
  std::array<unsigned int, 2> parts = {}, faces = {}; ///< indices
  /// of those samples of one of the faces that are near the other one [length^2]; 0 if the faces
  /// are near each other at a point or along a line
  double area = 0.;
  double gap  = 0.; ///< smallest gap, negative if the parts overlap [length]
};

/// Return the distance up to which faces are near: 1 % of the diagonal of the smaller part.
double near_limit(const Part &a, const Part &b);

/// Return the pairs of faces that are near each other, and whose outward normals are opposite up to
/// 45 degrees there. About 24 by 24 samples of each face are projected on the other face.
std::vector<NearFaces> near_faces(const std::vector<Part> &parts);
} // namespace snug::cad

#endif
