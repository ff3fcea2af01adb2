#ifndef snug_supports_smooth_sides_h
#define snug_supports_smooth_sides_h

#include <snug/faces/face_shape.h>

namespace snug::supports {
/**
 * Return the faces of (body, boundary) pairs in smooth patches. Two faces that share a node are in
 * one patch if their normals there are less than 40 degrees apart, unless they lie on different
 * boundaries that are both flat. A patch consists of ascending indices of surface.faces().
 */
template <int dim>
std::vector<std::vector<unsigned int>>
smooth_sides(const mesh::Surface<dim>                                 &surface,
             const std::vector<std::pair<unsigned int, unsigned int>> &boundaries,
             const faces::FaceShape<dim>                              &shape,
             const typename mesh::Surface<dim>::Field                 &positions);
} // namespace snug::supports

#endif
