#include <snug/base/errors.h>
#include <snug/cad/moved_solid.h>
#include <snug/cad/part.h>
#include <snug/cad/step_shapes.h>

#include <BRepAdaptor_Surface.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRepLib.hxx>
#include <BRepTools.hxx>
#include <BRepTools_ReShape.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <ElCLib.hxx>
#include <GProp_GProps.hxx>
#include <GeomAPI_ProjectPointOnCurve.hxx>
#include <GeomAPI_ProjectPointOnSurf.hxx>
#include <ShapeFix_Edge.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Vertex.hxx>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace snug::cad {
namespace {
/// This class makes the vertices, edges and faces of a solid with moved faces.
class Move
{
public:
  using Surfaces = std::map<unsigned int, Handle(Geom_BSplineSurface)>;

  Move(const Part                     &part,
       const std::vector<std::string> &names,
       const Surfaces                 &surfaces,
       const double                    tolerance)
    : names(names), surfaces(surfaces), tolerance(tolerance)
  {
    TopExp::MapShapes(part.shape, TopAbs_FACE, faces);
    TopExp::MapShapesAndUniqueAncestors(part.shape, TopAbs_EDGE, TopAbs_FACE, edges);
    move_vertices();
    for (const bool of_moved : {true, false})
      for (int e = 1; e <= edges.Extent(); ++e)
        if (is_of_moved(edges(e)) == of_moved)
          move_edge(TopoDS::Edge(edges.FindKey(e).Oriented(TopAbs_FORWARD)), edges(e), of_moved);
    for (const auto &[f, surface] : surfaces)
      {
        const TopoDS_Shape before = faces(f + 1).Oriented(TopAbs_FORWARD);
        TopoDS_Face        after;
        builder.MakeFace(after, surface, tolerance);
        for (TopoDS_Iterator wire(before); wire.More(); wire.Next())
          builder.Add(after, reshape.Apply(wire.Value()));
        reshape.Replace(before, after);
      }
    solid = reshape.Apply(part.shape);
    BRepLib::SameParameter(solid, tolerance, true);
    BRepLib::UpdateTolerances(solid);
  }

  TopoDS_Shape solid;

  /// Return the face of the solid that replaces a face of the part.
  TopoDS_Shape face(const unsigned int f) { return reshape.Apply(faces(f + 1)); }

private:
  const std::vector<std::string>           &names;
  const Surfaces                           &surfaces;
  const double                              tolerance;
  TopTools_IndexedMapOfShape                faces, old_vertices;
  std::vector<TopoDS_Vertex>                new_vertices;
  TopTools_IndexedDataMapOfShapeListOfShape edges;
  BRep_Builder                              builder;
  BRepTools_ReShape                         reshape;

