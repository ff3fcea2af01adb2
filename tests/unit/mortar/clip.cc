#include <snug/base/errors.h>
#include <snug/faces/face_map.h>
#include <snug/mortar/clip.h>

#include <gtest/gtest.h>

using namespace snug;
using namespace snug::faces;
using namespace snug::mortar;

namespace {
using Polygon = ConvexCell<2, double>;

const Polygon unit_square = {{{0., 0.}}, {{1., 0.}}, {{1., 1.}}, {{0., 1.}}};

Polygon shifted(const Polygon &cell, double x, double y)
{
  Polygon result = cell;
  for (auto &vertex : result)
    {
      vertex[0] += x;
      vertex[1] += y;
    }
  return result;
}

double overlap(const Polygon &a, const Polygon &b)
{
  return signed_measure<2>(intersection<2>(a, b));
}
} // namespace

TEST(Clip, IntervalsMeetInTheirCommonPart)
{
  using Interval       = ConvexCell<1, double>;
  const Interval whole = {{{0.}}, {{1.}}};
  const Interval part  = intersection<1>(whole, Interval{{{0.3}}, {{2.}}});
  ASSERT_EQ(part.size(), 2u);
  EXPECT_EQ(part[0][0], 0.3);
  EXPECT_EQ(part[1][0], 1.);
  EXPECT_TRUE(intersection<1>(whole, Interval{{{1.}}, {{2.}}}).empty());
  EXPECT_TRUE(intersection<1>(whole, Interval{{{1.5}}, {{2.}}}).empty());
}

TEST(Clip, AreasOfPolygonsAreExact)
{
  EXPECT_NEAR(overlap(unit_square, shifted(unit_square, 0.3, -0.2)), 0.7 * 0.8, 1e-15);
  // a diamond |x| + |y| <= 1 about the centre cut by the square about it
  const Polygon diamond = {{{-0.2, 0.5}}, {{0.5, -0.2}}, {{1.2, 0.5}}, {{0.5, 1.2}}};
  EXPECT_NEAR(overlap(unit_square, diamond), 2 * 0.49 - 4 * 0.04, 1e-15);
  EXPECT_NEAR(overlap(diamond, unit_square), 2 * 0.49 - 4 * 0.04, 1e-15);
  EXPECT_TRUE(intersection<2>(unit_square, shifted(unit_square, 1., 0.)).empty());
  EXPECT_TRUE(intersection<2>(unit_square, shifted(unit_square, 1.1, 1.1)).empty());
}

TEST(Clip, CoincidingEdgesAreTheSubjects)
{
  // but for round-off the same: the subject as it is, nothing of its neighbour
  const Polygon same = shifted(unit_square, 1e-15, -1e-15);
  EXPECT_EQ(intersection<2>(unit_square, same), unit_square);
  EXPECT_TRUE(intersection<2>(unit_square, shifted(unit_square, 1. - 1e-15, 0.)).empty());
}

TEST(Clip, PiecesOfATilingAddUp)
{
  // sheared squares cover the plane
  double total = 0.;
  for (int i = -3; i <= 3; ++i)
    for (int j = -3; j <= 3; ++j)
      {
        Polygon cell = shifted(unit_square, 0.7 * i, 0.7 * j);
        for (auto &vertex : cell)
          {
            const double x = vertex[0], y = vertex[1];
            vertex[0] = 0.8 * x - 0.5 * y + 0.137;
            vertex[1] = 0.5 * x + 0.8 * y - 0.219;
          }
        for (int c = 0; c < 4; ++c)
          for (int d = 0; d < 2; ++d)
            cell[c][d] = cell[0][d] + 0.7 * (cell[c][d] - cell[0][d]);
        total += overlap(unit_square, cell);
      }
  EXPECT_NEAR(total, 1., 1e-14);
}

TEST(Differential, ElementaryFunctions)
{
  Differential<2> x = 0.7, y = -1.3;
  x.slope[0] = y.slope[1]    = 1.;
  const Differential<2> f    = sqrt(x * x + 2. * y * y) / (x - y) - x * 3.;
  const double          root = std::sqrt(0.49 + 2 * 1.69), d = 2.;
  EXPECT_NEAR(f.value, root / d - 2.1, 1e-15);
  EXPECT_NEAR(f.slope[0], 0.7 / root / d - root / d / d - 3., 1e-15);
  EXPECT_NEAR(f.slope[1], -2.6 / root / d + root / d / d, 1e-15);
}

TEST(FaceMap, FoldedFaceIsTangled)
{
  const std::vector<FaceCoordinates<3, double>> line(4, {{0.3, 0.4}});
  EXPECT_THROW((PlaneFace<3, double>(1, line).coordinates({{0., 0.}})), TangledMesh);
}
