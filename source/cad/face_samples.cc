#include <snug/cad/face_samples.h>

#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <Geom2dAdaptor_Curve.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>

#include <algorithm>

namespace snug::cad {
namespace {
struct Segment
{
  gp_Pnt2d a, b;
};

/// Return the edges of a face as segments in the plane of its parameters.
std::vector<Segment> border(const TopoDS_Face &face)
{
  std::vector<Segment> result;
  for (TopExp_Explorer edges(face, TopAbs_EDGE); edges.More(); edges.Next())
    {
      const TopoDS_Edge &edge = TopoDS::Edge(edges.Current());
      double             first, last;
      const auto         curve = BRep_Tool::CurveOnSurface(edge, face, first, last);
      if (curve.IsNull() || edge.Orientation() == TopAbs_INTERNAL ||
          edge.Orientation() == TopAbs_EXTERNAL)
        continue;
      const bool         is_line = Geom2dAdaptor_Curve(curve).GetType() == GeomAbs_Line;
      const unsigned int n       = is_line ? 1 : 100;
      gp_Pnt2d           a       = curve->Value(first);
      for (unsigned int i = 1; i <= n; ++i)
        {
          const gp_Pnt2d b = curve->Value(first + (last - first) * i / n);
          result.push_back({a, b});
          a = b;
        }
    }
  return result;
}

/// Return the ascending v at which the line of a constant u crosses the segments.
std::vector<double> crossings(const std::vector<Segment> &segments, const double u)
{
  std::vector<double> result;
  for (const auto &[a, b] : segments)
    if ((a.X() <= u) != (b.X() <= u))
      result.push_back(a.Y() + (u - a.X()) / (b.X() - a.X()) * (b.Y() - a.Y()));
  std::sort(result.begin(), result.end());
  return result;
}
} // namespace

std::vector<gp_Pnt2d>
samples_inside(const TopoDS_Face &face, const unsigned int n, const unsigned int m)
{
  double u, v, du, dv;
  BRepTools::UVBounds(face, u, du, v, dv);
  du -= u;
  dv -= v;
  const auto segments = border(face);
  // A sample on the border of the grid may lie on an edge, where rounding would determine whether
  // it is inside. Each sample is tested slightly closer to the middle.
  const auto within = [](const unsigned int i, const unsigned int n) {
    return 0.5 + (1. - 1e-7) * (1. * i / n - 0.5);
  };
  std::vector<gp_Pnt2d> result;
  for (unsigned int i = 0; i <= n; ++i)
    {
      const auto at = crossings(segments, u + du * within(i, n));
      for (unsigned int j = 0; j <= m; ++j)
        {
          const auto n_below = std::lower_bound(at.begin(), at.end(), v + dv * within(j, m));
          // A face without edges is a whole closed surface.
          if (segments.empty() || (n_below - at.begin()) % 2 == 1)
            result.emplace_back(u + du * i / n, v + dv * j / m);
        }
    }
  return result;
}
} // namespace snug::cad
