#ifndef snug_io_shape_export_h
#define snug_io_shape_export_h

#include <snug/mesh/surface.h>
#include <snug/shape/shapes.h>

#include <string>
#include <vector>

namespace snug::io {
/**
 * The surface at @p positions of its nodes [length] as text: in 3D ASCII
 * STL named @p name, every face of degree p as 2 p^2 triangles with normals
 * out of the body; in 2D a CSV polyline x,y with the body on its left,
 * separate pieces set apart by an empty line.
 */
template <int dim>
std::string surface_text(const mesh::Surface<dim>                 &surface,
                         const typename mesh::Surface<dim>::Field &positions,
                         const std::string                        &name);

/**
 * Write surface_text() to the file @p stem with ".stl" (3D) or ".csv" (2D);
 * its last part is the name of the solid. For one rank.
 * @throws std::runtime_error if it cannot be written.
 */
template <int dim>
void write_surface(const std::string                        &stem,
                   const mesh::Surface<dim>                 &surface,
                   const typename mesh::Surface<dim>::Field &positions);

/**
 * Write the control points as CSV with columns shape, index, x, y, z (3D),
 * dx, dy, dz, how far they moved, variables, entries of the design with their
 * signs, and body_x, body_y, body_z, the point of the body there [length]. For
 * one rank.
 * @throws std::runtime_error if it cannot be written.
 */
template <int dim>
void write_control_points(const std::string                         &path,
                          const std::vector<shape::MovedPoint<dim>> &points);
} // namespace snug::io

#endif
