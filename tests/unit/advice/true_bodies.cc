#include <snug/advice/true_bodies.h>

#include <gtest/gtest.h>

#include <cmath>

namespace snug::test {
namespace {
geometry::BodyMeshParameters ball()
{
  geometry::BodyMeshParameters mesh;
  mesh.source = geometry::Source::sphere;
  mesh.radius = 2.;
  mesh.complete(3);
  mesh.round_cells = {3};
  return mesh;
}

template <int dim>
geometry::BodyMeshParameters unit_box(const std::vector<double> &corner)
{
  geometry::BodyMeshParameters mesh;
  mesh.corner = corner;
  mesh.cells.assign(dim, 3);
  mesh.complete(dim);
  return mesh;
}
} // namespace

TEST(TrueBodies, PointsLieOnTheSurfaceWhateverTheMesh)
{
  const mesh::BodyMesh<3>     mesh(MPI_COMM_WORLD, {ball()}, 1);
  const advice::TrueBodies<3> bodies(mesh);
  const auto                  points = bodies.surface_points(50);
  EXPECT_EQ(points.size(), 50u);
  dealii::Tensor<1, 3> mean;
  for (const auto &at : points)
    {
      EXPECT_NEAR(at.x.norm(), 2., 1e-12);
      EXPECT_LT((at.normal - at.x / 2.).norm(), 1e-5);
      mean += at.x / 50.;
    }
  EXPECT_LT(mean.norm(), 0.3); // all around
  for (const auto &at : bodies.inner_points(50))
    {
      EXPECT_LT(at.x.norm(), 2.);
      EXPECT_EQ(at.normal.norm(), 0.);
    }
}

TEST(TrueBodies, FindsPointsThatAreThere)
{
  const mesh::BodyMesh<3>     mesh(MPI_COMM_WORLD, {ball()}, 1);
  const advice::TrueBodies<3> bodies(mesh);
  for (double angle = 0.1; angle < 6.; angle += 0.37)
    {
      const dealii::Tensor<1, 3> n =
        dealii::Point<3>(std::cos(angle) * 0.6, std::sin(angle) * 0.6, 0.8);
      const dealii::Point<3> x(2. * n);
      const auto             found = bodies.find(x, n);
      ASSERT_TRUE(found);
      EXPECT_LT(found->x.distance(x), 1e-7);
      EXPECT_FALSE(bodies.find(dealii::Point<3>(1.0001 * x), n)); // 2e-4 off
      EXPECT_FALSE(bodies.find(x, -1. * n));                      // nothing's other side
      EXPECT_TRUE(bodies.find(dealii::Point<3>(0.9 * x), {}));
      EXPECT_FALSE(bodies.find(dealii::Point<3>(1.1 * x), {}));
    }
}

TEST(TrueBodies, TellBodiesThatTouchApart)
{
  const mesh::BodyMesh<2> mesh(MPI_COMM_WORLD, {unit_box<2>({0., 0.}), unit_box<2>({0., 1.})}, 1);
  const advice::TrueBodies<2> bodies(mesh);
  const dealii::Point<2>      between(0.3, 1.);
  dealii::Tensor<1, 2>        up;
  up[1] = 1.;
  ASSERT_TRUE(bodies.find(between, up));
  EXPECT_EQ(bodies.find(between, up)->body, 0u);
  EXPECT_EQ(bodies.find(between, -up)->body, 1u);
  EXPECT_NEAR(bodies.size(), std::sqrt(5.), 0.2);
}
} // namespace snug::test
