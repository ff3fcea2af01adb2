#ifndef snug_geometry_placement_h
#define snug_geometry_placement_h

#include <snug/geometry/body_geometry.h>

namespace snug::geometry {
/**
 * @p geometry, warped, scaled, rotated and shifted:
 * @f[ x' = Q\, s\, (x + w(x)) + t. @f]
 * The geometry itself if its parameters say nothing of the kind.
 * @throws InputError naming Warp, Scale, Rotate or Shift.
 */
template <int dim>
std::unique_ptr<BodyGeometry<dim>> placed(std::unique_ptr<BodyGeometry<dim>> geometry,
                                          const BodyMeshParameters          &parameters);
} // namespace snug::geometry

#endif
