#include <snug/mesh_file/mesh_formats.h>
#include <snug/mesh_file/mesh_text.h>

namespace snug::mesh_file {
namespace {
/// Facts of a shape; the rows below have the order of ElementShape.
struct ShapeRow
{
  unsigned int dimension, n_corners;
  std::string  plural;
};

const ShapeRow &row(const ElementShape shape)
{
  static const std::vector<ShapeRow> rows = {{0, 1, "points"},     {1, 2, "lines"},
                                             {2, 3, "triangles"},  {2, 4, "quadrilaterals"},
                                             {3, 4, "tetrahedra"}, {3, 5, "pyramids"},
                                             {3, 6, "prisms"},     {3, 8, "hexahedra"}};
  return rows[static_cast<unsigned int>(shape)];
}
} // namespace

unsigned int dimension(const ElementShape shape)
{
  return row(shape).dimension;
}

unsigned int n_corners(const ElementShape shape)
{
  return row(shape).n_corners;
}

std::string plural(const ElementShape shape)
{
  return row(shape).plural;
}

void PointNumbers::add(const unsigned long number, const unsigned long line)
{
  // indices follow the order of the file, as MeshFile::points does
  if (!indices.emplace(number, indices.size()).second)
    throw error_at_line(line, "node " + std::to_string(number) + " occurs twice");
}

unsigned int PointNumbers::index(const unsigned long number,
                                 const std::string  &element,
                                 const unsigned long line) const
{
  const auto found = indices.find(number);
  if (found == indices.end())
    throw error_at_line(line, element + " has the node " + std::to_string(number) +
                                ", which is not there");
  return found->second;
}

namespace {
/// Tells formats by their first words, since endings of names are not reliable: "$MeshFormat" of
/// Gmsh, "*..." of Abaqus, "# vtk DataFile" of VTK. UCD has comments # or the number of nodes.
MeshFile read_any(const std::string &text)
{
  MeshText          begin(text);
  const std::string first = begin.word("a mesh of Gmsh, Abaqus, VTK or UCD");
  if (first == "$MeshFormat")
    return read_gmsh(text);
  if (first[0] == '*')
    return read_abaqus(text);
  if (first == "#" && begin.word("a mesh") == "vtk")
    return read_vtk(text);
  if (first[0] == '#' || first.find_first_not_of("0123456789") == std::string::npos)
    return read_ucd(text);
  begin.fail("this is no mesh file of Gmsh (.msh), Abaqus (.inp), VTK "
             "(.vtk) or UCD (.ucd)");
}
} // namespace

MeshFile read_mesh_file(const std::string &text)
{
  MeshFile mesh = read_any(text);
  if (mesh.points.empty() || mesh.elements.empty())
    throw InputError(std::string("the file has no ") +
                     (mesh.points.empty() ? "nodes" : "elements"));
  return mesh;
}
} // namespace snug::mesh_file
