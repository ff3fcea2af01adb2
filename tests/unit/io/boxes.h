#ifndef snug_tests_unit_io_boxes_h
#define snug_tests_unit_io_boxes_h

#include <snug/elasticity/material.h>
#include <snug/mesh/body_mesh.h>
#include <snug/mesh/tearing.h>
#include <snug/state/assembler.h>

namespace snug::test {
/// Body 0: a unit box; body 1: one on top of it, locally refined where its
/// x < 0.5 if @p hanging.
template <int dim>
std::vector<geometry::BodyMeshParameters> two_boxes(bool hanging)
{
  std::vector<geometry::BodyMeshParameters> bodies(2);
  for (auto &body : bodies)
    {
      body.corner.assign(dim, 0.);
      body.size.assign(dim, 1.);
      body.cells.assign(dim, 2);
    }
  bodies[0].cells[0]        = 3;
  bodies[1].corner[dim - 1] = 1.;
  if (hanging)
    {
      bodies[1].refine_where      = "0.5-x";
      bodies[1].local_refinements = 1;
    }
  return bodies;
}

/// Stiff below, soft above.
inline std::vector<elasticity::Material> two_materials()
{
  return {{210., 0.3}, {70., 0.2}};
}

template <int dim>
std::vector<state::BodyModel<dim>> two_bodies()
{
  std::vector<state::BodyModel<dim>> bodies(2);
  for (unsigned int b = 0; b < 2; ++b)
    bodies[b].materials = {two_materials()[b]};
  return bodies;
}

/// All cells of a rank as its only subdomain (none without cells).
template <int dim>
mesh::Tearing one_subdomain_per_rank(const mesh::BodyMesh<dim> &mesh)
{
  int rank, size;
  MPI_Comm_rank(mesh.communicator(), &rank);
  MPI_Comm_size(mesh.communicator(), &size);
  mesh::Tearing tearing;
  tearing.first_id = rank;
  tearing.n_global = size;
  tearing.subdomains.emplace_back();
  for (unsigned int cell = 0; cell < mesh.cells().size(); ++cell)
    tearing.subdomains.back().cells.push_back(cell);
  return tearing;
}

/// x -> A x with fixed entries.
template <int dim>
dealii::Tensor<2, dim> displacement_gradient()
{
  dealii::Tensor<2, dim> A;
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = 0; j < dim; ++j)
      A[i][j] = 0.01 * (1. + 2. * i - 0.7 * j + 0.4 * i * j);
  return A;
}

template <int dim>
typename mesh::BodyMesh<dim>::Field
linear_field(const typename mesh::BodyMesh<dim>::Field &positions)
{
  auto u = positions;
  for (auto &value : u)
    value = displacement_gradient<dim>() * value;
  return u;
}

/// Hooke's law written out; 3 x 3, plane strain in 2D.
template <int dim>
dealii::Tensor<2, 3> hooke(const elasticity::Material &m, const dealii::Tensor<2, dim> &grad)
{
  const double         mu     = m.youngs_modulus / (2. * (1. + m.poissons_ratio));
  const double         lambda = 2. * mu * m.poissons_ratio / (1. - 2. * m.poissons_ratio);
  dealii::Tensor<2, 3> sigma;
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = 0; j < dim; ++j)
      sigma[i][j] = mu * (grad[i][j] + grad[j][i]);
  for (unsigned int i = 0; i < 3; ++i)
    sigma[i][i] += lambda * trace(grad);
  return sigma;
}
} // namespace snug::test

#endif
