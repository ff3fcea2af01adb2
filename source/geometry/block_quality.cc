#include <snug/geometry/block_quality.h>
#include <snug/geometry/cell_numbering.h>

#include <cmath>

namespace snug::geometry {
namespace {
/// Return the multi-index of one of 3^dim points, first axis fastest.
template <int dim>
std::array<unsigned int, dim> place(unsigned int point)
{
  std::array<unsigned int, dim> n;
  n.fill(3);
  return multi_index(point, n);
}

unsigned int power(const unsigned int dim)
{
  return dim == 2 ? 9 : 27;
}

/// Return the vertices of the edge, face or block whose middle is at @p at, or the vertex at
/// @p at.
template <int dim>
Vertices around(const Vertices &block, const std::array<unsigned int, dim> &at)
{
  Vertices result;
  for (unsigned int v = 0; v < block.size(); ++v)
    {
      bool within = true;
      for (unsigned int d = 0; d < dim; ++d)
        within = within && (at[d] == 1 || at[d] / 2 == (v >> d & 1));
      if (within)
        result.push_back(block[v]);
    }
  return sorted(result);
}

template <int dim>
using Lattice = std::vector<dealii::Point<dim>>;

/// Return the middle of the edge, face or block at @p at by transfinite interpolation. The middle
/// of each part that spans j axes less has the weight (-1)^(j+1) / 2^j.
template <int dim>
dealii::Point<dim> interpolated(const Lattice<dim> &x, const std::array<unsigned int, dim> &at)
{
  dealii::Point<dim> result;
  for (unsigned int p = 0; p < x.size(); ++p)
    {
      const auto own    = place<dim>(p);
      bool       within = true;
      double     weight = -1.;
      for (unsigned int d = 0; d < dim; ++d)
        {
          within = within && (at[d] == 1 || own[d] == at[d]);
          if (at[d] == 1 && own[d] != 1)
            weight *= -0.5;
        }
      if (within && weight != -1.)
        result += weight * x[p];
    }
  return result;
}

/// Return the 3^dim points of a block. Middles of edges are computed before middles of faces and
/// blocks, because each middle depends on the middles of its parts.
template <int dim>
Lattice<dim>
lattice(const std::vector<dealii::Point<dim>>                                         &vertices,
        const Vertices                                                                &block,
        const std::map<typename BlockMesh<dim>::Face, typename BlockMesh<dim>::Piece> &pieces)
{
  Lattice<dim> x(power(dim));
  for (unsigned int n_axes = 0; n_axes <= dim; ++n_axes)
    for (unsigned int p = 0; p < x.size(); ++p)
      {
        const auto at = place<dim>(p);
        if (std::count(at.begin(), at.end(), 1u) != n_axes)
          continue;
        const Vertices key   = around<dim>(block, at);
        const auto     found = n_axes == 0 ? pieces.end() : pieces.find(key);
        if (n_axes == 0)
          x[p] = vertices[key[0]];
        else if (found == pieces.end())
          x[p] = interpolated<dim>(x, at);
        else
          {
            dealii::Point<2> middle;
            for (const auto &own : found->second.at)
              middle += own / double(key.size());
            x[p] = found->second.patch->position(middle);
          }
      }
  return x;
}
} // namespace

template <int dim>
double least_scaled_jacobian(
  const std::vector<dealii::Point<dim>>                                         &vertices,
  const std::vector<unsigned int>                                               &block,
  const std::map<typename BlockMesh<dim>::Face, typename BlockMesh<dim>::Piece> &pieces)
{
  const auto   x       = lattice<dim>(vertices, block, pieces);
  double       least   = 1.;
  unsigned int step[3] = {1, 3, 9};
  // Derivatives of a parabola through three points, at each of the three points.
  const double slope[3][3] = {{-3., 4., -1.}, {-1., 0., 1.}, {1., -4., 3.}};
  for (unsigned int p = 0; p < x.size(); ++p)
    {
      const auto             at = place<dim>(p);
      dealii::Tensor<2, dim> J;
      double                 lengths = 1.;
      for (unsigned int d = 0; d < dim; ++d)
        {
          for (unsigned int i = 0; i < 3; ++i)
            J[d] += slope[at[d]][i] * x[p - at[d] * step[d] + i * step[d]];
          lengths *= J[d].norm();
        }
      least = std::min(least, lengths > 0. ? determinant(J) / lengths : -1.);
    }
  return least;
}

template <int dim>
std::vector<std::vector<unsigned int>> edges_and_faces(const std::vector<unsigned int> &block)
{
  std::vector<Vertices> result;
  for (unsigned int p = 0; p < power(dim); ++p)
    {
      const auto key = around<dim>(block, place<dim>(p));
      if (key.size() > 1 && key.size() < 1u << dim)
        result.push_back(key);
    }
  return result;
}

template double least_scaled_jacobian(const std::vector<dealii::Point<2>> &,
                                      const std::vector<unsigned int> &,
                                      const std::map<BlockMesh<2>::Face, BlockMesh<2>::Piece> &);
template double least_scaled_jacobian(const std::vector<dealii::Point<3>> &,
                                      const std::vector<unsigned int> &,
                                      const std::map<BlockMesh<3>::Face, BlockMesh<3>::Piece> &);
template std::vector<std::vector<unsigned int>>
edges_and_faces<2>(const std::vector<unsigned int> &);
template std::vector<std::vector<unsigned int>>
edges_and_faces<3>(const std::vector<unsigned int> &);
} // namespace snug::geometry
