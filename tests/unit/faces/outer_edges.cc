#include "one_box.h"

#include <snug/faces/outer_edges.h>

#include <gtest/gtest.h>

using namespace snug;
using namespace snug::faces;

namespace {
/// Return the excess of the point (x, y) in the plane of the top at its closest point, which is the
/// point with coordinates clamped to the unit square.
double excess(const BoxTop<3> &box, double x, double y)
{
  const OuterEdges<3>  edges(box.surface, box.faces, box.shape);
  const auto           clamped = [](double c) { return std::min(1., std::max(0., c)); };
  dealii::Tensor<1, 3> closest, p;
  p[0] = x;
  p[1] = y;
  p[2] = closest[2] = 1.;
  closest[0]        = clamped(x);
  closest[1]        = clamped(y);
  double largest    = 0.;
  for (const unsigned int f : box.faces)
    {
      const auto &nodes = box.surface.faces()[f].nodes;
      const auto  first = box.positions[nodes.front()], last = box.positions[nodes.back()];
      // Tops of boxes are along the axes, with either order of the coordinates.
      const auto       second = box.positions[nodes[box.shape.degree()]];
      const int        a      = std::abs(second[0] - first[0]) > 1e-10 ? 0 : 1;
      dealii::Point<2> xi;
      xi[0] = (closest[a] - first[a]) / (last[a] - first[a]);
      xi[1] = (closest[1 - a] - first[1 - a]) / (last[1 - a] - first[1 - a]);
      if (xi[0] > -1e-12 && xi[0] < 1. + 1e-12 && xi[1] > -1e-12 && xi[1] < 1. + 1e-12)
        largest = std::max(largest, edges.excess(f, xi, p - closest, box.positions));
    }
  return largest;
}
} // namespace

TEST(OuterEdges, ExcessIsTheDistanceInFaces)
{
  for (const unsigned int degree : {1, 2})
    for (const bool refined : {false, true})
      {
        const BoxTop<3> box(degree, refined);
        const double    fine = refined ? 0.125 : 0.25;
        EXPECT_NEAR(excess(box, -0.05, 0.3), 0.05 / 0.25, 1e-12);
        EXPECT_NEAR(excess(box, 1.05, 0.3), 0.05 / fine, 1e-12);
        EXPECT_NEAR(excess(box, 0.3, 1.02), 0.02 / 0.25, 1e-12);
        // At a corner the largest excess over the two edges counts.
        EXPECT_NEAR(excess(box, -0.05, -0.01), 0.05 / 0.25, 1e-12);
        EXPECT_NEAR(excess(box, -0.05, -0.08), 0.08 / 0.25, 1e-12);
        EXPECT_NEAR(excess(box, 1.02, 1.03), 0.03 / fine, 1e-12);
      }
}

TEST(OuterEdges, EdgesBetweenFacesAreNotTheEnd)
{
  for (const unsigned int degree : {1, 2})
    for (const bool refined : {false, true})
      {
        const BoxTop<3> box(degree, refined);
        // on an edge of equal faces, on the edge of coarse and fine faces, at nodes
        for (const double x : {0.25, 0.5, 0.75})
          for (const double y : {0.1, 0.25, 0.5, 0.6})
            EXPECT_EQ(excess(box, x, y), 0.);
      }
}

/// Nodes of a segment that ends at x = 1: in 2D edges are points.
TEST(OuterEdges, OfASegmentAreItsEnds)
{
  const BoxTop<2>      box(1, false);
  const OuterEdges<2>  edges(box.surface, box.faces, box.shape);
  dealii::Tensor<1, 2> right;
  right[0] = 0.05;
  for (const unsigned int f : box.faces)
    for (unsigned int k = 0; k < 2; ++k)
      {
        const double x     = box.positions[box.surface.faces()[f].nodes[k]][0];
        const double along = edges.excess(f, box.shape.node(k), right, box.positions);
        const double back  = edges.excess(f, box.shape.node(k), -right, box.positions);
        if (x == 1.)
          EXPECT_NEAR(along, 0.2, 1e-14);
        else
          EXPECT_LE(along, 0.);
        if (x == 0.)
          EXPECT_NEAR(back, 0.2, 1e-14);
        else
          EXPECT_LE(back, 0.);
      }
}
