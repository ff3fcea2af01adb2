#include <snug/mesh_file/mesh_formats.h>
#include <snug/mesh_file/mesh_text.h>

#include <algorithm>

namespace snug::mesh_file {
namespace {
/// Properties of a shape. The rows below have the order of ElementShape.
struct ShapeRow
{
  unsigned int dimension, n_corners;
  std::string  singular, plural;
};

const ShapeRow &row(const ElementShape shape)
{
  static const std::vector<ShapeRow> rows = {
    {0, 1, "point", "points"},           {1, 2, "line", "lines"},
    {2, 3, "triangle", "triangles"},     {2, 4, "quadrilateral", "quadrilaterals"},
    {3, 4, "tetrahedron", "tetrahedra"}, {3, 5, "pyramid", "pyramids"},
    {3, 6, "prism", "prisms"},           {3, 8, "hexahedron", "hexahedra"}};
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

bool MeshFile::OptionalBoundary::has_face(const MeshFile                  &mesh,
                                          const std::vector<unsigned int> &corners) const
{
  const auto has = [&](const unsigned int node) { return nodes.count(node) > 0; };
  if (!std::all_of(corners.begin(), corners.end(), has))
    return false;
  for (std::size_t i = 0; i < corners.size() && !mesh.middles.empty(); ++i)
    {
      const unsigned int a = corners[i], b = corners[(i + 1) % corners.size()];
      const auto         middle = mesh.middles.find({std::min(a, b), std::max(a, b)});
      if (middle != mesh.middles.end() && !has(middle->second))
        return false;
    }
  return true;
}

std::string count_shapes(const std::vector<MeshFile::Element> &elements)
{
  std::map<ElementShape, unsigned int> counts;
  for (const auto &element : elements)
    if (dimension(element.shape) > 0)
      ++counts[element.shape];
  std::string result;
  for (auto count = counts.begin(); count != counts.end(); ++count)
    {
      if (count != counts.begin())
        result += std::next(count) == counts.end() ? " and " : ", ";
      result += std::to_string(count->second) + " " +
                (count->second == 1 ? row(count->first).singular : row(count->first).plural);
    }
  return result;
}

void PointNumbers::add(const unsigned long number,
                       const unsigned int  index,
                       const unsigned long line)
{
  if (!indices.emplace(number, index).second)
    throw error_at_line(line, "node " + std::to_string(number) + " occurs twice");
}

unsigned int PointNumbers::index(const unsigned long number,
                                 const std::string  &element,
                                 const unsigned long line) const
{
  const auto found = indices.find(number);
  if (found == indices.end())
    throw error_at_line(line, element + " has the node " + std::to_string(number) +
                                ", which does not exist");
  return found->second;
}

namespace {
/// Read the format that the first word indicates: "$MeshFormat" of Gmsh or "*..." of Abaqus.
/// Endings of file names are not reliable.
MeshFile read_any(const std::string &text)
{
  MeshText          begin(text);
  const std::string first = begin.word("a mesh of Gmsh or Abaqus");
  if (first == "$MeshFormat")
    return read_gmsh(text);
  if (first[0] == '*')
    return read_abaqus(text);
  begin.fail("not a mesh file of Gmsh (.msh) or Abaqus (.inp); 'meshio convert -o gmsh22 FILE "
             "part.msh' converts other formats");
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
