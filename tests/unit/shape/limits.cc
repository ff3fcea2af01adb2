#include <snug/shape/spline.h>

#include <cmath>

#include "bodies.h"

namespace snug {
namespace {
using namespace test;
using shape::SplineAxis;

double value(const SplineAxis &axis, const std::vector<double> &points, const double s)
{
  double sum = 0.;
  for (const auto &[i, weight] : axis.values(s))
    sum += weight * points[i];
  return sum;
}

/// Control points of the derivative.
std::vector<double>
derivative(const SplineAxis &axis, const std::vector<double> &points, const unsigned int order)
{
  std::vector<double> result;
  for (const auto &row : axis.derivative(order))
    {
      result.push_back(0.);
      for (const auto &[i, weight] : row)
        result.back() += weight * points[i];
    }
  return result;
}

/// The control points of derivatives bound them, and at clamped ends and of linear and quadratic
/// functions they are their values.
TEST(Limits, OfDerivativesBoundThem)
{
  const std::vector<SplineAxis::Ends> all    = {{false, {{false, false}}},
                                                {true, {{false, false}}},
                                                {false, {{true, false}}},
                                                {false, {{false, true}}},
                                                {false, {{true, true}}}};
  const auto                          points = random_numbers(6, 12);
  const double                        h      = 1e-4;
  for (const auto &ends : all)
    for (const unsigned int degree : {2, 3, 4})
      {
        const SplineAxis axis(6, degree, ends);
        const auto       slopes = derivative(axis, points, 1), bends = derivative(axis, points, 2);
        const auto [low, top]   = std::minmax_element(slopes.begin(), slopes.end());
        const auto [flat, bent] = std::minmax_element(bends.begin(), bends.end());
        for (double s = h; s < 1. - h; s += 0.0173)
          {
            const double before = value(axis, points, s - h), at = value(axis, points, s),
                         after = value(axis, points, s + h);
            EXPECT_GT((after - before) / (2. * h), *low - 1e-3);
            EXPECT_LT((after - before) / (2. * h), *top + 1e-3);
            EXPECT_GT((after - 2. * at + before) / (h * h), *flat - 1e-1);
            EXPECT_LT((after - 2. * at + before) / (h * h), *bent + 1e-1);
          }
        // Smooth ends have no slope, clamped ends the slope of their control point.
        const double left = (value(axis, points, 1e-7) - value(axis, points, 0.)) / 1e-7;
        if (ends.smooth[0])
          {
            EXPECT_NEAR(left, 0., 1e-4);
          }
        else if (!ends.closed && !ends.smooth[1])
          {
            EXPECT_NEAR(left, slopes.front(), 1e-4);
          }
        if (ends.closed)
          {
            EXPECT_NEAR(value(axis, points, 0.), value(axis, points, 1.), 1e-14);
          }
      }
}

shape::ShapeParameters top_patch(std::vector<unsigned int> points)
{
  shape::ShapeParameters parameters;
  parameters.basis          = "B-spline patch";
  parameters.face           = "body.top";
  parameters.control_points = std::move(points);
  parameters.degree         = 2;
  parameters.bounds         = {-1., 1.};
  return parameters;
}

double excess(const shape::Shapes<2>::Limit &limit, const std::vector<double> &x)
{
  double sum = -limit.bound;
  for (unsigned int i = 0; i < x.size(); ++i)
    sum += limit.row[i] * x[i];
  return sum;
}

double largest_excess(const shape::Shapes<2> &shapes, const std::vector<double> &x)
{
  double result = -1e300;
  for (const auto &limit : shapes.limits())
    result = std::max(result, excess(limit, x));
  return result;
}

/// A tilt of 0.1 over the length 2 has the slope 0.05 everywhere.
TEST(Limits, OfSlopesAreExactForTilts)
{
  auto bodies    = plain_cube<2>(4);
  bodies[0].size = {2., 1.};
  const mesh::BodyMesh<2> mesh(MPI_COMM_WORLD, bodies, 1);
  auto                    parameters = top_patch({5});
  parameters.maximum_slope           = 0.04;
  const shape::Shapes<2> shapes(mesh, {{"body"}}, {parameters});
  std::vector<double>    tilt;
  for (const double greville : {0., 1. / 6, 0.5, 5. / 6, 1.})
    tilt.push_back(0.1 * greville);
  EXPECT_EQ(shapes.limits().size(), 8u);
  EXPECT_NEAR(largest_excess(shapes, tilt), 0.01, 1e-12);
  EXPECT_EQ(shapes.most_violated_limit(tilt), "Shape/Maximum slope");
  for (double &height : tilt)
    height *= -0.7;
  EXPECT_NEAR(largest_excess(shapes, tilt), -0.005, 1e-12);
  EXPECT_EQ(shapes.most_violated_limit(tilt), "");
}

/// On a face of the radius R = 3, a move whose second derivative is k in all control points changes
/// the curvature from 1/R to 1/R - k.
TEST(Limits, OfCurvatureCountFromTheFace)
{
  for (const double radius : {3., -3.})
    {
      auto bodies                  = plain_cube<2>(8);
      bodies[0].curved_faces       = {{"top", "cylinder z " + std::to_string(radius)}};
      bodies[0].sampled_boundaries = {"top"};
      const mesh::BodyMesh<2> mesh(MPI_COMM_WORLD, bodies, 1);
      auto                    parameters = top_patch({5});
      parameters.coordinates             = shape::Coordinates::arc_length;
      parameters.tool_radius             = 2.;
      const shape::Shapes<2>  shapes(mesh, {{"body"}}, {parameters});
      const double            length = 6. * std::asin(0.5 / 3.), k = 0.2;
      const shape::SplineAxis axis(5, 2, {});
      // control points of k s^2 / 2 by the blossom: k t_1 t_2 / 2 of the inner knots
      std::vector<double> design;
      for (const double product : {0., 0., 2. / 9, 2. / 3, 1.})
        design.push_back(k * length * length * product / 2.);
      for (const auto &limit : shapes.limits())
        EXPECT_NEAR(excess(limit, design), k - 1. / radius - 0.5, 2e-3);
      EXPECT_EQ(shapes.limits().size(), 3u);
      parameters.tool_radius = 0.;
      parameters.convex      = true;
      const shape::Shapes<2> convex(mesh, {{"body"}}, {parameters});
      for (const auto &limit : convex.limits())
        EXPECT_NEAR(excess(limit, design), k - 1. / radius, 2e-3);
    }
}

TEST(Limits, OfRemovalAreBounds)
{
  const mesh::BodyMesh<2> mesh(MPI_COMM_WORLD, plain_cube<2>(4), 1);
  auto                    parameters = top_patch({5});
  parameters.only_remove             = true;
  for (const auto &[direction, lower, upper] :
       {std::make_tuple(std::vector<double>(), -1., 0.),
        std::make_tuple(std::vector<double>{0.3, -1.}, 0., 1.)})
    {
      parameters.direction = direction;
      for (const std::string basis : {"B-spline patch", "node-wise"})
        {
          parameters.basis         = basis;
          parameters.filter_radius = 0.3;
          const shape::Shapes<2> shapes(mesh, {{"body"}}, {parameters});
          EXPECT_TRUE(shapes.limits().empty());
          for (unsigned int i = 0; i < 5; ++i)
            {
              EXPECT_EQ(shapes.lower_bounds()[i], lower);
              EXPECT_EQ(shapes.upper_bounds()[i], upper);
            }
        }
    }
  const auto fails = [&](const shape::ShapeParameters &bad, const std::string &text) {
    try
      {
        shape::Shapes<2>(mesh, {{"body"}}, {bad});
        ADD_FAILURE() << text;
      }
    catch (const InputError &error)
      {
        EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
      }
  };
  parameters.direction = {1., 0.};
  fails(parameters, "Only remove");
  parameters.direction = {};
  parameters.initial   = {0.1};
  fails(parameters, "Initial");
  parameters        = top_patch({5});
  parameters.degree = 1;
  parameters.convex = true;
  fails(parameters, "degree 2");
}
} // namespace
} // namespace snug
