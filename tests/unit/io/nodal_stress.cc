#include <snug/io/nodal_stress.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "boxes.h"

namespace snug {
namespace {
template <int dim>
std::set<unsigned int> nodes_of_owned_cells(const mesh::BodyMesh<dim> &mesh)
{
  std::set<unsigned int> nodes;
  for (const auto &cell : mesh.cells())
    nodes.insert(cell.nodes.begin(), cell.nodes.end());
  return nodes;
}

template <int dim>
void expect_constant_stress(unsigned int degree)
{
  auto bodies                    = test::two_boxes<dim>(true);
  bodies[1].curved_faces["top"]  = "0.1*x*x";
  bodies[0].curved_faces["left"] = dim == 2 ? "0.1*y" : "0.1*y*z";
  const mesh::BodyMesh<dim> mesh(MPI_COMM_WORLD, bodies, degree);
  const auto                materials = test::two_materials();
  const auto                stress =
    io::nodal_stress<dim>(mesh, test::two_bodies<dim>(), mesh.reference_positions(),
                          test::linear_field<dim>(mesh.reference_positions()));
  for (const unsigned int node : nodes_of_owned_cells(mesh))
    {
      const auto expected =
        test::hooke(materials[mesh.body_of_node(node)], test::displacement_gradient<dim>());
      // round-off of a few hundred operations on numbers of order 10
      EXPECT_LT((dealii::Tensor<2, 3>(stress[node]) - expected).norm(), 1e-11)
        << "degree " << degree << ", node " << node;
    }
}

TEST(NodalStress, OfALinearDisplacementIsConstant)
{
  for (const unsigned int degree : {1, 2})
    {
      expect_constant_stress<2>(degree);
      expect_constant_stress<3>(degree);
    }
}

/// Two materials in one body, each under its own constant strain.
template <int dim>
void expect_jump_of_stress(unsigned int degree)
{
  auto bodies = test::two_boxes<dim>(true);
  bodies.erase(bodies.begin());
  bodies[0].region_formulas = {{"core", "x - 0.5"}};
  state::BodyModel<dim> model;
  model.materials = test::two_materials();
  const mesh::BodyMesh<dim> mesh(MPI_COMM_WORLD, bodies, degree);
  auto                      u       = mesh.reference_positions();
  const double              slope[] = {0.01, -0.03};
  for (auto &value : u)
    {
      const double x = value[0] - 0.5;
      value          = 0.;
      value[dim - 1] = slope[x > 0.] * x;
    }
  const auto stress = io::nodal_stress<dim>(mesh, {model}, mesh.reference_positions(), u);
  EXPECT_EQ(io::n_stress_regions(mesh), 2u);
  for (const auto &cell : mesh.cells())
    for (const unsigned int node : cell.nodes)
      {
        dealii::Tensor<2, dim> gradient;
        gradient[dim - 1][0] = slope[cell.region];
        EXPECT_LT((dealii::Tensor<2, 3>(stress[2 * node + cell.region]) -
                   test::hooke(model.materials[cell.region], gradient))
                    .norm(),
                  1e-11)
          << "degree " << degree << " at " << mesh.reference_positions()[node];
      }
}

TEST(NodalStress, JumpsBetweenRegions)
{
  for (const unsigned int degree : {1, 2})
    {
      expect_jump_of_stress<2>(degree);
      expect_jump_of_stress<3>(degree);
    }
}

TEST(NodalStress, HasTheHoopStressOfBodiesOfRevolution)
{
  // u = (a r, c z): radial and hoop strain a, axial strain c
  const double a = 0.02, c = -0.03;
  const auto   models = test::two_bodies<2>();
  for (const auto formulation : {elasticity::Formulation::standard, elasticity::Formulation::B_bar})
    for (const unsigned int degree : {1, 2})
      {
        const mesh::BodyMesh<2> mesh(MPI_COMM_WORLD, test::two_boxes<2>(true), degree,
                                     {mesh::Idealization::Kind::axisymmetric});
        auto                    bodies = models;
        for (auto &body : bodies)
          body.formulation = formulation;
        auto u = mesh.reference_positions();
        for (auto &value : u)
          value = dealii::Point<2>(a * value[0], c * value[1]);
        const auto stress = io::nodal_stress<2>(mesh, bodies, mesh.reference_positions(), u);
        for (const unsigned int node : nodes_of_owned_cells(mesh))
          {
            dealii::Tensor<2, 3> gradient;
            gradient[0][0] = gradient[2][2] = a;
            gradient[1][1]                  = c;
            const auto expected =
              test::hooke(models[mesh.body_of_node(node)].materials[0], gradient);
            EXPECT_LT((dealii::Tensor<2, 3>(stress[node]) - expected).norm(), 1e-11);
          }
      }
}

/// u_k = x_k^2 + x_0 x_1 / 2 and its gradient: linear stress.
template <int dim>
dealii::Tensor<2, dim> quadratic_gradient(const dealii::Tensor<1, dim> &x)
{
  dealii::Tensor<2, dim> gradient;
  for (unsigned int k = 0; k < dim; ++k)
    {
      gradient[k][k] += 2. * x[k];
      gradient[k][0] += 0.5 * x[1];
      gradient[k][1] += 0.5 * x[0];
    }
  return gradient;
}

template <int dim>
typename mesh::BodyMesh<dim>::Field
quadratic_field(const typename mesh::BodyMesh<dim>::Field &positions)
{
  auto u = positions;
  for (auto &value : u)
    {
      const auto x = value;
      for (unsigned int k = 0; k < dim; ++k)
        value[k] = x[k] * x[k] + 0.5 * x[0] * x[1];
    }
  return u;
}

template <int dim>
void expect_linear_stress(unsigned int degree, bool hanging)
{
  auto bodies = test::two_boxes<dim>(hanging);
  bodies[0].cells.assign(dim, 3);
  if (degree == 1) // graded Q2 cells are curved: they miss x^2
    bodies[0].grading.assign(dim, 3.);
  const mesh::BodyMesh<dim> mesh(MPI_COMM_WORLD, bodies, degree);
  const auto                materials = test::two_materials();
  const auto               &x         = mesh.reference_positions();
  const auto                stress =
    io::nodal_stress<dim>(mesh, test::two_bodies<dim>(), x, quadratic_field<dim>(x));
  unsigned int checked = 0;
  for (const unsigned int node : nodes_of_owned_cells(mesh))
    {
      ++checked;
      const auto expected =
        test::hooke(materials[mesh.body_of_node(node)], quadratic_gradient(x[node]));
      EXPECT_LT((dealii::Tensor<2, 3>(stress[node]) - expected).norm(), 1e-9) << x[node];
    }
  unsigned int total = 0;
  MPI_Allreduce(&checked, &total, 1, MPI_UNSIGNED, MPI_SUM, MPI_COMM_WORLD);
  EXPECT_GE(total, 2u);
}

TEST(NodalStress, OfQuadraticElementsIsExactIfLinear)
{
  expect_linear_stress<2>(2, true);
  expect_linear_stress<3>(2, true);
}

TEST(NodalStress, OfLinearElementsIsExactInGradedBoxesIfLinear)
{
  expect_linear_stress<2>(1, false);
  expect_linear_stress<3>(1, false);
}

/// Largest error of the stress at the bore of a ring under Lame's displacement, relative to the
/// hoop stress there.
double error_at_bore(unsigned int n)
{
  geometry::BodyMeshParameters ring;
  ring.source       = geometry::Source::ring;
  ring.inner_radius = 1.;
  ring.radius       = 2.;
  ring.part         = geometry::Part::quarter;
  ring.round_cells  = {2 * n, n};
  const mesh::BodyMesh<2> mesh(MPI_COMM_WORLD, {ring}, 1);
  state::BodyModel<2>     model;
  model.materials     = {test::two_materials()[0]};
  const auto  &x      = mesh.reference_positions();
  const double nu     = model.materials[0].poissons_ratio;
  const double factor = 0.01 / (1. - 2. * nu); // u = factor ((1 - 2 nu) r + 4 / r)
  auto         u      = x;
  for (auto &value : u)
    value *= factor * (1. - 2. * nu + 4. / value.norm_square());
  const auto stress = io::nodal_stress<2>(mesh, {model}, x, u);
  double     worst  = 0.;
  for (const unsigned int node : nodes_of_owned_cells(mesh))
    if (std::abs(x[node].norm() - 1.) < 1e-9)
      {
        dealii::Tensor<2, 2> gradient;
        for (unsigned int i = 0; i < 2; ++i)
          for (unsigned int j = 0; j < 2; ++j)
            gradient[i][j] =
              factor * ((1. - 2. * nu + 4.) * (i == j) - 8. * x[node][i] * x[node][j]);
        const auto expected = test::hooke(model.materials[0], gradient);
        worst =
          std::max(worst, (dealii::Tensor<2, 3>(stress[node]) - expected).norm() / expected.norm());
      }
  return dealii::Utilities::MPI::max(worst, MPI_COMM_WORLD);
}

TEST(NodalStress, OfLinearElementsIsOfSecondOrderAtSurfaces)
{
  double last = error_at_bore(4);
  for (const unsigned int n : {8, 16, 32})
    {
      const double now = error_at_bore(n);
      EXPECT_GT(last / now, n == 8 ? 2.8 : 3.3) << n << ": " << now;
      last = now;
    }
  EXPECT_LT(last, 5e-3);
}

template <int dim>
std::vector<long> place_of_node(const mesh::BodyMesh<dim> &mesh, unsigned int node)
{
  std::vector<long> key(1, mesh.body_of_node(node));
  for (unsigned int k = 0; k < dim; ++k)
    key.push_back(std::lround(1e6 * mesh.reference_positions()[node][k]));
  return key;
}

template <int dim>
typename mesh::BodyMesh<dim>::Field wavy_field(const mesh::BodyMesh<dim> &mesh)
{
  auto u = mesh.reference_positions();
  for (auto &value : u)
    {
      const auto x = value;
      for (unsigned int k = 0; k < dim; ++k)
        value[k] = std::sin(3. * x[k] + x[dim - 1 - k]);
    }
  mesh.interpolate_hanging(u);
  return u;
}

TEST(NodalStress, DoesNotDependOnTheRanks)
{
  const auto              bodies = test::two_boxes<3>(true);
  const auto              models = test::two_bodies<3>();
  const mesh::BodyMesh<3> whole(MPI_COMM_SELF, bodies, 1);
  const auto              serial =
    io::nodal_stress<3>(whole, models, whole.reference_positions(), wavy_field(whole));
  std::map<std::vector<long>, unsigned int> node_at;
  for (unsigned int node = 0; node < whole.n_local_nodes(); ++node)
    node_at[place_of_node(whole, node)] = node;

  const mesh::BodyMesh<3> mesh(MPI_COMM_WORLD, bodies, 1);
  const auto              parallel =
    io::nodal_stress<3>(mesh, models, mesh.reference_positions(), wavy_field(mesh));
  for (const unsigned int node : nodes_of_owned_cells(mesh))
    {
      const auto difference = parallel[node] - serial[node_at.at(place_of_node(mesh, node))];
      EXPECT_LT(difference.norm(), 1e-10); // sums in another order
    }
}
} // namespace
} // namespace snug
