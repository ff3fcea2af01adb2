#include "grid_text.h"

#include <snug/geometry/block_geometry.h>
#include <snug/geometry/block_quality.h>

#include <deal.II/base/numbers.h>

using namespace snug;
using namespace snug::test;
using dealii::Point;
using Vector = dealii::Tensor<1, 3>;

namespace {
const double pi = dealii::numbers::PI;

/// In [0,1], equal ends, steps of very different size.
double uneven(double s, unsigned int n)
{
  const double i = s * n;
  return s + 0.3 / n * std::sin(2.3 * i * i) * (i > 0.5 && i < n - 0.5 ? 1. : 0.);
}

/// Layers from 60 % of an ellipse to the ellipse, all around or a part.
GridText ellipse(unsigned int n, double a, double b, bool closed, bool simplices = false)
{
  GridText grid;
  grid.n         = {n, 2};
  grid.closed    = closed;
  grid.simplices = simplices;
  grid.map       = [=](const Point<3> &u) {
    const double phi = -(closed ? 2. * pi : 2.) * uneven(u[0], n), r = 0.6 + 0.4 * u[2];
    return Point<3>(1. + r * a * std::cos(phi), 2. + r * b * std::sin(phi), 0.);
  };
  return grid;
}

double from_ellipse(const Point<2> &x, double a, double b)
{
  const double u = (x[0] - 1.) / a, v = (x[1] - 2.) / b, f = u * u + v * v - 1.;
  return std::abs(f) / (2. * std::sqrt(u * u / (a * a) + v * v / (b * b)));
}

/// Largest distance of the boundary "top" from a true shape.
template <int dim>
double error(const geometry::BodyGeometry<dim>               &body,
             const std::function<double(const Point<dim> &)> &distance)
{
  double largest = 0.;
  on_boundary<dim>(body, "top", [&](const Point<dim> &x, unsigned int, unsigned int) {
    largest = std::max(largest, std::abs(distance(x)));
  });
  return largest;
}

/// Where cells share a face or an edge they have the same points.
void expect_continuous(const geometry::BodyGeometry<3> &body)
{
  const auto                                    mesh = body.coarse_mesh();
  std::map<std::vector<unsigned int>, Point<3>> seen;
  using Info         = dealii::GeometryInfo<3>;
  unsigned int twice = 0;
  for (unsigned int c = 0; c < mesh.cells.size(); ++c)
    {
      const auto compare = [&](std::vector<unsigned int> local) {
        // coordinates by vertices in ascending order of their numbers
        std::sort(local.begin(), local.end(), [&](unsigned int a, unsigned int b) {
          return mesh.cells[c][a] < mesh.cells[c][b];
        });
        const Point<3>            origin = Info::unit_cell_vertex(local[0]);
        std::vector<unsigned int> key    = {mesh.cells[c][local[0]]};
        Point<3>                  unit   = origin;
        double                    part   = 0.3;
        for (const unsigned int v : local)
          if (origin.distance(Info::unit_cell_vertex(v)) == 1.)
            {
              unit += part * (Info::unit_cell_vertex(v) - origin);
              part += 0.4;
              key.push_back(mesh.cells[c][v]);
            }
        const auto x     = body.position({c, unit});
        const auto entry = seen.emplace(key, x);
        twice += !entry.second;
        EXPECT_NEAR(x.distance(entry.first->second), 0., 1e-13) << x;
      };
      for (unsigned int e = 0; e < Info::lines_per_cell; ++e)
        compare({Info::line_to_cell_vertices(e, 0), Info::line_to_cell_vertices(e, 1)});
      for (unsigned int f = 0; f < 6; ++f)
        compare({Info::face_to_cell_vertices(f, 0), Info::face_to_cell_vertices(f, 1),
                 Info::face_to_cell_vertices(f, 2), Info::face_to_cell_vertices(f, 3)});
      for (unsigned int v = 0; v < 8; ++v)
        EXPECT_NEAR(
          body.position({c, Info::unit_cell_vertex(v)}).distance(mesh.vertices[mesh.cells[c][v]]),
          0., 1e-13);
    }
  EXPECT_GT(twice, mesh.cells.size());
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
                       bool                                           convex,
                       const std::function<double(const Point<3> &)> &distance)
{
  const auto body     = make<3>(grid, grid.body());
  const auto surfaces = body->known_surfaces();
  EXPECT_LT(error<3>(*body, distance), 3e-14);
  on_boundary<3>(*body, "top", [&](const Point<3> &x, unsigned int cell, unsigned int face) {
    const unsigned int index = body->known_surface(cell, face);
    ASSERT_LT(index, surfaces.size());
    EXPECT_EQ(surfaces[index].kind, kind);
    EXPECT_EQ(surfaces[index].convex, convex);
    EXPECT_LT(std::abs(surfaces[index].distance(x)), 3e-14);
  });
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
        EXPECT_TRUE(surfaces[body->known_surface(cell, face)].convex);
      });
    }
  // the inner circle of the ring is a hole, called free
  const auto grid = ellipse(40, 2., 2., true);
  const auto body = make<2>(grid, grid.body());
  on_boundary<2>(*body, "free", [&](const Point<2> &, unsigned int cell, unsigned int face) {
    EXPECT_FALSE(body->known_surfaces()[body->known_surface(cell, face)].convex);
  });
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
        const bool convex = out > 0.;
        const auto depth  = [out](double w) { return 0.5 * out * (w - 1.); };
        expect_recognized(wall(axis, 8, simplices,
                               [&](double v, double w) {
                                 return std::array<double, 2>{{2. + depth(w), 3. * v}};
                               }),
                          Kind::cylinder, convex,
                          [&](const Point<3> &x) { return radial(x)[0] - 2.; });
        expect_recognized(wall(axis, 8, simplices,
                               [&](double v, double w) {
                                 const double t = 0.3 + 1.5 * v, r = 2. + depth(w);
                                 return std::array<double, 2>{{r * std::sin(t), r * std::cos(t)}};
                               }),
                          Kind::sphere, convex, [&](const Point<3> &x) {
                            return x.distance(Point<3>(3., -2., 1.)) - 2.;
                          });
        expect_recognized(wall(axis, 8, simplices,
                               [&](double v, double w) {
                                 return std::array<double, 2>{{1. + v + depth(w), 2. * v}};
                               }),
                          Kind::cone, convex, [&](const Point<3> &x) {
                            return (radial(x)[0] - 1. - radial(x)[1] / 2.) * 2. / std::sqrt(5.);
                          });
        expect_recognized(
          wall(axis, 8, simplices,
               [&](double v, double w) {
                 const double t = 0.3 + 1.5 * v, r = 1. + depth(w);
                 return std::array<double, 2>{{4. + r * std::sin(t), r * std::cos(t)}};
               }),
          Kind::torus, convex,
          [&](const Point<3> &x) { return std::hypot(radial(x)[0] - 4., radial(x)[1]) - 1.; });
      }
}

