#ifndef snug_faces_quadratic_triangle_h
#define snug_faces_quadratic_triangle_h

#include <snug/mesh/surface.h>

#include <array>
#include <optional>

namespace snug::faces {
/**
 * A triangle with quadratic functions, of which a face of the surface is a third, see
 * mesh::QuadraticElements. Surface nodes: corners[0] is on the face, and middles[k] is the middle
 * of the edge opposite to corners[k].
 */
struct QuadraticTriangle
{
  std::array<unsigned int, 3> corners, middles;

  /// Return the functions 1 - 2 lambda_k of the middles at a surface node of the triangle. They are
  /// linear, sum to 1, and have the integral A / 3 on a triangle with the area A.
  template <int dim>
  std::array<double, 3> linear_functions(const mesh::Surface<dim> &surface,
                                         unsigned int              node) const;
};

/// Return the triangle of a @p face, a surface index; nothing for other faces.
template <int dim>
std::optional<QuadraticTriangle> quadratic_triangle(const mesh::Surface<dim> &surface,
                                                    unsigned int              face);
} // namespace snug::faces

#endif
