#ifndef snug_geometry_body_sources_h
#define snug_geometry_body_sources_h

#include <snug/geometry/body_geometry.h>

namespace snug::geometry {
/// @name The bodies of each Source
/// @{

/// Faces left, right (x), bottom, top (y) in 2D; left, right (x), front,
/// back (y), bottom, top (z) in 3D.
template <int dim>
std::unique_ptr<BodyGeometry<dim>> make_box(const BodyMeshParameters &parameters);

/**
 * 2D: ring of two circles about the origin; 3D: hollow cylinder along z.
 * Faces inner, outer; of a half or a quarter start (at angle 0) and end;
 * in 3D bottom and top.
 */
template <int dim>
std::unique_ptr<BodyGeometry<dim>> make_ring(const BodyMeshParameters &parameters);

/**
 * 2D: disc about the origin, a half of it where y > 0, a quarter where
 * x, y > 0. Faces outer, bottom (y = 0), left (x = 0).
 */
std::unique_ptr<BodyGeometry<2>> make_disc(const BodyMeshParameters &parameters);

/// A disc extruded from z = 0 to the length. Faces outer, bottom, top
/// (z), front (y = 0), left (x = 0).
std::unique_ptr<BodyGeometry<3>> make_cylinder(const BodyMeshParameters &parameters);

/**
 * Ball about the origin, a half of it where z > 0, a quarter where y, z >
 * 0, an eighth where x, y, z > 0. Faces outer, bottom (z = 0), front (y =
 * 0), left (x = 0).
 */
std::unique_ptr<BodyGeometry<3>> make_sphere(const BodyMeshParameters &parameters);

/// A sphere with a concentric hole, its face called inner.
std::unique_ptr<BodyGeometry<3>> make_shell(const BodyMeshParameters &parameters);

/// The mesh of a file, faces as they are named there.
template <int dim>
std::unique_ptr<BodyGeometry<dim>> make_imported(const BodyMeshParameters &parameters);
/// @}
} // namespace snug::geometry

#endif
