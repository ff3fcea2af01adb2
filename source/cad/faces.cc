#include <snug/base/errors.h>
#include <snug/base/values.h>
#include <snug/cad/faces.h>
#include <snug/geometry/entry_values.h>
#include <snug/geometry/fitted_surface.h>

#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRepBndLib.hxx>
#include <BRepGProp.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>

#include <cmath>
#include <iomanip>
#include <set>

namespace snug::cad {
namespace {
std::string curve_kind(const TopoDS_Edge &edge)
{
  switch (BRepAdaptor_Curve(edge).GetType())
    {
      case GeomAbs_Line:
        return "line";
      case GeomAbs_Ellipse:
        return "ellipse";
      case GeomAbs_BSplineCurve:
      case GeomAbs_BezierCurve:
        return "B-spline";
      default:
        return "curve";
    }
}

std::string surface_kind(const TopoDS_Face &face)
{
  switch (BRepAdaptor_Surface(face).GetType())
    {
      case GeomAbs_Plane:
        return "plane";
      case GeomAbs_BSplineSurface:
      case GeomAbs_BezierSurface:
        return "B-spline";
      case GeomAbs_SurfaceOfRevolution:
        return "surface of revolution";
      case GeomAbs_SurfaceOfExtrusion:
        return "extruded curve";
      default:
        return "surface";
    }
}

template <int dim>
std::string
kind_of(const mesh_file::ExactFaces<dim> &exact, const unsigned int f, std::string other)
{
  const auto &known = exact.faces[f].known;
  return known ? geometry::describe(*known) : other;
}

double area_of(const TopoDS_Shape &face, const unsigned int dim)
{
  GProp_GProps properties;
  if (dim == 2)
    BRepGProp::LinearProperties(face, properties);
  else
    BRepGProp::SurfaceProperties(face, properties);
  return properties.Mass();
}

/// Return the unit tangent of an edge at its end @p vertex, away from the vertex.
gp_Dir outgoing(const TopoDS_Edge &edge, const TopoDS_Vertex &vertex)
{
  const BRepAdaptor_Curve curve(edge);
  const double            at = BRep_Tool::Parameter(vertex, edge);
  gp_Pnt                  point;
  gp_Vec                  tangent;
  curve.D1(at, point, tangent);
  const bool is_first =
    std::abs(at - curve.FirstParameter()) < std::abs(at - curve.LastParameter());
  return is_first ? tangent : tangent.Reversed();
}

/// Return whether two faces agree in their normals at the edge @p between them, or two edges in
/// their tangents at the vertex @p between them.
bool is_smooth(const TopoDS_Shape &a, const TopoDS_Shape &b, const TopoDS_Shape &between)
{
  if (between.ShapeType() == TopAbs_EDGE)
    return BRep_Tool::Continuity(TopoDS::Edge(between), TopoDS::Face(a), TopoDS::Face(b)) >
           GeomAbs_C0;
  const auto vertex = TopoDS::Vertex(between);
  return outgoing(TopoDS::Edge(a), vertex).Angle(outgoing(TopoDS::Edge(b), vertex)) >
         M_PI - M_PI / 360.;
}

void add_neighbours(const Part &part, std::vector<FaceInfo> &faces)
{
  const bool                                is_flat = part.dim == 2;
  TopTools_IndexedMapOfShape                map;
  TopTools_IndexedDataMapOfShapeListOfShape around;
  TopExp::MapShapes(part.shape, is_flat ? TopAbs_EDGE : TopAbs_FACE, map);
  TopExp::MapShapesAndUniqueAncestors(part.shape, is_flat ? TopAbs_VERTEX : TopAbs_EDGE,
                                      is_flat ? TopAbs_EDGE : TopAbs_FACE, around);
  for (int k = 1; k <= around.Extent(); ++k)
    {
      const auto &at = around(k);
      if (at.Extent() != 2)
        continue; // the seam of a closed face
      const unsigned int a = map.FindIndex(at.First()) - 1, b = map.FindIndex(at.Last()) - 1;
      const bool         smooth = is_smooth(at.First(), at.Last(), around.FindKey(k));
      for (const auto &[f, g] : {std::make_pair(a, b), std::make_pair(b, a)})
        {
          bool &known = faces[f].neighbours[g];
          known       = known || smooth;
        }
    }
}

std::set<unsigned int> chain_of(const std::vector<FaceInfo>  &faces,
                                const std::set<unsigned int> &first)
{
  std::set<unsigned int>    result = first;
  std::vector<unsigned int> todo(first.begin(), first.end());
  while (!todo.empty())
    {
      const unsigned int f = todo.back();
      todo.pop_back();
      for (const auto &[g, smooth] : faces[f].neighbours)
        if (smooth && result.insert(g).second)
          todo.push_back(g);
    }
  return result;
}

/// Return the faces that an item "3", "seat" or "chain 3" of the entry @p given means.
std::set<unsigned int>
faces_called(const std::vector<FaceInfo> &faces, const std::string &item, const std::string &given)
{
  const std::string chain = "chain ";
  if (item.rfind(chain, 0) == 0)
    return chain_of(faces, faces_called(faces, trim(item.substr(chain.size())), given));
  std::set<unsigned int> result;
  for (unsigned int f = 0; f < faces.size(); ++f)
    if (faces[f].name == item || std::to_string(f + 1) == item)
      result.insert(f);
  if (result.empty())
    throw bad_entry("CAD faces", given,
                    "'" + item +
                      "' is not a face of the CAD file; the faces have the numbers 1 to " +
                      std::to_string(faces.size()) + ", and '--validate' lists them");
  return result;
}
} // namespace

std::vector<FaceInfo> describe_faces(const Part &part)
{
  std::vector<FaceInfo>          result;
  const auto                     shapes = part.faces();
  const mesh_file::ExactFaces<2> flat =
    part.dim == 2 ? exact_faces<2>(part) : mesh_file::ExactFaces<2>();
  const mesh_file::ExactFaces<3> solid =
    part.dim == 3 ? exact_faces<3>(part) : mesh_file::ExactFaces<3>();
  for (unsigned int f = 0; f < shapes.size(); ++f)
    {
      FaceInfo info;
      info.name = part.names[f];
      if (info.name.empty())
        info.name = (part.dim == 2 ? "edge-" : "face-") + std::to_string(f + 1);
      info.kind = part.dim == 2 ? kind_of(flat, f, curve_kind(TopoDS::Edge(shapes[f])))
                                : kind_of(solid, f, surface_kind(TopoDS::Face(shapes[f])));
      info.area = area_of(shapes[f], part.dim);
      Bnd_Box box;
      BRepBndLib::AddOptimal(shapes[f], box, false, false);
      box.Get(info.lower[0], info.lower[1], info.lower[2], info.upper[0], info.upper[1],
              info.upper[2]);
      result.push_back(info);
    }
  add_neighbours(part, result);
  return result;
}

std::vector<std::string> boundaries_of(const std::vector<FaceInfo>              &faces,
                                       const std::map<std::string, std::string> &groups)
{
  std::vector<std::string> result(faces.size());
  for (const auto &[boundary, items] : groups)
    {
      if (boundary.find_first_of("#\\.&+") != std::string::npos)
        throw bad_entry("CAD faces", boundary + ": " + items,
                        "names must not contain # \\ . & or +");
      if (items.empty())
        throw bad_entry("CAD faces", boundary + ": " + items, "must list faces: 'race: 3 + 4'");
      for (const auto &item : split(items, '+'))
        for (const unsigned int f : faces_called(faces, item, boundary + ": " + items))
          {
            if (!result[f].empty() && result[f] != boundary)
              throw bad_entry("CAD faces", boundary + ": " + items,
                              "face " + std::to_string(f + 1) + " belongs to the boundary '" +
                                result[f] + "' as well; a face has one boundary");
            result[f] = boundary;
          }
    }
  for (unsigned int f = 0; f < faces.size(); ++f)
    if (result[f].empty())
      {
        if (groups.count(faces[f].name) > 0)
          throw bad_entry("CAD faces", faces[f].name + ": " + groups.at(faces[f].name),
                          "is the name of face " + std::to_string(f + 1) +
                            ", which the entry does not contain; choose another name");
        result[f] = faces[f].name;
      }
  return result;
}

std::vector<std::string> table_of(const std::vector<FaceInfo>    &faces,
                                  const std::vector<std::string> &boundaries,
                                  const unsigned int              dim)
{
  std::size_t names = 0, kinds = 0;
  for (unsigned int f = 0; f < faces.size(); ++f)
    {
      names = std::max(names, boundaries[f].size());
      kinds = std::max(kinds, faces[f].kind.size());
    }
  double size = 0.;
  for (const auto &face : faces)
    size = std::max(size, face.lower.distance(face.upper));
  std::vector<std::string> lines;
  for (unsigned int f = 0; f < faces.size(); ++f)
    {
      const auto        &face = faces[f];
      std::ostringstream text;
      text << (dim == 2 ? "edge " : "face ") << std::setw(3) << f + 1 << "  " << std::left
           << std::setw(names) << boundaries[f] << "  " << std::setw(kinds) << face.kind
           << (dim == 2 ? "  length " : "  area ") << std::setw(9) << std::setprecision(5)
           << face.area << "  ";
      for (unsigned int d = 0; d < dim; ++d)
        {
          const auto shown = [&](const double x) { return std::abs(x) < 1e-7 * size ? 0. : x; };
          text << (d == 0 ? "" : ", ") << "xyz"[d] << ' ' << shown(face.lower[d]);
          if (face.upper[d] - face.lower[d] > 1e-7 * size)
            text << " to " << shown(face.upper[d]);
        }
      text << "  beside";
      for (const auto &[g, smooth] : face.neighbours)
        text << ' ' << g + 1 << (smooth ? " (smooth)" : "");
      lines.push_back(text.str());
    }
  return lines;
}
} // namespace snug::cad
