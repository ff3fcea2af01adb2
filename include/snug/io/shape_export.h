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
} // namespace snug::io

#endif
