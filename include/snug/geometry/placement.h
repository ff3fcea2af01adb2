#ifndef snug_geometry_placement_h
#define snug_geometry_placement_h

#include <snug/geometry/body_geometry.h>

namespace snug::geometry {
/// Return the rotation Q of the entry Rotate. @throws InputError
template <int dim>
dealii::Tensor<2, dim> rotation_of(const BodyMeshParameters &parameters);

/**
 * Return @p geometry, warped, scaled, rotated and shifted:
 * @f[ x' = Q\, s\, (x + w(x)) + t. @f]
 * Return @p geometry itself if the parameters have no placement.
 * @throws InputError naming Warp, Scale, Rotate or Shift.
 */
template <int dim>
std::unique_ptr<BodyGeometry<dim>> placed(std::unique_ptr<BodyGeometry<dim>> geometry,
                                          const BodyMeshParameters          &parameters);
} // namespace snug::geometry

#endif
