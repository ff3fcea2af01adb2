#ifndef snug_io_shape_export_h
#define snug_io_shape_export_h

#include <snug/mesh/surface.h>
#include <snug/shape/shapes.h>

#include <string>
#include <vector>

namespace snug::io {
/**
 * Return the surface at the positions @p positions of its nodes [length] as text. In 3D the text
 * is ASCII STL named @p name. It has 2 p^2 triangles for every face of degree p, with normals out
 * of the body. In 2D it is a CSV polyline x,y with the body on its left. An empty line separates
 * the pieces.
 */
template <int dim>
std::string surface_text(const mesh::Surface<dim>                 &surface,
                         const typename mesh::Surface<dim>::Field &positions,
                         const std::string                        &name);

/**
 * Write surface_text() to the file @p stem with ".stl" (3D) or ".csv" (2D). The last part of
 * @p stem is the name of the solid. For one rank.
 * @throws std::runtime_error if the file cannot be written.
 */
template <int dim>
void write_surface(const std::string                        &stem,
                   const mesh::Surface<dim>                 &surface,
                   const typename mesh::Surface<dim>::Field &positions);

/**
 * Write the control points as CSV. The columns are shape, index, x, y, z (3D), dx, dy, dz
 * (displacements of the control point), variables (entries of the design with their signs), and
 * body_x, body_y, body_z (point of the body at the control point) [length]. For one rank.
 * @throws std::runtime_error if the file cannot be written.
 */
template <int dim>
void write_control_points(const std::string                         &path,
                          const std::vector<shape::MovedPoint<dim>> &points);
} // namespace snug::io

#endif
