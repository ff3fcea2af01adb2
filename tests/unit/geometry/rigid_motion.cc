#include <snug/geometry/rigid_motion.h>

#include <deal.II/base/numbers.h>

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace {
using namespace snug;
using dealii::Point;
using geometry::rigid_motion;

template <int dim>
void expect_at(const dealii::Tensor<1, dim> &found, const Point<dim> &expected)
{
  EXPECT_LT((found - expected).norm(), 1e-14) << found << " instead of " << expected;
}

TEST(RigidMotion, AppliesMotionsInTheirOrder)
{
  const auto turned_first = rigid_motion<2>("rotate z 90, shift 1 0");
  expect_at<2>(turned_first.point(Point<2>(1., 0.)), Point<2>(1., 1.));
  const auto shifted_first = rigid_motion<2>("shift 1 0, rotate z 90");
  expect_at<2>(shifted_first.point(Point<2>(1., 0.)), Point<2>(0., 2.));
  // Vectors turn but do not shift.
  expect_at<2>(shifted_first.vector(Point<2>(1., 0.)), Point<2>(0., 1.));
}

TEST(RigidMotion, LeavesThePointOfTheAxisWhereItIs)
{
  const Point<3> centre(1., 2., 3.);
  for (const auto *text : {"rotate x 17 about 1 2 3", "rotate y -40 about 1 2 3",
                           "rotate z 200 about 1 2 3, rotate x 5 about 1 2 3"})
    expect_at<3>(rigid_motion<3>(text).point(centre), centre);
  // counterclockwise if the axis points to the viewer
  expect_at<3>(rigid_motion<3>("rotate y 90").vector(Point<3>(0., 0., 1.)), Point<3>(1., 0., 0.));
}

TEST(RigidMotion, GoesBack)
{
  const auto     motion = rigid_motion<3>("rotate x 17, shift 1 2 3, rotate z 30 about 0 1 0");
  const Point<3> x(0.3, -2., 5.);
  expect_at<3>(motion.point_back(motion.point(x)), x);
  expect_at<3>(motion.vector_back(motion.vector(x)), x);
}

TEST(RigidMotion, OfNothingIsExactlyTheIdentity)
{
  for (const auto *text : {"rotate z 0 about 3 0.1", "shift 0 0", "rotate z 360 about 0.3 7"})
    EXPECT_TRUE(rigid_motion<2>(text).is_identity()) << text;
  EXPECT_FALSE(rigid_motion<2>("shift 0 1e-300").is_identity());
}

TEST(RigidMotion, RejectsOtherTexts)
{
  for (const auto *text : {"rotate x 3", "rotate z", "rotate z 3 about 1", "shift 1", "shift 1 2 3",
                           "turn z 3", "rotate z three", "rotate z 3 to 1 2"})
    EXPECT_THROW(rigid_motion<2>(text), std::invalid_argument) << text;
}
} // namespace
