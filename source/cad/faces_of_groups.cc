#include <snug/base/errors.h>
#include <snug/cad/faces.h>

#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <Bnd_Box.hxx>

#include <algorithm>
#include <cmath>

namespace snug::cad {
namespace {
using Element = mesh_file::MeshFile::Element;

/// Return the centre of a line or triangle of second order. The weights are the values of the shape
/// functions at the centre.
gp_Pnt centre_of(const Element &element, const mesh_file::MeshFile &mesh)
{
  const auto        &corners = element.corners;
  const unsigned int n       = corners.size();
  dealii::Point<3>   x;
  for (unsigned int i = 0; i < n; ++i)
    {
      std::vector<unsigned int> edge = {corners[i], corners[(i + 1) % n]};
      std::sort(edge.begin(), edge.end());
      const auto             found = mesh.middles.find(edge);
      const dealii::Point<3> middle =
        found != mesh.middles.end()
          ? mesh.points[found->second]
          : dealii::Point<3>(0.5 * (mesh.points[edge[0]] + mesh.points[edge[1]]));
      if (n == 2)
        return {middle[0], middle[1], middle[2]};
      x += 4. / 9. * middle - 1. / 9. * mesh.points[corners[i]];
    }
  return {x[0], x[1], x[2]};
}

/// Return the maximum distance of the points from a face, or infinity if a point is outside of the
/// box of the face.
double distance(const TopoDS_Shape &face, const std::vector<gp_Pnt> &points, const double tolerance)
{
  Bnd_Box box;
  BRepBndLib::Add(face, box);
  box.Enlarge(tolerance);
  double largest = 0.;
  for (const auto &point : points)
    if (box.IsOut(point))
      return HUGE_VAL;
  for (const auto &point : points)
    largest =
      std::max(largest,
               BRepExtrema_DistShapeShape(BRepBuilderAPI_MakeVertex(point).Vertex(), face).Value());
  return largest;
}
} // namespace

std::map<std::string, unsigned int> faces_of_groups(const Part                &part,
                                                    const mesh_file::MeshFile &mesh)
{
  std::map<std::string, std::vector<const Element *>> elements;
  for (const auto &element : mesh.elements)
    if (mesh_file::dimension(element.shape) == part.dim - 1 && !element.groups.empty())
      elements[element.groups.back()].push_back(&element);
  const auto                          faces     = part.faces();
  const double                        tolerance = 0.05 * part.size;
  const unsigned int                  n_points  = 5; // a sample, because the group is one CAD face
  std::map<std::string, unsigned int> result;
  for (const auto &[group, own] : elements)
    {
      std::vector<gp_Pnt> points;
      for (std::size_t i = 0; i < own.size(); i += 1 + own.size() / n_points)
        points.push_back(centre_of(*own[i], mesh));
      double least = HUGE_VAL;
      for (unsigned int f = 0; f < faces.size(); ++f)
        {
          const double d = distance(faces[f], points, tolerance);
          if (d < least)
            {
              least         = d;
              result[group] = f;
            }
        }
      if (!(least < tolerance))
        throw InputError("the mesh of gmsh has faces that lie on no face of the CAD file");
    }
  return result;
}
} // namespace snug::cad
