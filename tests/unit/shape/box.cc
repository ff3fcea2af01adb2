#include <deal.II/base/mpi.h>

#include <cmath>

#include "bodies.h"

namespace snug {
namespace {
using namespace test;

/// A box around both bodies.
template <int dim>
shape::ShapeParameters wide_box(const std::string &basis)
{
  auto parameters       = box_in_foundation<dim>(basis);
  parameters.bodies     = {};
  parameters.box_corner = std::vector<double>(dim, -2.);
  parameters.box_size   = std::vector<double>(dim, 9.);
  return parameters;
}

/// u = A x + b at the control points is u = A x + b at the nodes.
template <int dim>
void expect_affine_maps(const std::string &basis)
{
  const mesh::BodyMesh<dim> mesh(MPI_COMM_WORLD, shape_bodies<dim>(), 2);
  const auto                box =
    choose(shape::shape_basis_table<dim>(), basis).make(mesh, body_names(), wide_box<dim>(basis));
  const auto A   = random_numbers(dim * (dim + 1), 4);
  const auto map = [&A](const dealii::Point<dim> &x) {
    dealii::Tensor<1, dim> u;
    for (unsigned int c = 0; c < dim; ++c)
      {
        u[c] = A[dim * dim + c];
        for (unsigned int d = 0; d < dim; ++d)
          u[c] += A[dim * c + d] * x[d];
      }
    return u;
  };
  std::vector<double> alpha;
  for (const auto &control : box->controls())
    alpha.push_back(map(control.position) * control.direction);
  const auto moved = box->apply(alpha);
  for (unsigned int node = 0; node < moved.size(); ++node)
    EXPECT_NEAR((moved[node] - map(dealii::Point<dim>(mesh.reference_positions()[node]))).norm(),
                0., 1e-13);
}

TEST(SplineBox, ReproducesAffineMaps)
{
  expect_affine_maps<2>("Bezier box");
  expect_affine_maps<2>("B-spline box");
  expect_affine_maps<3>("Bezier box");
  expect_affine_maps<3>("B-spline box");
}

TEST(SplineBox, LeavesWhatIsOutsideAndCutSidesAlone)
{
  const mesh::BodyMesh<3> mesh(MPI_COMM_WORLD, shape_bodies<3>(), 1);
  const shape::Shapes<3>  shapes(mesh, body_names(), {box_in_foundation<3>("Bezier box")});
  // of 3 x 4 x 4 points those at the lower sides are frozen; the upper
  // sides, at 1.6, are beyond the body
  EXPECT_EQ(shapes.n_variables(), 3u * 2 * 3 * 3);
  const auto moved   = shapes.apply(std::vector<double>(shapes.n_variables(), 1.));
  double     largest = 0.;
  for (unsigned int node = 0; node < moved.size(); ++node)
    {
      const auto &x      = mesh.reference_positions()[node];
      const bool  inside = mesh.body_of_node(node) == 1 && std::min({x[0], x[1], x[2]}) > -0.4;
      if (!inside && !mesh.is_hanging(node))
        {
          EXPECT_EQ(moved[node].norm(), 0.);
        }
      largest = std::max(largest, moved[node].norm());
    }
  EXPECT_GT(dealii::Utilities::MPI::max(largest, MPI_COMM_WORLD), 0.5);
}

TEST(SplineBox, MovesSeveralBodiesAlongOneDirection)
{
  const mesh::BodyMesh<2> mesh(MPI_COMM_WORLD, shape_bodies<2>(), 1);
  auto                    parameters = wide_box<2>("Bezier box");
  parameters.direction               = {3., 4.};
  const shape::Shapes<2> shapes(mesh, body_names(), {parameters});
  EXPECT_EQ(shapes.n_variables(), 12u);
  const auto moved = shapes.apply(std::vector<double>(12, 1.));
  for (const auto &move : moved)
    {
      EXPECT_NEAR(move[0], 0.6, 1e-15);
      EXPECT_NEAR(move[1], 0.8, 1e-15);
    }
  EXPECT_EQ(shapes.faces().size(), 8u);
}

TEST(SplineBox, FreezesPointsThatMoveNothing)
{
  const mesh::BodyMesh<2> mesh(MPI_COMM_WORLD, shape_bodies<2>(), 1);
  auto                    parameters = wide_box<2>("B-spline box");
  parameters.degree                  = 1;
  parameters.control_points          = {10, 10};
  parameters.bodies                  = {"punch"};
  const shape::Shapes<2> shapes(mesh, body_names(), {parameters});
  // knots at -2, -1, .., 7: the punch is between 5 and 6
  EXPECT_EQ(shapes.n_variables(), 2u * 2 * 2);
}

TEST(SplineBox, RejectsWhatCannotBe)
{
  const auto good = box_in_foundation<3>("Bezier box");
  EXPECT_EQ(failure_reason<3>(good), "");
  const auto expect = [&](const std::string &entry, const std::string &says,
                          void (*spoil)(shape::ShapeParameters &)) {
    auto bad = good;
    spoil(bad);
    expect_complaint<3>(bad, entry, says);
  };
  using P = shape::ShapeParameters;
  expect("Box size", "> 0", [](P &p) { p.box_size[1] = 0.; });
  expect("Box size", "> 0", [](P &p) { p.box_size = {}; });
  expect("Box corner", "3 numbers", [](P &p) { p.box_corner = {1., 1.}; });
  expect("Box size", "no node", [](P &p) { p.box_corner[2] = 1.1; });
  expect("Bodies", "no body 'anvil'", [](P &p) { p.bodies = {"anvil"}; });
  expect("Control points", "3 numbers", [](P &p) { p.control_points = {2, 2}; });
  expect("Fixed", "no design variables", [](P &p) {
    p.fixed          = {"border"};
    p.control_points = {2, 2, 2};
  });
  // two of its sides cut the body and hold all control points
  expect("Fixed", "no design variables", [](P &p) {
    p.box_corner     = {-0.5, -0.5, -0.5};
    p.box_size       = {1., 1., 1.};
    p.control_points = {2, 2, 2};
  });
}
} // namespace
} // namespace snug
