#include <snug/cad/faces.h>
#include <snug/cad/surface_projection.h>

#include <Adaptor3d_Curve.hxx>
#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRep_Tool.hxx>
#include <GeomAdaptor_Curve.hxx>
#include <ShapeAnalysis_Curve.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <gp_Circ.hxx>
#include <gp_Cone.hxx>
#include <gp_Cylinder.hxx>
#include <gp_Pln.hxx>
#include <gp_Sphere.hxx>
#include <gp_Torus.hxx>

#include <algorithm>
#include <cmath>

namespace snug::cad {
namespace {
template <int dim, typename XYZ>
dealii::Point<dim> point_of(const XYZ &xyz)
{
  dealii::Point<dim> result;
  for (unsigned int d = 0; d < dim; ++d)
    result[d] = xyz.Coord(d + 1);
  return result;
}

template <int dim>
gp_Pnt to_occ(const dealii::Point<dim> &x, const double z)
{
  return {x[0], x[1], dim == 3 ? x[dim - 1] : z};
}

/// This class projects points on the curve of an edge, beyond its ends as well. See
/// SurfaceProjection for the method.
template <int dim>
class OnCurve : public geometry::Projection<dim>
{
public:
  explicit OnCurve(const TopoDS_Edge &edge)
  {
    curve                = BRep_Tool::Curve(edge, first, last);
    const unsigned int n = 100;
    for (unsigned int i = 0; i <= n; ++i)
      {
        const double t = first + (last - first) * i / n;
        samples.emplace_back(t, curve->Value(t).XYZ());
      }
    z     = samples[0].second.Z();
    first = curve->IsPeriodic() ? -HUGE_VAL : curve->FirstParameter();
    last  = curve->IsPeriodic() ? HUGE_VAL : curve->LastParameter();
  }

  dealii::Point<dim> project(const dealii::Point<dim> &x) const override
  {
    const gp_Pnt point = to_occ(x, z);
    if (const auto t = near(point.XYZ()))
      return point_of<dim>(curve->Value(*t));
    gp_Pnt on;
    double parameter;
    ShapeAnalysis_Curve().Project(curve, point, 1e-12, on, parameter, false);
    return point_of<dim>(on);
  }

private:
  Handle(Geom_Curve) curve;
  double                                 first, last; ///< bounds of the parameter of the curve
  double                                 z;           ///< of the plane in 2D
  std::vector<std::pair<double, gp_XYZ>> samples;     ///< t and C(t)

