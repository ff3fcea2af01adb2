#ifndef snug_mesh_placement_h
#define snug_mesh_placement_h

#include <snug/mesh/body_geometry.h>

namespace snug::mesh {
/**
 * @p geometry, warped, scaled, rotated and shifted:
 * @f[ x' = Q\, s\, (x + w(x)) + t. @f]
 * The geometry itself if its parameters say nothing of the kind.
 * @throws InputError naming Warp, Scale, Rotate or Shift.
 */
template <int dim>
std::unique_ptr<BodyGeometry<dim>> placed(std::unique_ptr<BodyGeometry<dim>> geometry,
                                          const BodyMeshParameters          &parameters);
} // namespace snug::mesh

#endif
