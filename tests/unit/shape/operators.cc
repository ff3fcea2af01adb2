#include <snug/base/run_context.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <map>

#include "bodies.h"

namespace snug {
namespace {
using namespace test;

template <int dim>
using Field = typename mesh::BodyMesh<dim>::Field;

/// Numbers for the nodes of the cells of this rank: a gradient is a sum
/// over cells.
template <int dim>
Field<dim> random_gradient(const mesh::BodyMesh<dim> &mesh)
{
  const unsigned int rank    = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  const auto         numbers = random_numbers(dim * mesh.n_local_nodes(), 2 + rank);
  Field<dim>         gradient(mesh.n_local_nodes());
  for (const auto &cell : mesh.cells())
    for (const unsigned int node : cell.nodes)
      for (unsigned int c = 0; c < dim; ++c)
        gradient[node][c] = numbers[dim * node + c];
  return gradient;
}

std::string name(const shape::ShapeParameters &parameters)
{
  return parameters.basis + ", " +
         (parameters.face.empty() ? "bodies" : to_text(parameters.interior));
}

/// alpha . V'g = g . V alpha, relative to the sizes of the terms.
template <int dim>
void expect_adjoint(const mesh::BodyMesh<dim> &mesh, const shape::ShapeParameters &parameters)
{
  const shape::Shapes<dim> shapes(mesh, body_names(), {parameters});
  const auto               alpha    = random_numbers(shapes.n_variables(), 1);
  const auto               gradient = random_gradient(mesh);
  const auto               moved    = shapes.apply(alpha);
  double                   left = 0., size = 0., right = 0.;
  for (unsigned int node = 0; node < moved.size(); ++node)
    {
      left += moved[node] * gradient[node];
      size += moved[node].norm() * gradient[node].norm();
    }
  left                  = dealii::Utilities::MPI::sum(left, MPI_COMM_WORLD);
  size                  = dealii::Utilities::MPI::sum(size, MPI_COMM_WORLD);
  const auto transposed = shapes.transpose(gradient);
  for (unsigned int i = 0; i < alpha.size(); ++i)
    right += alpha[i] * transposed[i];
  EXPECT_NEAR(left, right, 1e-14 * size) << name(parameters);
}

/// Images add up, columns are those of unit vectors, hanging nodes follow.
template <int dim>
void expect_linear_and_conforming(const mesh::BodyMesh<dim>    &mesh,
                                  const shape::ShapeParameters &parameters)
{
  const shape::Shapes<dim> shapes(mesh, body_names(), {parameters});
  const unsigned int       last   = shapes.n_variables() - 1;
  auto                     alpha  = random_numbers(last + 1, 3);
  const auto               moved  = shapes.apply(alpha);
  const auto               column = shapes.column(last);
  alpha[last] -= 2.;
  const auto other        = shapes.apply(alpha);
  auto       interpolated = moved;
  mesh.interpolate_hanging(interpolated);
  double size = 0.;
  for (unsigned int node = 0; node < moved.size(); ++node)
    {
      EXPECT_NEAR((other[node] + 2. * column[node] - moved[node]).norm(), 0., 1e-13)
        << name(parameters);
      EXPECT_NEAR((interpolated[node] - moved[node]).norm(), 0., 1e-15) << name(parameters);
      size = std::max(size, moved[node].norm());
    }
  size = dealii::Utilities::MPI::max(size, MPI_COMM_WORLD);
  EXPECT_GT(size, 0.1) << name(parameters);
}

/// Body and logical position in units of 2^-32: the same on any ranks.
template <int dim>
std::vector<long long> key_of(const mesh::BodyMesh<dim> &mesh, unsigned int node)
{
  std::vector<long long> key = {mesh.body_of_node(node)};
  for (unsigned int d = 0; d < dim; ++d)
    key.push_back(std::llround(std::ldexp(mesh.logical_positions()[node][d], 32)));
  return key;
}

/// Variables of a node-wise shape are numbered by the mesh, which ranks
/// change: those get a smooth function of their places.
template <int dim>
std::vector<double> smooth_design(const shape::Shapes<dim> &shapes)
{
  std::vector<double> design(shapes.n_variables());
  const auto          points = shapes.control_points(design);
  for (unsigned int i = 0; i < design.size(); ++i)
    design[i] = points.size() == design.size()
                  ? std::sin(3. * points[i].position[0] + points[i].position[1])
                  : std::sin(1. + i);
  return design;
}

template <int dim>
void expect_same_on_all_ranks(unsigned int degree, const shape::ShapeParameters &parameters)
{
  const mesh::BodyMesh<dim> serial(MPI_COMM_SELF, shape_bodies<dim>(), degree);
  const mesh::BodyMesh<dim> parallel(MPI_COMM_WORLD, shape_bodies<dim>(), degree);
  const shape::Shapes<dim>  reference(serial, body_names(), {parameters});
  const shape::Shapes<dim>  shapes(parallel, body_names(), {parameters});
  ASSERT_EQ(reference.n_variables(), shapes.n_variables());
  EXPECT_EQ(reference.faces(), shapes.faces());
  const auto expected = reference.apply(smooth_design(reference));
  const auto moved    = shapes.apply(smooth_design(shapes));
  std::map<std::vector<long long>, dealii::Tensor<1, dim>> at;
  for (unsigned int node = 0; node < expected.size(); ++node)
    at[key_of(serial, node)] = expected[node];
  for (const auto &cell : parallel.cells())
    for (const unsigned int node : cell.nodes)
      EXPECT_NEAR((moved[node] - at.at(key_of(parallel, node))).norm(), 0., 1e-12)
        << name(parameters);
}

template <int dim, typename Check>
void for_all_shapes(const Check &check)
{
  for (const unsigned int degree : {1, 2})
    {
      const mesh::BodyMesh<dim> mesh(MPI_COMM_WORLD, shape_bodies<dim>(), degree);
      for (const auto &parameters : all_shapes<dim>())
        check(mesh, parameters);
    }
}

TEST(ShapeOperators, TransposeIsTheAdjointOfApply)
{
  for_all_shapes<2>(expect_adjoint<2>);
  // Interior nodes of degree 2 move alike in 2D and 3D, and take long in 3D.
  for_all_shapes<3>([](const auto &mesh, const auto &parameters) {
    if (mesh.degree() == 1 || parameters.interior == shape::InteriorKind::automatic)
      expect_adjoint<3>(mesh, parameters);
  });
}

TEST(ShapeOperators, AreLinearAndHangingNodesFollow)
{
  for_all_shapes<2>(expect_linear_and_conforming<2>);
  const mesh::BodyMesh<3> mesh(MPI_COMM_WORLD, shape_bodies<3>(), 1);
  for (const auto &parameters : all_shapes<3>())
    expect_linear_and_conforming(mesh, parameters);
}

TEST(ShapeOperators, DoNotDependOnRanks)
{
  for (const auto &parameters : all_shapes<2>())
    for (const unsigned int degree : {1, 2})
      expect_same_on_all_ranks<2>(degree, parameters);
  for (const auto &parameters : all_shapes<3>())
    expect_same_on_all_ranks<3>(1, parameters);
}
} // namespace
} // namespace snug
