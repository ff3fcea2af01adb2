#include <cmath>

#include "bodies.h"

namespace snug {
namespace {
using namespace test;

/// Moves by @p field at each node equal those at its mirror image across
/// x = plane, reflected.
template <int dim>
void expect_mirrored(const mesh::BodyMesh<dim> &mesh, const shape::ShapeParameters &parameters)
{
  const shape::Shapes<dim> shapes(mesh, {{"cube"}}, {parameters});
  const double             plane = parameters.symmetry.at("x");
  const auto               alpha = random_numbers(shapes.n_variables(), 6);
  const auto               moved = shapes.apply(alpha);
  double                   size  = 0.;
  for (unsigned int i = 0; i < moved.size(); ++i)
    {
      auto image = mesh.reference_positions()[i];
      image[0]   = 2. * plane - image[0];
      auto move  = moved[i];
      move[0]    = -move[0];
      size       = std::max(size, move.norm());
      for (unsigned int j = 0; j < moved.size(); ++j)
        if ((mesh.reference_positions()[j] - image).norm() < 1e-9)
          {
            EXPECT_NEAR((moved[j] - move).norm(), 0., 1e-12) << parameters.basis;
          }
    }
  EXPECT_GT(size, 0.1);
}

/// Parameters of a shape that is symmetric in x = 1/2 of the unit cube.
template <int dim>
shape::ShapeParameters symmetric(const std::string &basis)
{
  auto parameters       = basis.find("box") == std::string::npos ? on_top<dim>(basis, "cube")
                                                                 : box_in_foundation<dim>(basis);
  parameters.bodies     = {};
  parameters.box_corner = std::vector<double>(dim, -0.25);
  parameters.box_size   = std::vector<double>(dim, 1.5);
  parameters.symmetry   = {{"x", 0.5}};
  return parameters;
}

// each rank the whole mesh, so that it has every node's image
TEST(Links, MirrorPlanesMakeSymmetricShapes)
{
  const mesh::BodyMesh<2> square(MPI_COMM_SELF, plain_cube<2>(6), 1);
  const mesh::BodyMesh<3> cube(MPI_COMM_SELF, plain_cube<3>(4), 1);
  for (const std::string basis :
       {"Bezier patch", "B-spline patch", "node-wise", "Bezier box", "B-spline box"})
    {
      expect_mirrored(square, symmetric<2>(basis));
      expect_mirrored(cube, symmetric<3>(basis));
    }
}

TEST(Links, CountTheVariablesThatAreLeft)
{
  const mesh::BodyMesh<3> cube(MPI_COMM_WORLD, plain_cube<3>(4), 1);
  const auto              n = [&](const shape::ShapeParameters &p) {
    return shape::Shapes<3>(cube, {{"cube"}}, {p}).n_variables();
  };
  auto patch = on_top<3>("Bezier patch", "cube"); // 4 x 5
  EXPECT_EQ(n(patch), 20u);
  patch.symmetry = {{"x", 0.5}};
  EXPECT_EQ(n(patch), 10u);
  patch.symmetry = {{"x", 0.5}, {"y", 0.5}};
  EXPECT_EQ(n(patch), 6u);
  patch.fixed = {"border"};
  EXPECT_EQ(n(patch), 2u);
  patch.symmetry = {};
  EXPECT_EQ(n(patch), 6u);
  patch.fixed = {"0", "7"};
  EXPECT_EQ(n(patch), 18u);
  // a fixed point takes its image with it
  patch.symmetry = {{"x", 0.5}};
  EXPECT_EQ(n(patch), 8u);

  auto box = symmetric<3>("Bezier box"); // 3 x 4 x 4
  // the middle ones of three along x do not move along x
  EXPECT_EQ(n(box), 4u * 4 * (3 + 2));
}

/// Heights along the normal of the mirror plane: the one in the middle is
/// tied to its own opposite.
TEST(Links, WhatEqualsItsOppositeIsFixed)
{
  const mesh::BodyMesh<2> square(MPI_COMM_WORLD, plain_cube<2>(4), 1);
  auto                    patch = on_top<2>("Bezier patch", "cube"); // 5
  patch.direction               = {1., 0.};
  patch.symmetry                = {{"x", 0.5}};
  const shape::Shapes<2> shapes(square, {{"cube"}}, {patch});
  ASSERT_EQ(shapes.n_variables(), 2u);
  const auto points = shapes.control_points({0.1, 0.2});
  EXPECT_EQ(points[0].move[0], 0.1);
  EXPECT_EQ(points[1].move[0], 0.2);
  EXPECT_EQ(points[2].move[0], 0.);
  EXPECT_EQ(points[3].move[0], -0.2);
  EXPECT_EQ(points[4].move[0], -0.1);
}

TEST(Links, RejectWhatCannotBe)
{
  auto patch     = on_top<3>("Bezier patch");
  patch.symmetry = {{"x", 0.1}};
  expect_complaint<3>(patch, "Symmetry", "has no image");
  patch.symmetry  = {{"x", 0.}};
  patch.direction = {1., 0., 1.};
  expect_complaint<3>(patch, "Symmetry", "has no image");
  patch       = on_top<3>("Bezier patch");
  patch.fixed = {"20"};
  expect_complaint<3>(patch, "Fixed", "one of the 20");
  patch.fixed = {"edges"};
  expect_complaint<3>(patch, "Fixed", "'border'");
  patch.fixed          = {"border"};
  patch.control_points = {2, 2};
  expect_complaint<3>(patch, "Fixed", "no design variables");
}
} // namespace
} // namespace snug
