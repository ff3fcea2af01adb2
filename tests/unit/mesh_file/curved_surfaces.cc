#include "grid_text.h"

#include <snug/geometry/block_geometry.h>
#include <snug/geometry/block_quality.h>

#include <deal.II/base/numbers.h>

using namespace snug;
using namespace snug::test;
using dealii::Point;
using Vector = dealii::Tensor<1, 3>;

namespace {
double from_ellipse(const Point<2> &x, double a, double b)
{
  const double u = (x[0] - 1.) / a, v = (x[1] - 2.) / b, f = u * u + v * v - 1.;
  return std::abs(f) / (2. * std::sqrt(u * u / (a * a) + v * v / (b * b)));
}

/// A frame with z along @p axis.
std::array<Vector, 3> frame(const Vector &axis)
{
  std::array<Vector, 3> e;
  e[2] = axis / axis.norm();
  e[0] = cross_product_3d(e[2], Vector({0.3, -0.8, 0.5}));
  e[0] /= e[0].norm();
  e[1] = cross_product_3d(e[2], e[0]);
  return e;
}

/// A wall with the surface x(u, v) of revolution about an axis, given by (radius, height) as a
/// function of v and w, w = 1 the surface; over an angle of 100 degrees.
GridText wall(const Vector                                               &axis,
              unsigned int                                                n,
              bool                                                        simplices,
              const std::function<std::array<double, 2>(double, double)> &section)
{
  GridText grid;
  grid.n         = {n, n, 1};
  grid.simplices = simplices;
  const auto e   = frame(axis);
  grid.map       = [=](const Point<3> &u) {
    const double phi = 1.75 * uneven(u[0], n);
    const auto   rz  = section(uneven(u[1], n), u[2]);
    return Point<3>(Vector({3., -2., 1.}) + rz[0] * (std::cos(phi) * e[0] + std::sin(phi) * e[1]) +
                          rz[1] * e[2]);
  };
  return grid;
}

void expect_recognized(const GridText                                &grid,
                       geometry::KnownSurface<3>::Kind                kind,
                       bool                                           encloses_body,
                       const std::function<double(const Point<3> &)> &distance)
{
  const auto body     = make<3>(grid, grid.body());
  const auto surfaces = body->known_surfaces();
  EXPECT_LT(error<3>(*body, distance), 3e-14);
  on_boundary<3>(*body, "top", [&](const Point<3> &x, unsigned int cell, unsigned int face) {
    const unsigned int index = body->known_surface(cell, face);
    ASSERT_LT(index, surfaces.size());
    EXPECT_EQ(surfaces[index].kind, kind);
    EXPECT_EQ(surfaces[index].encloses_body, encloses_body);
    EXPECT_LT(std::abs(surfaces[index].distance(x)), 3e-14);
  });
  if (kind == geometry::KnownSurface<3>::Kind::torus && encloses_body)
    expect_continuous(*body);
}
} // namespace

TEST(CurvedSurfaces, PlaneCurvesAreOfFourthOrder)
{
  for (const bool closed : {true, false})
    for (const bool simplices : {false, true})
      {
        const auto distance = [](const Point<2> &x) { return from_ellipse(x, 2., 1.3); };
        double     last     = 0.;
        for (const unsigned int n : {40, 80, 160})
          {
            const auto   grid = ellipse(n, 2., 1.3, closed, simplices);
            const double now  = error<2>(*make<2>(grid, grid.body()), distance);
            if (last > 0.)
              {
                EXPECT_LT(now, last / 11.) << n << closed;
              }
            last = now;
          }
        EXPECT_LT(last, 3e-7);
        auto facets            = ellipse(160, 2., 1.3, closed, simplices).body();
        facets.surfaces["top"] = "facets";
        EXPECT_GT(error<2>(*make<2>(ellipse(160, 2., 1.3, closed, simplices), facets), distance),
                  8e-5);
      }
}

