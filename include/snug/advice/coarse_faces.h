#ifndef snug_advice_coarse_faces_h
#define snug_advice_coarse_faces_h

#include <snug/geometry/body_geometry.h>

namespace snug::advice {
/// A boundary face of a coarse mesh.
struct CoarseFace
{
  unsigned int cell;
  unsigned int face; ///< 2d + s: coordinate d of the cell is s
  unsigned int boundary;
};

/// All boundary faces, in the order of the mesh.
template <int dim>
std::vector<CoarseFace>
coarse_faces(const typename geometry::BodyGeometry<dim>::CoarseMesh &coarse);
} // namespace snug::advice

#endif
