#include <snug/mesh/surface.h>

#include <deal.II/base/mpi.h>

#include <cmath>

#include "bodies.h"

namespace snug {
namespace {
using namespace test;

/// Node-wise top of the unit cube of 8 cells per edge.
shape::ShapeParameters node_wise(double radius)
{
  auto parameters          = on_top<3>("node-wise", "cube");
  parameters.filter_radius = radius;
  return parameters;
}

bool is_on_top(const mesh::BodyMesh<3> &mesh, unsigned int node)
{
  return mesh.logical_positions()[node][2] == 1.;
}

TEST(NodeWise, HasOneVariablePerNodeThatDoesNotHang)
{
  const mesh::BodyMesh<3> mesh(MPI_COMM_WORLD, plain_cube<3>(8), 1);
  EXPECT_EQ(shape::Shapes<3>(mesh, {{"cube"}}, {node_wise(0.3)}).n_variables(), 81u);
  const mesh::BodyMesh<2> hanging(MPI_COMM_WORLD, shape_bodies<2>(), 1);
  const shape::Shapes<2>  shapes(hanging, body_names(), {on_top<2>("node-wise")});
  const mesh::Surface<2>  top(hanging, shapes.faces());
  unsigned int            n_free = 0;
  for (unsigned int node = 0; node < top.n_nodes(); ++node)
    n_free += top.masters(node).empty();
  EXPECT_EQ(shapes.n_variables(), n_free);
}

TEST(NodeWise, EqualVariablesMoveAPlaneFaceAsAWhole)
{
  const mesh::BodyMesh<3> mesh(MPI_COMM_WORLD, plain_cube<3>(8), 2);
  const shape::Shapes<3>  shapes(mesh, {{"cube"}}, {node_wise(0.3)});
  const auto              moved = shapes.apply(std::vector<double>(shapes.n_variables(), 0.1));
  for (unsigned int node = 0; node < moved.size(); ++node)
    {
      EXPECT_NEAR(moved[node][2], 0.1 * mesh.logical_positions()[node][2], 1e-15);
      EXPECT_NEAR(std::hypot(moved[node][0], moved[node][1]), 0., 1e-15);
    }
}

TEST(NodeWise, FilterBelowTheNodeSpacingDoesNothing)
{
  const mesh::BodyMesh<3> mesh(MPI_COMM_WORLD, plain_cube<3>(8), 1);
  const shape::Shapes<3>  shapes(mesh, {{"cube"}}, {node_wise(0.12)});
  const auto              alpha  = random_numbers(81, 8);
  const auto              points = shapes.control_points(alpha);
  const auto              moved  = shapes.apply(alpha);
  for (unsigned int node = 0; node < moved.size(); ++node)
    if (is_on_top(mesh, node))
      for (const auto &point : points)
        {
          const auto place = point.position - point.move;
          if (place.distance(dealii::Point<3>(mesh.reference_positions()[node])) < 1e-10)
            {
              EXPECT_NEAR((moved[node] - point.move).norm(), 0., 1e-15);
            }
        }
}

/// The value of one variable spreads as far as the radius, falls linearly
/// (areas are equal inside), and a rough design becomes a smoother shape.
TEST(NodeWise, FilterIsALinearHatOfItsRadius)
{
  const mesh::BodyMesh<3> mesh(MPI_COMM_WORLD, plain_cube<3>(8), 1);
  const double            radius = 0.25;
  const shape::Shapes<3>  shapes(mesh, {{"cube"}}, {node_wise(radius)});
  std::vector<double>     alpha(81, 0.);
  const auto              points = shapes.control_points(alpha);
  const dealii::Point<3>  centre(0.5, 0.5, 1.);
  for (unsigned int i = 0; i < 81; ++i)
    if (points[i].position.distance(centre) < 1e-10)
      alpha[i] = 1.;
  double sum = 0.; // of hats around an inner node
  for (int i = -2; i <= 2; ++i)
    for (int j = -2; j <= 2; ++j)
      sum += std::max(0., 1. - std::hypot(i, j) / 8. / radius);
  const auto moved = shapes.apply(alpha);
  for (unsigned int node = 0; node < moved.size(); ++node)
    if (is_on_top(mesh, node))
      {
        const double r = (mesh.reference_positions()[node] - centre).norm();
        EXPECT_NEAR(moved[node][2], std::max(0., 1. - r / radius) / sum, 1e-14);
      }
}

TEST(NodeWise, FixedBorderStaysAndIsApproachedContinuously)
{
  const mesh::BodyMesh<3> mesh(MPI_COMM_WORLD, plain_cube<3>(8), 1);
  auto                    parameters = node_wise(0.3);
  parameters.fixed                   = {"border"};
  const shape::Shapes<3> shapes(mesh, {{"cube"}}, {parameters});
  EXPECT_EQ(shapes.n_variables(), 49u);
  const auto moved = shapes.apply(std::vector<double>(49, 1.));
  for (unsigned int node = 0; node < moved.size(); ++node)
    if (is_on_top(mesh, node))
      {
        const auto  &x     = mesh.reference_positions()[node];
        const double inset = std::min({x[0], 1. - x[0], x[1], 1. - x[1]});
        EXPECT_GE(moved[node][2], 0.);
        EXPECT_LE(moved[node][2], inset / 0.3 + 1e-14);
      }
}

TEST(NodeWise, RejectsAFilterWithoutARadius)
{
  auto bad          = on_top<3>("node-wise");
  bad.filter_radius = 0.;
  expect_complaint<3>(bad, "Filter radius", "positive");
  bad.filter_radius = -1.;
  expect_complaint<3>(bad, "Filter radius", "positive");
  bad               = on_top<3>("node-wise");
  bad.filter_radius = NAN;
  expect_complaint<3>(bad, "Filter radius", "positive");
  bad       = on_top<3>("node-wise");
  bad.fixed = {"100000"};
  expect_complaint<3>(bad, "Fixed", "counted from 0");
}
} // namespace
} // namespace snug