TEST(CurvedSurfaces, CirclesAreRecognized)
{
  for (const bool closed : {true, false})
    {
      const auto grid = ellipse(40, 2., 2., closed);
      const auto body = make<2>(grid, grid.body());
      EXPECT_LT(error<2>(*body,
                         [](const Point<2> &x) { return x.distance(Point<2>(1., 2.)) - 2.; }),
                5e-15);
      EXPECT_TRUE(says(notes<2>(grid, grid.body()), "boundary top is a circle of radius 2 ("));
      const auto surfaces = body->known_surfaces();
      on_boundary<2>(*body, "top", [&](const Point<2> &, unsigned int cell, unsigned int face) {
        ASSERT_LT(body->known_surface(cell, face), surfaces.size());
        EXPECT_TRUE(surfaces[body->known_surface(cell, face)].encloses_body);
      });
    }
  // the inner circle of the ring is a hole, called free
  const auto grid = ellipse(40, 2., 2., true);
  const auto body = make<2>(grid, grid.body());
  on_boundary<2>(*body, "free", [&](const Point<2> &, unsigned int cell, unsigned int face) {
    EXPECT_FALSE(body->known_surfaces()[body->known_surface(cell, face)].encloses_body);
  });
}

TEST(CurvedSurfaces, BoundariesAreNamedAndFacetsMeasured)
{
  const auto shape = [](const GridText &grid, const std::string &surface, double scale = 1.) {
    auto body = grid.body();
    if (!surface.empty())
      body.surfaces["top"] = surface;
    body.scale = scale;
    return make<2>(grid, body)->boundary_shape(0);
  };
  const auto circle = ellipse(40, 2., 2., true);
  EXPECT_EQ(shape(circle, "").name, "circle");
  EXPECT_EQ(shape(circle, "").facet_height, 0.);
  EXPECT_EQ(shape(ellipse(40, 2., 1.3, true), "smooth").name, "smooth");
  const auto facets = shape(circle, "facets");
  EXPECT_EQ(facets.name, "facets");
  // The largest sagitta; the formula takes neighbours for equally long, which they are not here.
  auto body            = circle.body();
  body.surfaces["top"] = "facets";
  const double highest = error<2>(*make<2>(circle, body), [](const Point<2> &x) {
    return x.distance(Point<2>(1., 2.)) - 2.;
  });
  EXPECT_NEAR(facets.facet_height, highest, 0.4 * highest);
  EXPECT_NEAR(shape(circle, "facets", 5.).facet_height, 5. * facets.facet_height, 1e-14);
  // A boundary of few facets is kept faceted by default if it is not round.
  EXPECT_EQ(shape(ellipse(20, 2., 1.8, true), "").name, "facets");
  EXPECT_GT(shape(ellipse(20, 2., 1.8, true), "").facet_height, 0.02);
}

TEST(CurvedSurfaces, DigitsAreForgivenNoiseIsNot)
{
  auto grid   = ellipse(40, 20., 20., true);
  grid.digits = 6;
  EXPECT_TRUE(says(notes<2>(grid, grid.body()), "boundary top is a circle of radius 20 ("));
  const auto body   = make<2>(grid, grid.body());
  const auto circle = body->known_surfaces()[body->known_surface(40, 3)];
  // nodes too lie on it to the last digit
  EXPECT_LT(error<2>(*body, [&](const Point<2> &x) { return circle.distance(x); }), 2e-14);
  EXPECT_NEAR(circle.centre.distance(Point<2>(1., 2.)), 0., 1e-4);
  grid.digits    = 17;
  const auto map = grid.map;
  grid.map       = [map](const Point<3> &u) {
    const auto x = map(u);
    return Point<3>(x[0] + 2e-4 * std::sin(1e3 * x[1]), x[1], 0.);
  };
  EXPECT_TRUE(says(notes<2>(grid, grid.body()), "boundary top is a smooth surface"));
}

