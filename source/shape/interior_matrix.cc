#include <snug/elasticity/cell_point.h>
#include <snug/mesh/node_reach.h>
#include <snug/shape/interior_matrix.h>

namespace snug::shape {
namespace {
const double poissons_ratio = 0.3;
} // namespace

template <int dim>
InteriorMatrix<dim>::InteriorMatrix(const mesh::BodyMesh<dim> &mesh, const InteriorKind kind)
  : mesh(mesh)
  , kind(kind)
  , element(mesh.degree())
  , gauss(mesh::lagrange_gauss_points<dim>(mesh.degree()))
{}

template <int dim>
std::vector<double> InteriorMatrix<dim>::laplacian(const Nodes &X) const
{
  const unsigned int  n = X.size();
  std::vector<double> K(n * dim * n * dim, 0.);
  for (const auto &shape : gauss)
    {
      const elasticity::CellPoint<dim> point(shape, X, mesh::Idealization::natural(dim));
      for (unsigned int a = 0; a < n; ++a)
        for (unsigned int b = 0; b < n; ++b)
          for (unsigned int c = 0; c < dim; ++c)
            K[(a * dim + c) * n * dim + b * dim + c] +=
              point.dV * (point.gradients[a] * point.gradients[b]);
    }
  return K;
}

template <int dim>
typename InteriorMatrix<dim>::CellMatrix
InteriorMatrix<dim>::of_cell(const typename mesh::BodyMesh<dim>::Cell &cell) const
{
  Nodes X;
  for (const unsigned int node : cell.nodes)
    X.push_back(mesh.reference_positions()[node]);
  std::vector<double> K;
  if (kind == InteriorKind::Laplace)
    K = laplacian(X);
  else
    element.stiffness(X, {1. / element.volume(X), poissons_ratio}, K);
  // Hanging nodes are interpolated from their masters, so the matrix is condensed to the masters.
  const mesh::NodeReach<dim> reach(mesh, cell.nodes);
  reach.condense(K);
  const unsigned int m = reach.slots().size();
  CellMatrix         result{reach.slots(), std::vector<Block>(m * m)};
  for (unsigned int i = 0; i < m * dim; ++i)
    for (unsigned int j = 0; j < m * dim; ++j)
      result.blocks[i / dim * m + j / dim][i % dim][j % dim] = K[i * m * dim + j];
  return result;
}

template class InteriorMatrix<2>;
template class InteriorMatrix<3>;
} // namespace snug::shape
