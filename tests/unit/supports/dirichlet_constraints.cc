#include <snug/supports/dirichlet_constraints.h>

#include <gtest/gtest.h>

#include <cmath>
#include <set>

using namespace snug;
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
                     {support(mesh, "outer", supports::Component<3>::normal),
                      support(mesh, "bottom", supports::Component<3>::normal)},
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
      const auto &directions = frames[held].directions;
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

TEST(DirichletConstraints, DerivativesOfFramesAreLimitsOfDifferences)
{
  const mesh::BodyMesh<3> mesh(MPI_COMM_SELF, {half_ball()}, 1);
  const auto              constraints = normal_supports(mesh);
  const auto             &X           = mesh.reference_positions();
  mesh::Field<3>          velocity(X.size());
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
      ASSERT_EQ(exact[node].directions.empty(), !constraints.follows_positions(node));
      n_following += constraints.follows_positions(node);
      for (unsigned int j = 0; j < exact[node].directions.size(); ++j)
        EXPECT_NEAR(((up[node].directions[j] - down[node].directions[j]) / (2. * h) -
                     exact[node].directions[j])
                      .norm(),
                    0., 1e-8);
    }
  EXPECT_GT(n_following, 0u);
}

TEST(DirichletConstraints, AxesAreHeldOnceHoweverOften)
{
  const mesh::BodyMesh<3> mesh(MPI_COMM_SELF, {half_ball()}, 2);
  const Constraints       constraints(mesh,
                                      {support(mesh, "bottom", 2), support(mesh, "bottom", 0),
                                       support(mesh, "bottom", supports::Component<3>::normal)},
                                      1, mesh.reference_positions());
  for (const auto &frame : constraints.frames(mesh.reference_positions()))
    {
      // z is held already, so that the normal of the plane face adds nothing.
      ASSERT_EQ(frame.directions.size(), 2u);
      for (const auto &direction : frame.directions)
        EXPECT_NEAR(direction[1], 0., 1e-15);
    }
  auto lifted   = support(mesh, "bottom", 2);
  lifted.name   = "lifted";
  lifted.values = {[](const dealii::Point<3> &) { return 0.1; }};
  EXPECT_THROW(Constraints(mesh, {support(mesh, "bottom", 2), lifted}, 1,
                           mesh.reference_positions()),
               InputError);
}