TEST(CurvedSurfaces, SurfacesOfRevolutionAreRecognized)
{
  using Kind = geometry::KnownSurface<3>::Kind;
  const Vector axis({0.4, -0.7, 0.9});
  const auto   e      = frame(axis);
  const auto   radial = [e](const Point<3> &x) {
    const Vector y = x - Point<3>(3., -2., 1.);
    return std::array<double, 2>{{(y - (y * e[2]) * e[2]).norm(), y * e[2]}};
  };
  for (const bool simplices : {false, true})
    for (const double out : {1., -1.})
      {
        const bool encloses_body = out > 0.;
        if (simplices && !encloses_body)
          continue;
        const auto depth = [out](double w) { return 0.5 * out * (w - 1.); };
        expect_recognized(wall(axis, 10, simplices,
                               [&](double v, double w) {
                                 return std::array<double, 2>{{2. + depth(w), 3. * v}};
                               }),
                          Kind::cylinder, encloses_body,
                          [&](const Point<3> &x) { return radial(x)[0] - 2.; });
        expect_recognized(wall(axis, 10, simplices,
                               [&](double v, double w) {
                                 const double t = 0.3 + 1.5 * v, r = 2. + depth(w);
                                 return std::array<double, 2>{{r * std::sin(t), r * std::cos(t)}};
                               }),
                          Kind::sphere, encloses_body, [&](const Point<3> &x) {
                            return x.distance(Point<3>(3., -2., 1.)) - 2.;
                          });
        expect_recognized(wall(axis, 10, simplices,
                               [&](double v, double w) {
                                 return std::array<double, 2>{{1. + v + depth(w), 2. * v}};
                               }),
                          Kind::cone, encloses_body, [&](const Point<3> &x) {
                            return (radial(x)[0] - 1. - radial(x)[1] / 2.) * 2. / std::sqrt(5.);
                          });
        expect_recognized(wall(axis, 10, simplices,
                               [&](double v, double w) {
                                 const double t = 0.3 + 1.5 * v, r = 1. + depth(w);
                                 return std::array<double, 2>{
                                   {4. + r * std::sin(t), r * std::cos(t)}};
                               }),
                          Kind::torus, encloses_body, [&](const Point<3> &x) {
                            return std::hypot(radial(x)[0] - 4., radial(x)[1]) - 1.;
                          });
      }
}

TEST(CurvedSurfaces, SmoothSurfacesConverge)
{
  for (const bool simplices : {false, true})
    {
      double last = 0.;
      for (const unsigned int n : {6, 12, 24})
        {
          GridText grid;
          grid.n         = {n, n, 1};
          grid.simplices = simplices;
          const auto z   = [](double x, double y) {
            return 0.15 * std::sin(2. * x + y) + 0.1 * x * y * y;
          };
          grid.map = [=](const Point<3> &u) {
            const double x = uneven(u[0], n), y = uneven(u[1], n);
            return Point<3>(x, y, u[2] * (1. + z(x, y)));
          };
          const auto   body = make<3>(grid, grid.body());
          const double now =
            error<3>(*body, [&](const Point<3> &x) { return x[2] - 1. - z(x[0], x[1]); });
          if (last > 0.)
            {
              EXPECT_LT(now, last / 6.) << simplices << n;
            }
          last = now;
          if (n == 6)
            expect_continuous(*body);
          // the other faces lie in planes and stay there, in part exactly
          on_boundary<3>(*body, "free", [&](const Point<3> &x, unsigned int, unsigned int) {
            const double off = std::min({std::abs(x[0]), std::abs(x[0] - 1.), std::abs(x[1]),
                                         std::abs(x[1] - 1.), std::abs(x[2])});
            EXPECT_LT(off, 1e-15);
          });
        }
      EXPECT_LT(last, 3e-5); // facets: 4e-4
    }
}

TEST(CurvedSurfaces, PlaneFacesStayBitForBit)
{
  for (const bool simplices : {false, true})
    {
      GridText grid;
      grid.n         = {3, 2, 2};
      grid.simplices = simplices;
      grid.map       = [](const Point<3> &u) {
        return Point<3>(0.1 + u[0] * 0.7, u[1] / 3. + 0.2 * u[0], 0.3 * u[2] - u[0]);
      };
      auto       body = grid.body();
      const auto mesh = mesh_file::import_mesh(grid.text(), body, 3)->solid;
      EXPECT_TRUE(mesh->pieces.empty());
      EXPECT_TRUE(mesh->known.empty());
      EXPECT_TRUE(mesh_file::import_mesh(grid.text(), body, 3)->notes.size() ==
                  (simplices ? 1 : 0));
    }
}