  /// Return the parameter of the projection by Newton's method, or nothing if it fails.
  std::optional<double> near(const gp_XYZ &x) const
  {
    const auto start = std::min_element(samples.begin(), samples.end(), [&](auto &a, auto &b) {
      return (a.second - x).SquareModulus() < (b.second - x).SquareModulus();
    });
    double     t = start->first, change = HUGE_VAL;
    for (unsigned int turn = 0; turn < 20 && change > 1e-9; ++turn)
      {
        gp_Pnt on;
        gp_Vec along, bend;
        curve->D2(t, on, along, bend);
        const gp_Vec off   = on.XYZ() - x;
        const double slope = off * along, rise = along * along + off * bend;
        if (!(rise > 0.1 * (along * along)))
          return {};
        const double next = std::clamp(t - slope / rise, first, last);
        change            = std::abs(next - t) / (samples.back().first - samples.front().first);
        t                 = next;
      }
    const double before    = (start->second - x).Modulus();
    const bool   is_closer = (curve->Value(t).XYZ() - x).Modulus() <=
                           before + 1e-9 * (start->second - samples[0].second).Modulus();
    return change <= 1e-9 && is_closer ? std::optional<double>(t) : std::nullopt;
  }
};

template <int dim>
using Face = typename mesh_file::ExactFaces<dim>::Face;

/// Return the unit normal of a plane. Components of the size of rounding are 0, so that nodes of
/// planes across an axis keep their coordinate.
template <int dim>
dealii::Tensor<1, dim> clean_normal(dealii::Tensor<1, dim> n)
{
  for (unsigned int d = 0; d < dim; ++d)
    if (std::abs(n[d]) < 1e-10 * n.norm())
      n[d] = 0.;
  return n / n.norm();
}

/// Return the cone, whose axis points from the apex to the face.
geometry::KnownSurface<3> cone_of(const BRepAdaptor_Surface &adaptor)
{
  const gp_Cone             cone = adaptor.Cone();
  geometry::KnownSurface<3> known;
  known.kind        = geometry::KnownSurface<3>::Kind::cone;
  known.centre      = point_of<3>(cone.Apex());
  known.axis        = point_of<3>(cone.Axis().Direction());
  known.angle       = std::abs(cone.SemiAngle());
  const auto middle = adaptor.Value(0.5 * (adaptor.FirstUParameter() + adaptor.LastUParameter()),
                                    0.5 * (adaptor.FirstVParameter() + adaptor.LastVParameter()));
  if (known.axis * (point_of<3>(middle) - known.centre) < 0.)
    known.axis *= -1.;
  return known;
}

/// Return the torus of a circle in a plane through an axis that turns about the axis, or nothing.
std::optional<geometry::KnownSurface<3>> revolved_circle(const BRepAdaptor_Surface &adaptor)
{
  const auto curve = adaptor.BasisCurve();
  if (curve->GetType() != GeomAbs_Circle)
    return {};
  const gp_Ax1              axis   = adaptor.AxeOfRevolution();
  const gp_Circ             circle = curve->Circle();
  const auto                centre = point_of<3>(circle.Location());
  const auto                normal = point_of<3>(circle.Axis().Direction());
  geometry::KnownSurface<3> known;
  known.kind   = geometry::KnownSurface<3>::Kind::torus;
  known.axis   = point_of<3>(axis.Direction());
  known.centre = point_of<3>(axis.Location());
  known.centre += ((centre - known.centre) * known.axis) * known.axis;
  known.radius          = centre.distance(known.centre);
  known.tube            = circle.Radius();
  const double rounding = 1e-12;
  if (std::abs(normal * known.axis) > rounding ||
      std::abs((centre - known.centre) * normal) > rounding * known.tube ||
      known.tube >= known.radius)
    return {};
  return known;
}

/// Return the sphere, cylinder, cone or torus of a face, or nothing. The tube of a torus must not
/// reach the axis.
std::optional<geometry::KnownSurface<3>> known_surface(const BRepAdaptor_Surface &adaptor)
{
  using Kind = geometry::KnownSurface<3>::Kind;
  geometry::KnownSurface<3> known;
  const auto                set = [&](const Kind kind, const auto &round) {
    known.kind   = kind;
    known.centre = point_of<3>(round.Location());
    known.axis   = point_of<3>(round.Position().Direction());
  };
  switch (adaptor.GetType())
    {
      case GeomAbs_Sphere:
        set(Kind::sphere, adaptor.Sphere());
        known.radius = adaptor.Sphere().Radius();
        return known;
      case GeomAbs_Cylinder:
        set(Kind::cylinder, adaptor.Cylinder());
        known.radius = adaptor.Cylinder().Radius();
        return known;
      case GeomAbs_Cone:
        return cone_of(adaptor);
      case GeomAbs_SurfaceOfRevolution:
        return revolved_circle(adaptor);
      case GeomAbs_Torus:
        set(Kind::torus, adaptor.Torus());
        known.radius = adaptor.Torus().MajorRadius();
        known.tube   = adaptor.Torus().MinorRadius();
        if (known.tube < known.radius)
          return known;
        return {};
      default:
        return {};
    }
}

template <int dim>
using Projections = std::vector<std::shared_ptr<geometry::PartProjection<dim>>>;

/// Add a shape to the projections and return its projection.
template <int dim>
std::shared_ptr<const geometry::Projection<dim>>
numbered(std::shared_ptr<const geometry::Projection<dim>> shape, Projections<dim> &projections)
{
  projections.push_back(std::make_shared<geometry::PartProjection<dim>>());
  projections.back()->number = projections.size() - 1;
  projections.back()->shape  = std::move(shape);
  return projections.back();
}

Face<3> exact_face(const TopoDS_Face &face, Projections<3> &projections)
{
  const BRepAdaptor_Surface adaptor(face);
  if (adaptor.GetType() == GeomAbs_Plane)
    return {clean_normal<3>(point_of<3>(adaptor.Plane().Axis().Direction())), {}};
  const auto known = known_surface(adaptor);
  if (known)
    return {{}, known};
  return {{}, {}, numbered<3>(std::make_shared<SurfaceProjection>(face), projections)};
}

Face<2> exact_face(const TopoDS_Edge &edge, Projections<2> &projections)
{
  const BRepAdaptor_Curve adaptor(edge);
  if (adaptor.GetType() == GeomAbs_Line)
    {
      const auto along = point_of<2>(adaptor.Line().Direction());
      return {clean_normal<2>(dealii::Point<2>(along[1], -along[0])), {}};
    }
  std::optional<geometry::KnownSurface<2>> known;
  if (adaptor.GetType() == GeomAbs_Circle)
    {
      known.emplace();
      known->centre = point_of<2>(adaptor.Circle().Location());
      known->radius = adaptor.Circle().Radius();
    }
  return {{}, known, numbered<2>(std::make_shared<OnCurve<2>>(edge), projections)};
}

/// The curves between two faces, by the pair of their indices.
using Curves = std::map<std::pair<unsigned int, unsigned int>,
                        std::vector<std::shared_ptr<const geometry::Projection<3>>>>;

Curves curves_between(const Part &part, Projections<3> &projections)
{
  TopTools_IndexedMapOfShape                faces;
  TopTools_IndexedDataMapOfShapeListOfShape edges;
  TopExp::MapShapes(part.shape, TopAbs_FACE, faces);
  TopExp::MapShapesAndUniqueAncestors(part.shape, TopAbs_EDGE, TopAbs_FACE, edges);
  Curves result;
  for (int e = 1; e <= edges.Extent(); ++e)
    {
      const TopoDS_Edge &edge = TopoDS::Edge(edges.FindKey(e));
      if (edges(e).Extent() != 2 || BRep_Tool::Degenerated(edge))
        continue;
      const unsigned int a = faces.FindIndex(edges(e).First()) - 1;
      const unsigned int b = faces.FindIndex(edges(e).Last()) - 1;
      result[{std::min(a, b), std::max(a, b)}].push_back(
        numbered<3>(std::make_shared<OnCurve<3>>(edge), projections));
    }
  return result;
}
} // namespace

template <>
mesh_file::ExactFaces<2> exact_faces(const Part &part)
{
  mesh_file::ExactFaces<2> result;
  for (const auto &face : part.faces())
    result.faces.push_back(exact_face(TopoDS::Edge(face), result.projections));
  result.curve = [](unsigned int, unsigned int, const dealii::Point<2> &) { return nullptr; };
  return result;
}

template <>
mesh_file::ExactFaces<3> exact_faces(const Part &part)
{
  mesh_file::ExactFaces<3> result;
  for (const auto &face : part.faces())
    result.faces.push_back(exact_face(TopoDS::Face(face), result.projections));
  result.curve =
    [curves = curves_between(part, result.projections)](const unsigned int a, const unsigned int b,
                                                        const dealii::Point<3> &middle) {
      mesh_file::ExactFaces<3>::Projection closest;
      double                               least = HUGE_VAL;
      const auto                           found = curves.find({std::min(a, b), std::max(a, b)});
      if (found != curves.end())
        for (const auto &curve : found->second)
          {
            const double distance = middle.distance(curve->project(middle));
            if (distance < least)
              {
                least   = distance;
                closest = curve;
              }
          }
      return closest;
    };
  return result;
}
} // namespace snug::cad
