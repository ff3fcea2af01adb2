#include <snug/cad/face_samples.h>
#include <snug/cad/part.h>
#include <snug/cad/surface_projection.h>

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <GeomAPI_PointsToBSplineSurface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopoDS.hxx>

#include <gtest/gtest.h>

#include <cmath>
#include <ctime>

using namespace snug;

namespace {
/// Return a face with a B-spline surface in waves, 10 by 10.
TopoDS_Face wavy_face()
{
  const unsigned int n = 13;
  TColgp_Array2OfPnt points(1, n, 1, n);
  for (unsigned int i = 1; i <= n; ++i)
    for (unsigned int j = 1; j <= n; ++j)
      {
        const double x = 10. * (i - 1) / (n - 1), y = 10. * (j - 1) / (n - 1);
        points(i, j) = gp_Pnt(x, y, std::sin(0.8 * x) * std::cos(0.7 * y));
      }
  return BRepBuilderAPI_MakeFace(GeomAPI_PointsToBSplineSurface(points).Surface(), 1e-9);
}

/// Return points up to 0.3 beside a face, also beyond its edges.
std::vector<gp_Pnt> points_near(const TopoDS_Face &face, const unsigned int n)
{
  const auto          surface = BRep_Tool::Surface(face);
  std::vector<gp_Pnt> result;
  double              u, v, first, first_v;
  surface->Bounds(first, u, first_v, v);
  for (unsigned int k = 0; k < n; ++k)
    {
      const auto random = [&](const double a) { return std::fmod(a * (k + 1), 1.); };
      gp_Pnt     x      = surface->Value(first + (u - first) * random(0.754877666),
                                         first_v + (v - first_v) * random(0.569840291));
      x.Translate({0.6 * random(0.41) - 0.3, 0.6 * random(0.37) - 0.3, 0.6 * random(0.29) - 0.3});
      result.push_back(x);
    }
  return result;
}
} // namespace

/// OpenCASCADE's search of the whole surface finds no closer point.
TEST(Surfaces, projections_are_the_closest_points)
{
  const auto                   face = wavy_face();
  const cad::SurfaceProjection projection(face);
  const auto                   surface = BRep_Tool::Surface(face);
  ShapeAnalysis_Surface        search(surface);
  for (const auto &x : points_near(face, 60))
    {
      const auto     on     = projection.project({x.X(), x.Y(), x.Z()});
      const gp_Pnt2d at     = search.ValueOfUV(x, 1e-12);
      const gp_Pnt   closer = surface->Value(at.X(), at.Y());
      EXPECT_LT(x.Distance({on[0], on[1], on[2]}), x.Distance(closer) + 1e-9);
    }
}

/// OpenCASCADE's search of the whole surface takes 3 s for these points on the computer on which
/// the projections take 0.1 s.
TEST(Surfaces, projections_do_not_search_the_whole_surface)
{
  const auto                   face = wavy_face();
  const cad::SurfaceProjection projection(face);
  const auto                   points = points_near(face, 10000);
  const auto                   start  = std::clock();
  double                       sum    = 0.;
  for (const auto &x : points)
    sum += projection.project({x.X(), x.Y(), x.Z()})[0];
  EXPECT_NEAR(sum / points.size(), 5., 0.5);
  EXPECT_LT(1. * (std::clock() - start) / CLOCKS_PER_SEC, 1.);
}

/// The face lies above the parabola y = x^2, below y = 1 and outside of a circle.
TEST(Surfaces, samples_lie_inside_of_the_edges)
{
  const auto         part    = cad::read_part(SNUG_MESHES "parabola.step", 0, 2);
  const auto         face    = TopoDS::Face(part.shape);
  const auto         surface = BRep_Tool::Surface(face);
  const unsigned int n       = 200;
  const auto         inside  = cad::samples_inside(face, n, n);
  for (const auto &at : inside)
    {
      const gp_Pnt x = surface->Value(at.X(), at.Y());
      EXPECT_GT(x.Y() - x.X() * x.X(), -1e-3);
      EXPECT_LT(x.Y(), 1. + 1e-9);
      EXPECT_GT(std::hypot(x.X(), x.Y() - 0.6), 0.15 - 1e-3);
    }
  double u, v, last_u, last_v;
  BRepTools::UVBounds(face, u, last_u, v, last_v);
  EXPECT_NEAR(inside.size() * (last_u - u) * (last_v - v) / (n * n), 4. / 3. - M_PI * 0.15 * 0.15,
              0.02);
}
