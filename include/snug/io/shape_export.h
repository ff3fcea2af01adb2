#ifndef snug_io_shape_export_h
#define snug_io_shape_export_h

#include <snug/mesh/surface.h>
#include <snug/shape/shapes.h>

#include <string>
#include <vector>

namespace snug::io {
/**
 * Write the surface at the positions @p positions of its nodes [length] to the file @p path as
 * ASCII STL. The name of the solid is that of the file without its suffix. A face of degree p has
 * 2 p^2 triangles, with normals out of the body. For one rank.
 * @throws std::runtime_error if the file cannot be written.
 */
void write_surface(const std::string             &path,
                   const mesh::Surface<3>        &surface,
                   const mesh::Surface<3>::Field &positions);

/**
 * Write the control points as CSV. The columns are shape, index, x, y, z (3D), dx, dy, dz
 * (displacements of the control point), variables (entries of the design with their signs), and
 * body_x, body_y, body_z (point of the body at the control point) [length]. For one rank.
 * @throws std::runtime_error if the file cannot be written.
 */
template <int dim>
void write_control_points(const std::string                         &path,
                          const std::vector<shape::MovedPoint<dim>> &points);

/**
 * Write the gradients of responses as CSV, one row per design variable. The columns are variable,
 * shape and control_points (the control points that the variable moves, separated by blanks), x, y,
 * z (3D) of the point of the body at the first of them, and one column of dJ/dalpha for each name.
 * Variables without control points, such as amplitudes of formula modes, have empty entries
 * instead.
 * @p gradients holds one vector per name, with one entry per variable. For one rank.
 * @throws std::runtime_error if the file cannot be written.
 */
template <int dim>
void write_gradients(const std::string                         &path,
                     const std::vector<shape::MovedPoint<dim>> &points,
                     const std::vector<std::string>            &names,
                     const std::vector<std::vector<double>>    &gradients);
} // namespace snug::io

#endif
