#include <snug/cad/face_samples.h>
#include <snug/cad/size_field.h>

#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRepBndLib.hxx>
#include <BRepLProp_CLProps.hxx>
#include <BRepLProp_SLProps.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>

#include <algorithm>
#include <array>
#include <cmath>

namespace snug::cad {
namespace {
using Points = std::vector<dealii::Point<3>>;

/// Return the number of steps of at most @p step along a parameter of this range.
unsigned int steps(const double range, const double step)
{
  const double most = 1000.; // limits the time if a size is far too small
  return static_cast<unsigned int>(std::min(most, std::ceil(std::max(1., range / step))));
}

void add_edge(const TopoDS_Edge &edge, const double spacing, Points &points)
{
  if (BRep_Tool::Degenerated(edge))
    return;
  const BRepAdaptor_Curve curve(edge);
  const double            first = curve.FirstParameter(), range = curve.LastParameter() - first;
  const unsigned int      n = steps(range, curve.Resolution(spacing));
  for (unsigned int i = 0; i <= n; ++i)
    {
      const gp_Pnt x = curve.Value(first + range * i / n);
      points.emplace_back(x.X(), x.Y(), x.Z());
    }
}

/// Return the numbers of intervals of u and v whose lengths are at most @p spacing.
std::array<unsigned int, 2> intervals(const BRepAdaptor_Surface &surface, const double spacing)
{
  const double                u = surface.FirstUParameter(), du = surface.LastUParameter() - u;
  const double                v = surface.FirstVParameter(), dv = surface.LastVParameter() - v;
  std::array<unsigned int, 2> result = {
    {steps(du, surface.UResolution(spacing)), steps(dv, surface.VResolution(spacing))}};
  if (surface.GetType() != GeomAbs_BSplineSurface && surface.GetType() != GeomAbs_BezierSurface)
    return result;
  const unsigned int n       = 8;
  double             speed_u = 0., speed_v = 0.; // maxima of |S_u| and |S_v|
  for (unsigned int i = 0; i <= n; ++i)
    for (unsigned int j = 0; j <= n; ++j)
      {
        gp_Pnt on;
        gp_Vec along_u, along_v;
        surface.D1(u + du * i / n, v + dv * j / n, on, along_u, along_v);
        speed_u = std::max(speed_u, along_u.Magnitude());
        speed_v = std::max(speed_v, along_v.Magnitude());
      }
  // OpenCASCADE's bounds of the derivatives of a B-spline may be far too large, and the maxima of
  // samples slightly too small.
  result[0] = std::min(result[0], steps(1.1 * du * speed_u, spacing));
  result[1] = std::min(result[1], steps(1.1 * dv * speed_v, spacing));
  return result;
}

/// Add points of a regular grid of parameters inside of a face, and points of its edges.
void add_face(const TopoDS_Face &face, const double spacing, Points &points)
{
  const BRepAdaptor_Surface surface(face);
  const auto                n = intervals(surface, spacing);
  for (const auto &at : samples_inside(face, n[0], n[1]))
    {
      const gp_Pnt x = surface.Value(at.X(), at.Y());
      points.emplace_back(x.X(), x.Y(), x.Z());
    }
  for (TopExp_Explorer edges(face, TopAbs_EDGE); edges.More(); edges.Next())
    add_edge(TopoDS::Edge(edges.Current()), spacing, points);
}

const unsigned int n_samples = 8; ///< of the curvature along each parameter

double curvature(const TopoDS_Edge &edge)
{
  const BRepAdaptor_Curve curve(edge);
  double                  largest = 0.;
  for (unsigned int i = 0; i <= n_samples; ++i)
    {
      BRepLProp_CLProps properties(curve,
                                   curve.FirstParameter() +
                                     (curve.LastParameter() - curve.FirstParameter()) * i /
                                       n_samples,
                                   2, 1e-9);
      if (properties.IsTangentDefined())
        largest = std::max(largest, properties.Curvature());
    }
  return largest;
}

double curvature(const TopoDS_Face &face)
{
  const BRepAdaptor_Surface surface(face);
  if (surface.GetType() == GeomAbs_Plane)
    return 0.;
  double       largest = 0.;
  const double u = surface.FirstUParameter(), du = surface.LastUParameter() - u;
  const double v = surface.FirstVParameter(), dv = surface.LastVParameter() - v;
  for (unsigned int i = 0; i <= n_samples; ++i)
    for (unsigned int j = 0; j <= n_samples; ++j)
      {
        BRepLProp_SLProps properties(surface, u + du * i / n_samples, v + dv * j / n_samples, 2,
                                     1e-9);
        if (properties.IsCurvatureDefined())
          largest = std::max(
            {largest, std::abs(properties.MaxCurvature()), std::abs(properties.MinCurvature())});
      }
  return largest;
}
} // namespace

std::vector<SizeSource> size_sources(const Part                          &part,
                                     const std::vector<std::string>      &boundaries,
                                     const std::map<std::string, double> &sizes,
                                     const double                         largest)
{
  std::vector<SizeSource> result;
  const auto              faces = part.faces();
  for (unsigned int f = 0; f < faces.size(); ++f)
    {
      const auto   given = sizes.find(boundaries[f]);
      const double curved =
        part.dim == 2 ? curvature(TopoDS::Edge(faces[f])) : curvature(TopoDS::Face(faces[f]));
      const double size = given != sizes.end()     ? given->second
                          : curved * largest > 0.5 ? std::max(0.5 / curved, 0.1 * largest)
                                                   : largest;
      if (size >= largest)
        continue;
      Points points;
      if (part.dim == 2)
        add_edge(TopoDS::Edge(faces[f]), 0.5 * size, points);
      else
        add_face(TopoDS::Face(faces[f]), 0.5 * size, points);
      for (const auto &point : points)
        result.push_back({point, size});
    }
  return result;
}

double suggested_size(const Part &part)
{
  double smallest = part.size / 8.;
  for (const auto &face : part.faces())
    {
      const double curved = curvature(TopoDS::Face(face));
      if (curved * smallest > 1.)
        smallest = 1. / curved;
    }
  Bnd_Box box;
  BRepBndLib::Add(part.shape, box);
  const gp_XYZ edges = box.CornerMax().XYZ() - box.CornerMin().XYZ();
  smallest           = std::min({smallest, edges.X(), edges.Y(), edges.Z()});
  return std::max(smallest, part.size / 20.);
}
} // namespace snug::cad
