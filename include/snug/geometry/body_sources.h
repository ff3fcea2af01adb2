#ifndef snug_geometry_body_sources_h
#define snug_geometry_body_sources_h

#include <snug/geometry/body_geometry.h>

namespace snug::geometry {
/// @name The bodies of each Source
/// @{

/// Make a box. Faces are left, right (x), bottom, top (y) in 2D; left, right (x), front,
/// back (y), bottom, top (z) in 3D.
template <int dim>
std::unique_ptr<BodyGeometry<dim>> make_box(const BodyMeshParameters &parameters);

/**
 * Make a ring between two circles about the origin in 2D, a hollow cylinder along z in 3D.
 * Faces are inner and outer. A half or a quarter also has start (at angle 0) and end, and 3D
 * bodies also have bottom and top.
 */
template <int dim>
std::unique_ptr<BodyGeometry<dim>> make_ring(const BodyMeshParameters &parameters);

/**
 * Make a disc about the origin in 2D. A half is the part y > 0, a quarter the part
 * x, y > 0. Faces are outer, bottom (y = 0), left (x = 0).
 */
std::unique_ptr<BodyGeometry<2>> make_disc(const BodyMeshParameters &parameters);

/// Make a disc extruded from z = 0 to the length. Faces are outer, bottom, top
/// (z), front (y = 0), left (x = 0).
std::unique_ptr<BodyGeometry<3>> make_cylinder(const BodyMeshParameters &parameters);

/**
 * Make a ball about the origin. A half is the part z > 0, a quarter the part y, z >
 * 0, an eighth the part x, y, z > 0. Faces are outer, bottom (z = 0), front (y =
 * 0), left (x = 0).
 */
std::unique_ptr<BodyGeometry<3>> make_sphere(const BodyMeshParameters &parameters);

/// Make a ball with a concentric hole. The face of the hole is called inner.
std::unique_ptr<BodyGeometry<3>> make_shell(const BodyMeshParameters &parameters);

/// Make the body of a mesh file, with the names of faces from the file.
template <int dim>
std::unique_ptr<BodyGeometry<dim>> make_imported(const BodyMeshParameters &parameters);
/// @}
} // namespace snug::geometry

#endif
