#include <snug/base/errors.h>
#include <snug/cad/moved_solid.h>
#include <snug/cad/part.h>
#include <snug/cad/step_shapes.h>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRepLib.hxx>
#include <BRepTools.hxx>
#include <BRepTools_Modification.hxx>
#include <BRepTools_Modifier.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <GeomAPI_ProjectPointOnCurve.hxx>
#include <ShapeConstruct_ProjectCurveOnSurface.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace snug::cad {
namespace {
/// This class gives OpenCASCADE the geometry of a solid with moved faces.
class Move : public BRepTools_Modification
{
public:
  Move(const Part                                                &part,
       const std::vector<std::string>                            &names,
       const std::map<unsigned int, Handle(Geom_BSplineSurface)> &surfaces,
       const double                                               tolerance)
    : names(names), surfaces(surfaces), tolerance(tolerance)
  {
    TopExp::MapShapes(part.shape, TopAbs_FACE, faces);
    TopExp::MapShapesAndUniqueAncestors(part.shape, TopAbs_EDGE, TopAbs_FACE, of_edge);
    TopExp::MapShapesAndUniqueAncestors(part.shape, TopAbs_VERTEX, TopAbs_FACE, of_vertex);
  }

  bool NewSurface(const TopoDS_Face &face,
                  Handle(Geom_Surface) & surface,
                  TopLoc_Location &,
                  double &error,
                  bool   &reverses_wires,
                  bool   &reverses_face) override
  {
    surface        = moved(face);
    error          = tolerance;
    reverses_wires = reverses_face = false;
    return !surface.IsNull();
  }

  /// The edge of a moved face has the same curve of parameters as before.
  bool NewCurve(const TopoDS_Edge &edge,
                Handle(Geom_Curve) & curve,
                TopLoc_Location &,
                double &error) override
  {
    const TopoDS_Face face = moved_one(of_edge.FindFromKey(edge));
    if (face.IsNull())
      return false;
    double first, last;
    error = tolerance;
    if (BRep_Tool::Degenerated(edge))
      return true;
    const auto        flat = BRep_Tool::CurveOnSurface(edge, face, first, last);
    const TopoDS_Edge made = BRepBuilderAPI_MakeEdge(flat, moved(face), first, last);
    BRepLib::BuildCurve3d(made, 0.1 * tolerance);
    curve = BRep_Tool::Curve(made, first, last);
    return true;
  }

  bool NewPoint(const TopoDS_Vertex &vertex, gp_Pnt &point, double &error) override
  {
    const TopoDS_Face face = moved_one(of_vertex.FindFromKey(vertex));
    if (face.IsNull())
      return false;
    const gp_Pnt2d at = BRep_Tool::Parameters(vertex, face);
    point             = moved(face)->Value(at.X(), at.Y());
    error             = 2. * tolerance;
    return true;
  }

  /// A moved edge is projected on the faces beside it, which are not moved.
  bool NewCurve2d(const TopoDS_Edge &edge,
                  const TopoDS_Face &face,
                  const TopoDS_Edge &made,
                  const TopoDS_Face &,
                  Handle(Geom2d_Curve) & curve,
                  double &error) override
  {
    double first, last;
    error = tolerance;
    curve = BRep_Tool::CurveOnSurface(edge, face, first, last);
    if (!moved(face).IsNull())
      return true;
    if (moved_one(of_edge.FindFromKey(edge)).IsNull())
      return false;
    auto       in_space = BRep_Tool::Curve(made, first, last);
    const auto surface  = BRep_Tool::Surface(face);
    double     farthest = 0.;
    const Handle(ShapeConstruct_ProjectCurveOnSurface) projection =
      new ShapeConstruct_ProjectCurveOnSurface();
    projection->Init(surface, 0.1 * tolerance);
    const gp_Pnt2d before = curve->Value(first);
    projection->Perform(in_space, first, last, curve);
    if (!curve.IsNull())
      {
        const gp_Vec2d off(curve->Value(first), before);
        const double   u = surface->IsUPeriodic() ? surface->UPeriod() : HUGE_VAL,
                     v   = surface->IsVPeriodic() ? surface->VPeriod() : HUGE_VAL;
        curve->Translate(
          gp_Vec2d(off.X() - std::remainder(off.X(), u), off.Y() - std::remainder(off.Y(), v)));
      }
    for (unsigned int k = 0; k <= 20 && !curve.IsNull(); ++k)
      {
        const double   t  = first + (last - first) * k / 20.;
        const gp_Pnt2d at = curve->Value(t);
        farthest = std::max(farthest, surface->Value(at.X(), at.Y()).Distance(in_space->Value(t)));
      }
    if (curve.IsNull() || farthest > 2. * tolerance)
      {
        std::ostringstream text;
        text << std::setprecision(3) << "the design moves an edge off the face "
             << names[faces.FindIndex(face) - 1] << " by " << farthest << "; shape "
             << names[faces.FindIndex(face) - 1] << " as well, or hold this edge";
        throw InputError(text.str());
      }
    return true;
  }

