#include "grid_text.h"

#include <snug/geometry/block_quality.h>

#include <iomanip>

using namespace snug;
using namespace snug::test;
using dealii::Point;

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
  // its wall in 3D
  for (const bool simplices : {false, true})
    {
      GridText solid;
      solid.n         = {n, 3, 1};
      solid.closed    = true;
      solid.simplices = simplices;
      solid.map       = [&](const Point<3> &u) {
        const auto x = grid.map(u);
        return Point<3>(x[0], x[1], -0.7 * u[1]);
      };
      const auto wall = make<3>(solid, solid.body());
      EXPECT_LT(error<3>(*wall, [&](const Point<3> &x) { return from(Point<2>(x[0], x[1])); }),
                1e-4); // facets: 4e-3
      on_boundary<3>(*wall, "top", [&](const Point<3> &x, unsigned int, unsigned int) {
        if (std::abs(x[0]) < 2. - 1e-10)
          {
            EXPECT_NEAR(std::abs(x[1]), 1., 2e-16);
          }
      });
      expect_continuous(*wall);
    }
}

TEST(CurvedSurfaces, CoarseFacetsStayUnlessSmoothIsAskedFor)
{
  const auto grid = ellipse(20, 2., 1.8, true); // unequal, up to 29 degrees
  auto       body = grid.body();
  EXPECT_TRUE(
    says(notes<2>(grid, body), "boundary top is kept faceted: neighbouring facets meet at up to"));
  EXPECT_TRUE(says(notes<2>(grid, body), "'Surface = top: smooth' makes it smooth"));
  const auto ellipse_of = [](const Point<2> &x) {
    return std::hypot((x[0] - 1.) / 2., (x[1] - 2.) / 1.8) - 1.;
  };
  EXPECT_GT(error<2>(*make<2>(grid, body), ellipse_of), 1e-2);
  body.surfaces = {{"top", "smooth"}};
  EXPECT_LT(error<2>(*make<2>(grid, body), ellipse_of), 2e-3);
}

TEST(CurvedSurfaces, CoarseFacetsOnACircleAreTheCircle)
{
  const auto grid = ellipse(20, 2., 2., true); // unequal, up to 28 degrees
  auto       body = grid.body();
  EXPECT_TRUE(says(notes<2>(grid, body), "boundary top is a circle of radius 2 ("));
  EXPECT_TRUE(says(notes<2>(grid, body), "although neighbouring facets meet at up to"));
  const auto circle = [](const Point<2> &x) { return x.distance(Point<2>(1., 2.)) - 2.; };
  EXPECT_LT(error<2>(*make<2>(grid, body), circle), 1e-14);
  body.surfaces = {{"top", "facets"}};
  EXPECT_GT(error<2>(*make<2>(grid, body), circle), 1e-2);
  for (const std::string value : {"round", ""})
    {
      body.surfaces = {{"top", value}};
      EXPECT_NE(failure_reason(grid.text(), body, 2).find("'Surface'"), std::string::npos);
    }
  body.surfaces = {{"bottom", "facets"}};
  EXPECT_NE(failure_reason(grid.text(), body, 2).find("the boundaries are top, free"),
            std::string::npos);
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
      // in a file of few digits, too
      grid.digits        = 6;
      const auto rounded = make<3>(grid, grid.body());
      expect_continuous(*rounded);
      on_boundary<3>(*rounded, "top", [&](const Point<3> &x, unsigned int cell, unsigned int face) {
        ASSERT_LT(rounded->known_surface(cell, face), 2u);
        EXPECT_LT(std::abs(
                    rounded->known_surfaces()[rounded->known_surface(cell, face)].distance(x)),
                  5e-15);
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
  // The middles of the curves move from the circle at 1 towards the chords.
  double distance = 0.;
  for (const auto &[vertices, piece] : mesh->flat->pieces)
    distance = std::max(distance, 1. - piece.patch->position({0.5, 0.}).norm());
  std::ostringstream text;
  text << std::setprecision(2) << distance;
  EXPECT_TRUE(says(mesh->warnings, "curved edges and faces were moved towards straight ones"));
  EXPECT_TRUE(says(mesh->warnings, "maximum distance from the true surface " + text.str()));
  for (const auto &block : mesh->flat->blocks)
    {
      const double straight = geometry::least_scaled_jacobian<2>(mesh->flat->vertices, block, {});
      EXPECT_GE(geometry::least_scaled_jacobian<2>(mesh->flat->vertices, block, mesh->flat->pieces),
                0.2 * straight);
    }
}
