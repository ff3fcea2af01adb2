#include <snug/supports/dirichlet_constraints.h>

#include <gtest/gtest.h>

#include <cmath>
#include <set>

using namespace snug;
using supports::Component;
using supports::Support;
using Value = std::function<double(const dealii::Point<3> &)>;

namespace {
/// Return a half ball of radius 2 about the origin, z > 0.
geometry::BodyMeshParameters half_ball()
{
  geometry::BodyMeshParameters body;
  body.source      = geometry::Source::sphere;
  body.part        = geometry::Part::half;
  body.radius      = 2.;
  body.round_cells = {4};
  return body;
}

Support<3> support(const mesh::BodyMesh<3> &mesh, const std::string &face, unsigned int component)
{
  return {0,         geometry::boundary_index(mesh.geometry(0), face),
          component, std::vector<Value>(1),
          face,      "ball." + face};
}

using Constraints = supports::DirichletConstraints<3>;

/// Return the constraints of normal supports on both faces of the half ball.
Constraints normal_supports(const mesh::BodyMesh<3> &mesh)
{
  return Constraints(mesh,
                     {support(mesh, "outer", Component<3>::normal),
                      support(mesh, "bottom", Component<3>::normal)},
                     1, mesh.reference_positions());
}
} // namespace

TEST(DirichletConstraints, HoldNodesAlongTheNormalsOfAllSides)
{
  const mesh::BodyMesh<3> mesh(MPI_COMM_SELF, {half_ball()}, 1);
  const auto              constraints = normal_supports(mesh);
  const auto             &X           = mesh.reference_positions();
  const auto              frames      = constraints.frames(X);
  EXPECT_TRUE(constraints.follow_positions());
  unsigned int n_outer = 0, n_bottom = 0, n_edge = 0;
  for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
    {
      const bool outer  = std::abs(X[node].norm() - 2.) < 1e-10;
      const bool bottom = std::abs(X[node][2]) < 1e-10;
      const auto held   = constraints.find(mesh.global_node(node));
      ASSERT_EQ(held < constraints.n_nodes(), outer || bottom);
      if (!outer && !bottom)
        continue;
      const auto directions = frames.directions(held);
      ASSERT_EQ(directions.size(), (outer ? 1u : 0u) + (bottom ? 1u : 0u));
      // Directions are orthonormal, and span the radial direction and z.
      for (unsigned int i = 0; i < directions.size(); ++i)
        for (unsigned int j = 0; j < directions.size(); ++j)
          EXPECT_NEAR(directions[i] * directions[j], i == j ? 1. : 0., 1e-13);
      if (bottom && !outer)
        {
          EXPECT_NEAR(std::abs(directions[0][2]), 1., 1e-13);
          ++n_bottom;
        }
      if (outer && !bottom)
        {
          // Nodal normals are those of the facets, up to the square of their size.
          EXPECT_GT(directions[0] * X[node] / 2., 0.98);
          ++n_outer;
        }
      n_edge += outer && bottom;
    }
  EXPECT_GT(n_outer, n_edge);
  EXPECT_GT(n_bottom, 10u);
  EXPECT_GT(n_edge, 10u);
}

/// Compare derivatives, and their transposes, with differences.
void check_derivatives(const mesh::BodyMesh<3> &mesh, const Constraints &constraints)
{
  const auto    &X = mesh.reference_positions();
  mesh::Field<3> velocity(X.size());
  for (unsigned int node = 0; node < X.size(); ++node)
    velocity[node] = dealii::Tensor<1, 3>(
      {std::sin(X[node][1]), X[node][0] * X[node][2], std::cos(X[node][0] - X[node][1])});
  const auto   exact = constraints.frame_derivatives(X, velocity);
  const double h     = 1e-5;
  const auto   moved = [&](const double step) {
    mesh::Field<3> result = X;
    for (unsigned int node = 0; node < X.size(); ++node)
      result[node] += step * velocity[node];
    return constraints.frames(result);
  };
  const auto   up = moved(h), down = moved(-h);
  unsigned int n_following = 0;
  for (unsigned int node = 0; node < constraints.n_nodes(); ++node)
    {
      ASSERT_EQ(exact.directions(node).size() == 0, !constraints.follows_positions(node));
      n_following += constraints.follows_positions(node);
      for (unsigned int j = 0; j < exact.directions(node).size(); ++j)
        EXPECT_NEAR(((up.directions(node)[j] - down.directions(node)[j]) / (2. * h) -
                     exact.directions(node)[j])
                      .norm(),
                    0., 1e-8);
    }
  EXPECT_GT(n_following, 0u);
  // The gradient of sum r_k (q_k . u - s_k), with s_k = q_k . u, is that of its derivative along V.
  mesh::Field<3>                   u(X.size()), gradient(X.size());
  std::vector<std::vector<double>> reactions(constraints.n_nodes());
  double                           forward = 0., backward = 0.;
  for (unsigned int node = 0; node < X.size(); ++node)
    u[node] = dealii::Tensor<1, 3>({X[node][2], std::cos(X[node][0]), 1. + X[node][1]});
  const auto frames = constraints.frames(X);
  for (unsigned int node = 0; node < X.size(); ++node)
    if (const unsigned int held = constraints.find(mesh.global_node(node));
        held < constraints.n_nodes())
      {
        // the values of given directions d_j of unit length that are prescribed are d_j . u
        for (unsigned int k = 0; k < frames.directions(held).size(); ++k)
          reactions[held].push_back(1. + k + X[node][0]);
        if (frames.directions(held).size() == 1 && exact.directions(held).size() > 0)
          forward += reactions[held][0] * (exact.directions(held)[0] * u[node]);
        else
          reactions[held].assign(reactions[held].size(), 0.);
      }
  constraints.add_energy_gradient(X, u, reactions, gradient);
  for (unsigned int node = 0; node < X.size(); ++node)
    backward += gradient[node] * velocity[node];
  EXPECT_GT(std::abs(forward), 1e-3);
  EXPECT_NEAR(backward, forward, 1e-12 * std::abs(forward));
}