TEST(CurvedSurfaces, SmoothSurfacesConverge)
{
  for (const bool simplices : {false, true})
    {
      double last = 0.;
      for (const unsigned int n : {8, 16, 32})
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
          if (n == 8)
            expect_continuous(*body);
          // the other faces lie in planes and stay there, in part exactly
          on_boundary<3>(*body, "free", [&](const Point<3> &x, unsigned int, unsigned int) {
            const double off = std::min({std::abs(x[0]), std::abs(x[0] - 1.), std::abs(x[1]),
                                         std::abs(x[1] - 1.), std::abs(x[2])});
            EXPECT_LT(off, 1e-15);
          });
        }
      EXPECT_LT(last, 1e-5); // facets: 2e-4
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

TEST(CurvedSurfaces, PlaneRegionsOfASmoothBoundaryStay)
{
  // a slot: straight sides of length 4, ends of radius 1
  GridText           grid;
  const unsigned int n = 72;
  grid.n               = {n, 1};
  grid.closed          = true;
  grid.map             = [=](const Point<3> &u) {
    const double r = 0.5 + 0.5 * u[2], i = u[0] * n;
    const double phi = -(i < 18 ? i : i < 36 ? 18 : i < 54 ? i - 18 : 36) * pi / 18. + pi / 2.;
    const double x   = i < 18   ? 2.
                                   : i < 36 ? 2. - (i - 18) * 4. / 18.
                                   : i < 54 ? -2.
                                            : -2. + (i - 54) * 4. / 18.;
    return Point<3>(x + r * std::cos(phi), r * std::sin(phi), 0.);
  };
  const auto body = make<2>(grid, grid.body());
  const auto from = [](const Point<2> &x) {
    return std::hypot(std::max(0., std::abs(x[0]) - 2.), x[1]) - 1.;
  };
  EXPECT_LT(error<2>(*body, from), 1e-6);
  on_boundary<2>(*body, "top", [&](const Point<2> &x, unsigned int, unsigned int) {
    if (std::abs(x[0]) < 2. - 1e-10)
      {
        EXPECT_NEAR(std::abs(x[1]), 1., 2e-16);
      }
  });
}

TEST(CurvedSurfaces, CoarseFacetsStayUnlessSmoothIsAskedFor)
{
  const auto grid = ellipse(20, 2., 2., true); // unequal, up to 28 degrees
  auto       body = grid.body();
  EXPECT_TRUE(says(notes<2>(grid, body), "boundary top stays facets, as these turn by up to"));
  EXPECT_TRUE(says(notes<2>(grid, body), "'Surface = top: smooth' smooths it"));
  const auto circle = [](const Point<2> &x) { return x.distance(Point<2>(1., 2.)) - 2.; };
  EXPECT_GT(error<2>(*make<2>(grid, body), circle), 1e-2);
  body.surfaces = {{"top", "smooth"}};
  EXPECT_LT(error<2>(*make<2>(grid, body), circle), 1e-5);
  for (const std::string value : {"round", ""})
    {
      body.surfaces = {{"top", value}};
      EXPECT_NE(complaint(grid.text(), body, 2).find("'Surface'"), std::string::npos);
    }
  body.surfaces = {{"bottom", "facets"}};
  EXPECT_NE(complaint(grid.text(), body, 2).find("the faces are"), std::string::npos);
}

TEST(CurvedSurfaces, FeaturesAreKept)
{
  // a cylinder with plane ends: their edges are circles from both sides
  for (const bool simplices : {false, true})
    {
      GridText grid;
      grid.n         = {36, 3, 2};
      grid.closed    = true;
      grid.simplices = simplices;
      grid.map       = [](const Point<3> &u) {
        const double phi = 2. * pi * uneven(u[0], 36), r = 1. + u[2];
        return Point<3>(r * std::cos(phi), r * std::sin(phi), -2. * u[1]);
      };
      const auto body = make<3>(grid, grid.body());
      expect_continuous(*body);
      EXPECT_EQ(body->known_surfaces().size(), 2u);
      on_boundary<3>(*body, "top", [&](const Point<3> &x, unsigned int cell, unsigned int face) {
        EXPECT_NEAR(std::hypot(x[0], x[1]), 2., 5e-15);
        EXPECT_TRUE(body->known_surface(cell, face) < 2);
      });
      on_boundary<3>(*body, "free", [&](const Point<3> &x, unsigned int, unsigned int) {
        EXPECT_TRUE(x[2] == 0. || x[2] == -2. || std::abs(std::hypot(x[0], x[1]) - 1.) < 5e-15);
      });
    }
  // two arcs that meet at 90 degrees: each has its own tangent there
  GridText lens;
  lens.n      = {40, 1};
  lens.closed = true;
  lens.map    = [](const Point<3> &u) {
    const double i = u[0] * 40., sign = i < 20. ? 1. : -1., t = (i < 20. ? i : i - 20.) / 20.;
    const double phi = pi / 4. + pi / 2. * t, r = 0.5 + 0.5 * u[2];
    return Point<3>(-sign * r * std::cos(phi), sign * r * (std::sin(phi) - std::sqrt(0.5)), 0.);
  };
  const auto body = make<2>(lens, lens.body());
  EXPECT_LT(error<2>(*body,
                     [](const Point<2> &x) {
                       return std::hypot(x[0], std::abs(x[1]) + std::sqrt(0.5)) - 1.;
                     }),
            1e-14);
}

TEST(CurvedSurfaces, ThinCellsAreNotTangled)
{
  // the arc of the hole would reach across the cells, which are half as thick as its height
  GridText           grid;
  const unsigned int n = 30;
  grid.n               = {n, 2};
  grid.closed          = true;
  grid.map             = [](const Point<3> &u) {
    const double phi = 2. * pi * u[0], h = 1. - std::cos(pi / n);
    const double r = u[2] == 1. ? 1. : u[2] == 0. ? 1.5 : 1. + 0.5 * h;
    return Point<3>(r * std::cos(phi), r * std::sin(phi), 0.);
  };
  const auto mesh = mesh_file::import_mesh(grid.text(), grid.body(), 2);
  EXPECT_TRUE(says(mesh->notes, "of thin cells brought nearer to straight ones"));
  for (const auto &block : mesh->flat->blocks)
    {
      const double straight = geometry::least_scaled_jacobian<2>(mesh->flat->vertices, block, {});
      EXPECT_GE(geometry::least_scaled_jacobian<2>(mesh->flat->vertices, block, mesh->flat->pieces),
                0.2 * straight);
    }
}