  /// An edge between faces that are not moved ends elsewhere on its curve.
  bool NewParameter(const TopoDS_Vertex &vertex,
                    const TopoDS_Edge   &edge,
                    double              &at,
                    double              &error) override
  {
    gp_Pnt point;
    if (!moved_one(of_edge.FindFromKey(edge)).IsNull() || !NewPoint(vertex, point, error))
      return false;
    double                            first, last;
    const auto                        curve = BRep_Tool::Curve(edge, first, last);
    const GeomAPI_ProjectPointOnCurve on(point, curve);
    if (on.NbPoints() == 0)
      return false; // NewCurve2d finds the face that the corner leaves
    const double before = BRep_Tool::Parameter(vertex, edge);
    at                  = on.LowerDistanceParameter();
    if (curve->IsPeriodic())
      at += curve->Period() * std::round((before - at) / curve->Period());
    return true;
  }

  GeomAbs_Shape Continuity(const TopoDS_Edge &edge,
                           const TopoDS_Face &a,
                           const TopoDS_Face &b,
                           const TopoDS_Edge &,
                           const TopoDS_Face &,
                           const TopoDS_Face &) override
  {
    return moved(a).IsNull() && moved(b).IsNull() ? BRep_Tool::Continuity(edge, a, b) : GeomAbs_C0;
  }

private:
  const std::vector<std::string>                            &names;
  const std::map<unsigned int, Handle(Geom_BSplineSurface)> &surfaces;
  const double                                               tolerance;
  TopTools_IndexedMapOfShape                                 faces;
  TopTools_IndexedDataMapOfShapeListOfShape                  of_edge, of_vertex; ///< faces

  /// Return the new surface of a face, or null.
  Handle(Geom_BSplineSurface) moved(const TopoDS_Shape &face) const
  {
    const auto found = surfaces.find(faces.FindIndex(face) - 1);
    return found == surfaces.end() ? Handle(Geom_BSplineSurface)() : found->second;
  }

  /// Return the first face that is moved, or null.
  TopoDS_Face moved_one(const TopTools_ListOfShape &all) const
  {
    for (const auto &face : all)
      if (!moved(face).IsNull())
        return TopoDS::Face(face.Oriented(TopAbs_FORWARD));
    return {};
  }
};
} // namespace

struct MovedSolid::Shapes
{
  Part                      part;
  std::vector<TopoDS_Shape> faces;
};

MovedSolid::MovedSolid(const std::string           &brep,
                       const double                 scale,
                       const dealii::Tensor<2, 3>  &rotation,
                       const std::array<double, 3> &shift)
{
  const auto Q = scale * rotation;
  gp_Trsf    placement;
  placement.SetValues(Q[0][0], Q[0][1], Q[0][2], shift[0], Q[1][0], Q[1][1], Q[1][2], shift[1],
                      Q[2][0], Q[2][1], Q[2][2], shift[2]);
  // Copies of the geometry have no locations.
  Part part{BRepBuilderAPI_Transform(from_brep(brep), placement, true).Shape(), 3, {}};
  shapes = std::make_shared<Shapes>(Shapes{part, part.faces()});
}

MovedSolid::Domain MovedSolid::domain(const unsigned int face) const
{
  const TopoDS_Face shape   = TopoDS::Face(shapes->faces[face]);
  const auto        surface = BRep_Tool::Surface(shape);
  Domain            result;
  BRepTools::UVBounds(shape, result.lower[0], result.upper[0], result.lower[1], result.upper[1]);
  const auto range = result.upper - result.lower;
  result.closed    = {{surface->IsUPeriodic() && range[0] > (1. - 1e-9) * surface->UPeriod(),
                       surface->IsVPeriodic() && range[1] > (1. - 1e-9) * surface->VPeriod()}};
  return result;
}

dealii::Point<3> MovedSolid::point(const unsigned int          face,
                                   const dealii::Tensor<1, 2> &parameters) const
{
  const gp_Pnt x =
    BRep_Tool::Surface(TopoDS::Face(shapes->faces[face]))->Value(parameters[0], parameters[1]);
  return {x.X(), x.Y(), x.Z()};
}

double MovedSolid::write(const std::string                        &path,
                         const std::string                        &unit,
                         const std::string                        &name,
                         const std::vector<std::string>           &names,
                         const std::map<unsigned int, SplineFace> &moved,
                         const double                              tolerance) const
{
  try
    {
      std::map<unsigned int, Handle(Geom_BSplineSurface)> surfaces;
      for (const auto &[f, face] : moved)
        surfaces[f] = surface_of(face);
      const Handle(Move) move = new Move(shapes->part, names, surfaces, tolerance);
      BRepTools_Modifier modifier(shapes->part.shape, move);
      const TopoDS_Shape solid = modifier.ModifiedShape(shapes->part.shape);
      BRepLib::SameParameter(solid, tolerance, true);
      BRepLib::UpdateTolerances(solid);
      if (!BRepCheck_Analyzer(solid).IsValid())
        throw InputError("OpenCASCADE finds that the solid would not be valid");
      GProp_GProps properties;
      BRepGProp::VolumeProperties(solid, properties);
      write_step(path, unit, {{solid, name}}, names);
      return properties.Mass();
    }
  catch (const Standard_Failure &failure)
    {
      throw InputError(std::string("OpenCASCADE fails: ") + failure.GetMessageString());
    }
}
} // namespace snug::cad
