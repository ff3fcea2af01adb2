#include <snug/mesh/face_nodes.h>

#include <utility>

namespace snug::mesh {
template <int dim>
std::vector<unsigned int> oriented_face_nodes(const std::vector<unsigned int> &cell_nodes,
                                              unsigned int                     degree,
                                              unsigned int                     face)
{
  const unsigned int n      = degree + 1;
  const unsigned int normal = face / 2;
  const bool         upper  = face % 2 == 1;
  // index difference between neighbouring nodes along each axis of the cell
  const unsigned int        stride[3] = {1, n, n * n};
  const unsigned int        first     = upper ? degree * stride[normal] : 0;
  std::vector<unsigned int> nodes;
  if (dim == 2)
    {
      // The tangent is +y on side x+ and -x on side y+. Opposite sides have opposite tangents.
      const unsigned int axis    = 1 - normal;
      const bool         reverse = (normal == 0) != upper;
      for (unsigned int i = 0; i < n; ++i)
        nodes.push_back(cell_nodes[first + (reverse ? degree - i : i) * stride[axis]]);
      return nodes;
    }
  // t_a x t_b is the positive axis, which points outwards on the upper side only, so the tangents
  // are swapped on the lower side. The tangents of deal.II are equal on both sides.
  unsigned int a = (normal + 1) % 3, b = (normal + 2) % 3;
  if (!upper)
    std::swap(a, b);
  for (unsigned int j = 0; j < n; ++j)
    for (unsigned int i = 0; i < n; ++i)
      nodes.push_back(cell_nodes[first + i * stride[a] + j * stride[b]]);
  return nodes;
}

/// The tangents are the same as in oriented_face_nodes().
template <int dim>
dealii::Point<dim> point_on_face(const unsigned int face, const dealii::Point<dim - 1> &xi)
{
  const unsigned int normal = face / 2;
  const bool         upper  = face % 2 == 1;
  dealii::Point<dim> point;
  point[normal] = upper ? 1. : 0.;
  if constexpr (dim == 2)
    point[1 - normal] = (normal == 0) != upper ? 1. - xi[0] : xi[0];
  else
    for (unsigned int i = 0; i < 2; ++i)
      point[(normal + 1 + (upper ? i : 1 - i)) % 3] = xi[i];
  return point;
}

template dealii::Point<2> point_on_face<2>(unsigned int, const dealii::Point<1> &);
template dealii::Point<3> point_on_face<3>(unsigned int, const dealii::Point<2> &);
template std::vector<unsigned int>
oriented_face_nodes<2>(const std::vector<unsigned int> &, unsigned int, unsigned int);
template std::vector<unsigned int>
oriented_face_nodes<3>(const std::vector<unsigned int> &, unsigned int, unsigned int);
} // namespace snug::mesh