  void move_vertices();
  void move_edge(const TopoDS_Edge &edge, const TopTools_ListOfShape &of_faces, bool of_moved);
  void set_curves(const TopoDS_Edge &from, TopoDS_Edge &to, const TopTools_ListOfShape &of_faces);
  void cut(const TopoDS_Edge                  &from,
           TopoDS_Edge                        &to,
           const std::array<TopoDS_Vertex, 2> &ends,
           const TopTools_ListOfShape         &of_faces);
  void put_on(const TopoDS_Edge &edge, const TopoDS_Face &face);
  /// Return the vertex at the place of a vertex of the part.
  TopoDS_Vertex at(const TopoDS_Vertex &vertex) const
  {
    const int v = old_vertices.FindIndex(vertex);
    return v == 0 ? vertex : new_vertices[v - 1];
  }
  unsigned int index(const TopoDS_Shape &face) const { return faces.FindIndex(face) - 1; }
  bool         is_of_moved(const TopTools_ListOfShape &of_faces) const
  {
    return std::any_of(of_faces.begin(), of_faces.end(),
                       [&](const TopoDS_Shape &face) { return surfaces.count(index(face)) > 0; });
  }
};

/// Put the vertices of moved faces at the means of their places on the moved surfaces.
void Move::move_vertices()
{
  std::vector<std::vector<gp_XYZ>> places;
  for (const auto &[f, surface] : surfaces)
    {
      const TopoDS_Face          face = TopoDS::Face(faces(f + 1));
      TopTools_IndexedMapOfShape of_face;
      TopExp::MapShapes(face, TopAbs_VERTEX, of_face);
      for (int k = 1; k <= of_face.Extent(); ++k)
        {
          const gp_Pnt2d     uv = BRep_Tool::Parameters(TopoDS::Vertex(of_face(k)), face);
          const unsigned int v  = old_vertices.Add(of_face(k));
          places.resize(std::max<std::size_t>(places.size(), v));
          places[v - 1].push_back(surface->Value(uv.X(), uv.Y()).XYZ());
        }
    }
  for (const auto &of_vertex : places)
    {
      gp_XYZ mean(0., 0., 0.);
      for (const auto &x : of_vertex)
        mean += x / double(of_vertex.size());
      new_vertices.emplace_back();
      builder.MakeVertex(new_vertices.back(), mean, tolerance);
    }
}

/// Replace an edge of a moved face by the same curves of parameters on the moved surfaces, and
/// another edge that ends at a moved vertex by another part of its curve.
void Move::move_edge(const TopoDS_Edge          &edge,
                     const TopTools_ListOfShape &of_faces,
                     const bool                  of_moved)
{
  const std::array<TopoDS_Vertex, 2> before = {
    {TopExp::FirstVertex(edge), TopExp::LastVertex(edge)}};
  const std::array<TopoDS_Vertex, 2> ends = {{at(before[0]), at(before[1])}};
  if (ends[0].IsSame(before[0]) && ends[1].IsSame(before[1]))
    return;
  TopoDS_Edge made;
  builder.MakeEdge(made);
  of_moved ? set_curves(edge, made, of_faces) : cut(edge, made, ends, of_faces);
  builder.Add(made, ends[0].Oriented(TopAbs_FORWARD));
  builder.Add(made, ends[1].Oriented(TopAbs_REVERSED));
  if (of_moved && BRep_Tool::Degenerated(edge))
    builder.Degenerated(made, true);
  else if (of_moved)
    {
      BRepLib::BuildCurve3d(made, 0.1 * tolerance);
      for (const auto &face : of_faces)
        if (surfaces.count(index(face)) == 0)
          put_on(made, TopoDS::Face(face));
    }
  reshape.Replace(edge, made);
}

/// Set the curves of parameters on the moved faces of an edge.
void Move::set_curves(const TopoDS_Edge          &from,
                      TopoDS_Edge                &to,
                      const TopTools_ListOfShape &of_faces)
{
  for (const auto &shape : of_faces)
    {
      const auto found = surfaces.find(index(shape));
      if (found == surfaces.end())
        continue;
      const TopoDS_Face face = TopoDS::Face(shape.Oriented(TopAbs_FORWARD));
      double            first, last;
      const auto        curve = BRep_Tool::CurveOnSurface(from, face, first, last);
      if (BRep_Tool::IsClosed(from, face))
        builder.UpdateEdge(to, curve,
                           BRep_Tool::CurveOnSurface(TopoDS::Edge(from.Reversed()), face, first,
                                                     last),
                           found->second, TopLoc_Location(), tolerance);
      else
        builder.UpdateEdge(to, curve, found->second, TopLoc_Location(), tolerance);
      builder.Range(to, found->second, TopLoc_Location(), first, last);
    }
}

/// Set the part of the curve of an edge that ends at new vertices. @throws InputError if they do
/// not lie on the curve.
void Move::cut(const TopoDS_Edge                  &from,
               TopoDS_Edge                        &to,
               const std::array<TopoDS_Vertex, 2> &ends,
               const TopTools_ListOfShape         &of_faces)
{
  std::array<double, 2> range;
  const auto            curve = BRep_Tool::Curve(from, range[0], range[1]);
  for (unsigned int k = 0; k < 2; ++k)
    {
      const GeomAPI_ProjectPointOnCurve on(BRep_Tool::Pnt(ends[k]), curve);
      if (on.NbPoints() == 0 || on.LowerDistance() > 2. * tolerance)
        throw InputError("the design moves a corner off the edge between the faces " +
                         names[index(of_faces.First())] + " and " + names[index(of_faces.Last())]);
      const double at = on.LowerDistanceParameter();
      range[k]        = curve->IsPeriodic()
                          ? at + curve->Period() * std::round((range[k] - at) / curve->Period())
                          : at;
    }
  to = TopoDS::Edge(from.EmptyCopied());
  builder.Range(to, range[0], range[1]);
}

/// Put a moved edge on a face that is not moved. @throws InputError if it does not lie on it.
void Move::put_on(const TopoDS_Edge &edge, const TopoDS_Face &face)
{
  double     first, last, farthest = 0.;
  const auto curve   = BRep_Tool::Curve(edge, first, last);
  const auto surface = BRep_Tool::Surface(face);
  for (unsigned int k = 0; k <= 20; ++k)
    {
      const GeomAPI_ProjectPointOnSurf on(curve->Value(first + (last - first) * k / 20.), surface);
      farthest = std::max(farthest, on.NbPoints() == 0 ? HUGE_VAL : on.LowerDistance());
    }
  if (farthest > 2. * tolerance)
    {
      std::ostringstream text;
      text << std::setprecision(3) << "the design moves an edge off the face " << names[index(face)]
           << " by " << farthest << "; shape this face as well, or hold the edge";
      throw InputError(text.str());
    }
  if (BRepAdaptor_Surface(face).GetType() != GeomAbs_Plane)
    ShapeFix_Edge().FixAddPCurve(edge, face, false, tolerance);
}
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
  const TopoDS_Face         shape = TopoDS::Face(shapes->faces[face]);
  const BRepAdaptor_Surface surface(shape);
  Domain                    result;
  BRepTools::UVBounds(shape, result.lower[0], result.upper[0], result.lower[1], result.upper[1]);
  const auto turns = [&](const unsigned int a, const bool periodic, const double period) {
    return periodic && result.upper[a] - result.lower[a] > (1. - 1e-9) * period;
  };
  result.closed = {
    {turns(0, surface.IsUPeriodic(), surface.IsUPeriodic() ? surface.UPeriod() : 0.),
     turns(1, surface.IsVPeriodic(), surface.IsVPeriodic() ? surface.VPeriod() : 0.)}};
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
      Move::Surfaces surfaces;
      for (const auto &[f, face] : moved)
        surfaces[f] = surface_of(face);
      Move move(shapes->part, names, surfaces, tolerance);
      if (!BRepCheck_Analyzer(move.solid).IsValid())
        throw InputError("OpenCASCADE finds that the solid would not be valid");
      GProp_GProps properties;
      BRepGProp::VolumeProperties(move.solid, properties);
      std::vector<NamedShape> faces;
      for (unsigned int f = 0; f < names.size(); ++f)
        faces.emplace_back(move.face(f), names[f]);
      write_step(path, unit, {{move.solid, name}}, faces);
      return properties.Mass();
    }
  catch (const Standard_Failure &failure)
    {
      throw InputError(std::string("OpenCASCADE fails: ") + failure.GetMessageString());
    }
}
} // namespace snug::cad
