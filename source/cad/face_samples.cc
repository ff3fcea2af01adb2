#include <snug/cad/face_samples.h>

#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <Geom2dAdaptor_Curve.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>

#include <algorithm>

namespace snug::cad {
FaceBorder::FaceBorder(const TopoDS_Face &face)
{
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
          segments.push_back({a, b});
          a = b;
        }
    }
}

std::vector<double> FaceBorder::crossings(const double u) const
{
  std::vector<double> result;
  for (const auto &[a, b] : segments)
    if ((a.X() <= u) != (b.X() <= u))
      result.push_back(a.Y() + (u - a.X()) / (b.X() - a.X()) * (b.Y() - a.Y()));
  std::sort(result.begin(), result.end());
  return result;
}

bool FaceBorder::encloses(const double v, const std::vector<double> &crossings) const
{
  const auto above = std::lower_bound(crossings.begin(), crossings.end(), v);
  // A face without edges is a whole closed surface.
  return segments.empty() || (above - crossings.begin()) % 2 == 1;
}

std::vector<gp_Pnt2d>
samples_inside(const TopoDS_Face &face, const unsigned int n, const unsigned int m)
{
  double u, v, du, dv;
  BRepTools::UVBounds(face, u, du, v, dv);
  du -= u;
  dv -= v;
  const FaceBorder border(face);
  // A sample on the border of the grid may lie on an edge, where rounding would determine whether
  // it is inside. Each sample is tested slightly closer to the middle.
  const auto within = [](const unsigned int i, const unsigned int n) {
    return 0.5 + (1. - 1e-7) * (1. * i / n - 0.5);
  };
  std::vector<gp_Pnt2d> result;
  for (unsigned int i = 0; i <= n; ++i)
    {
      const auto at = border.crossings(u + du * within(i, n));
      for (unsigned int j = 0; j <= m; ++j)
        if (border.encloses(v + dv * within(j, m), at))
          result.emplace_back(u + du * i / n, v + dv * j / m);
    }
  return result;
}
} // namespace snug::cad
