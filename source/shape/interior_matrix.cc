#include <snug/elasticity/cell_point.h>
#include <snug/shape/interior_matrix.h>

#include <algorithm>

namespace snug::shape {
namespace {
const double poissons_ratio = 0.3;

/// The nodes of a cell as sums of free ones: T, row by row.
template <int dim>
std::vector<double> expand_hanging(const mesh::BodyMesh<dim>       &mesh,
                                   const std::vector<unsigned int> &cell_nodes,
                                   std::vector<unsigned int>       &reached)
{
  std::vector<std::vector<std::pair<unsigned int, double>>> sums;
  for (const unsigned int node : cell_nodes)
    {
      if (mesh.is_hanging(node))
        sums.push_back(mesh.hanging()[mesh.hanging_index(node)].masters);
      else
        sums.push_back({{node, 1.}});
      for (const auto &term : sums.back())
        reached.push_back(term.first);
    }
  std::sort(reached.begin(), reached.end());
  reached.erase(std::unique(reached.begin(), reached.end()), reached.end());
  std::vector<double> T(cell_nodes.size() * reached.size(), 0.);
  for (unsigned int a = 0; a < sums.size(); ++a)
    for (const auto &term : sums[a])
      T[a * reached.size() + (std::lower_bound(reached.begin(), reached.end(), term.first) -
                              reached.begin())] = term.second;
  return T;
}
} // namespace

template <int dim>
InteriorMatrix<dim>::InteriorMatrix(const mesh::BodyMesh<dim> &mesh, const InteriorKind kind)
  : mesh(mesh)
  , kind(kind)
  , element(mesh.degree())
  , gauss(elasticity::lagrange_gauss_points<dim>(mesh.degree()))
{}

template <int dim>
std::vector<typename InteriorMatrix<dim>::Block>
InteriorMatrix<dim>::laplacian(const Nodes &X) const
{
  const unsigned int n = X.size();
  std::vector<Block> K(n * n);
  for (const auto &shape : gauss)
    {
      const elasticity::CellPoint<dim> point(shape, X, mesh::Idealization::natural(dim));
      for (unsigned int a = 0; a < n; ++a)
        for (unsigned int b = 0; b < n; ++b)
          for (unsigned int c = 0; c < dim; ++c)
            K[a * n + b][c][c] += point.dV * (point.gradients[a] * point.gradients[b]);
    }
  return K;
}

template <int dim>
std::vector<typename InteriorMatrix<dim>::Block>
InteriorMatrix<dim>::stiffness(const Nodes &X) const
{
  const unsigned int  n = X.size();
  std::vector<double> entries;
  element.stiffness(X, {1. / element.volume(X), poissons_ratio}, entries);
  std::vector<Block> K(n * n);
  for (unsigned int i = 0; i < n * dim; ++i)
    for (unsigned int j = 0; j < n * dim; ++j)
      K[i / dim * n + j / dim][i % dim][j % dim] = entries[i * n * dim + j];
  return K;
}

template <int dim>
typename InteriorMatrix<dim>::CellMatrix
InteriorMatrix<dim>::of_cell(const typename mesh::BodyMesh<dim>::Cell &cell) const
{
  Nodes X;
  bool  hanging = false;
  for (const unsigned int node : cell.nodes)
    {
      X.push_back(mesh.reference_positions()[node]);
      hanging = hanging || mesh.is_hanging(node);
    }
  CellMatrix result{cell.nodes, kind == InteriorKind::Laplace ? laplacian(X) : stiffness(X)};
  if (!hanging)
    return result;
  result.nodes.clear();
  const auto         T = expand_hanging(mesh, cell.nodes, result.nodes);
  const unsigned int n = X.size(), m = result.nodes.size();
  std::vector<Block> condensed(m * m);
  for (unsigned int a = 0; a < n; ++a)
    for (unsigned int i = 0; i < m; ++i)
      if (T[a * m + i] != 0.)
        for (unsigned int b = 0; b < n; ++b)
          for (unsigned int j = 0; j < m; ++j)
            condensed[i * m + j] += T[a * m + i] * T[b * m + j] * result.blocks[a * n + b];
  result.blocks = condensed;
  return result;
}

template class InteriorMatrix<2>;
template class InteriorMatrix<3>;
} // namespace snug::shape