TEST(DirichletConstraints, DerivativesOfFramesAreLimitsOfDifferences)
{
  const mesh::BodyMesh<3> mesh(MPI_COMM_SELF, {half_ball()}, 1);
  check_derivatives(mesh, normal_supports(mesh));
}

/// An axis beside the ball, along (1, 2, 2) / 3.
const supports::Axis<3> beside = {dealii::Point<3>(5., 0., 0.),
                                  dealii::Tensor<1, 3>({1. / 3., 2. / 3., 2. / 3.})};

TEST(DirichletConstraints, DirectionsAboutAnAxisFollowTheNodes)
{
  const mesh::BodyMesh<3> mesh(MPI_COMM_SELF, {half_ball()}, 1);
  std::vector<Support<3>> held = {support(mesh, "outer", Component<3>::tangential),
                                  support(mesh, "bottom", Component<3>::normal),
                                  support(mesh, "bottom", Component<3>::radial)};
  for (auto &of : held)
    of.component.axis = beside;
  const Constraints constraints(mesh, held, 1, mesh.reference_positions());
  check_derivatives(mesh, constraints);
  const auto frames = constraints.frames(mesh.reference_positions());
  for (unsigned int node = 0; node < frames.size(); ++node)
    {
      if (frames.directions(node).size() == 1) // outer
        EXPECT_NEAR(frames.directions(node)[0] * beside.direction, 0., 1e-14);
    }
}

TEST(DirichletConstraints, ComponentsAboutAnAxisAreAFrame)
{
  const auto direction = [](const unsigned int number, const dealii::Tensor<1, 3> &x) {
    return Component<3>(number, beside).direction(x, {});
  };
  const dealii::Tensor<1, 3> x({1., -2., 4.}), on_axis = beside.point + 7. * beside.direction;
  const auto r = direction(Component<3>::radial, x), t = direction(Component<3>::tangential, x),
             a = direction(Component<3>::axial, x);
  // The place is that on the axis plus the radius along r.
  const auto lever = x - beside.point;
  EXPECT_NEAR((lever - (lever * r) * r - (lever * a) * a).norm(), 0., 1e-14);
  EXPECT_GT(lever * r, 1.);
  EXPECT_NEAR((dealii::cross_product_3d(r, t) - a).norm(), 0., 1e-15);
  EXPECT_NEAR(direction(Component<3>::tangential, on_axis).norm(), 0., 1e-15);
  // A turn about z by 90 degrees, in the plane
  const supports::Component<2> around(supports::Component<2>::tangential, {{1., 1.}, {}});
  EXPECT_NEAR((around.direction(dealii::Point<2>(3., 1.), {}) - dealii::Point<2>(0., 1.)).norm(),
              0., 1e-15);
}

TEST(DirichletConstraints, ANodeOnTheAxisHasNoDirections)
{
  const mesh::BodyMesh<3> mesh(MPI_COMM_SELF, {half_ball()}, 1);
  auto                    held = support(mesh, "bottom", Component<3>::radial);
  // The middle of the bottom is on the axis z.
  held.component.axis = {{1e-13, 0., 0.}, dealii::Tensor<1, 3>({0., 0., 1.})};
  EXPECT_THROW(Constraints(mesh, {held}, 1, mesh.reference_positions()), InputError);
  held.component.axis.point[0] = 1e-3;
  EXPECT_NO_THROW(Constraints(mesh, {held}, 1, mesh.reference_positions()));
  held.component = {Component<3>::axial, held.component.axis};
  EXPECT_NO_THROW(Constraints(mesh, {held}, 1, mesh.reference_positions()));
}

TEST(DirichletConstraints, AxesAreHeldOnceHoweverOften)
{
  const mesh::BodyMesh<3> mesh(MPI_COMM_SELF, {half_ball()}, 2);
  const Constraints       constraints(mesh,
                                      {support(mesh, "bottom", 2), support(mesh, "bottom", 0),
                                       support(mesh, "bottom", Component<3>::normal)},
                                      1, mesh.reference_positions());
  const auto              frames = constraints.frames(mesh.reference_positions());
  for (unsigned int node = 0; node < frames.size(); ++node)
    {
      // z is held already, so that the normal of the plane face adds nothing.
      ASSERT_EQ(frames.directions(node).size(), 2u);
      for (const auto &direction : frames.directions(node))
        EXPECT_NEAR(direction[1], 0., 1e-15);
    }
  auto lifted   = support(mesh, "bottom", 2);
  lifted.name   = "lifted";
  lifted.values = {[](const dealii::Point<3> &) { return 0.1; }};
  EXPECT_THROW(Constraints(mesh, {support(mesh, "bottom", 2), lifted}, 1,
                           mesh.reference_positions()),
               InputError);
}
