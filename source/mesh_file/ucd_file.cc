#include <snug/mesh_file/mesh_formats.h>
#include <snug/mesh_file/mesh_text.h>

namespace snug::mesh_file {
namespace {
/// UCD's names; corners are numbered as in ElementShape, or mirrored (see turn_mirrored()).
ElementShape ucd_shape(const std::string &name, unsigned long line)
{
  using S                                      = ElementShape;
  static const std::map<std::string, S> shapes = {
    {"pt", S::vertex},       {"line", S::line},   {"tri", S::triangle}, {"quad", S::quadrilateral},
    {"tet", S::tetrahedron}, {"pyr", S::pyramid}, {"prism", S::prism},  {"hex", S::hexahedron}};
  const auto found = shapes.find(name);
  if (found == shapes.end())
    throw error_at_line(line, "elements of the type '" + name + "' cannot be read");
  return found->second;
}

/// A line "number material type nodes".
void read_element(MeshText &in, const PointNumbers &numbers, MeshFile &mesh)
{
  const auto        number = in.whole("an element");
  const std::string name   = "element " + std::to_string(number);
  const std::string group  = std::to_string(in.whole("the material of " + name));
  const auto        line   = in.line();
  const auto        shape  = ucd_shape(in.word("the type of " + name), line);
  MeshFile::Element element{shape, {}, {group}, number, line};
  for (unsigned int i = 0; i < n_corners(shape); ++i)
    element.corners.push_back(numbers.index(in.whole("a node of " + name), name, in.line()));
  in.rest_of_line();
  mesh.unnamed[group] = true;
  mesh.elements.push_back(element);
}
} // namespace

/// Comments, the line "nodes elements n n n" with the numbers of node, cell and model data, the
/// nodes "number x y z" and the elements. Data behind them are not read.
MeshFile read_ucd(const std::string &text)
{
  MeshText    in(text);
  std::string first = in.word("the number of nodes");
  while (first[0] == '#')
    {
      in.rest_of_line();
      first = in.word("the number of nodes");
    }
  const auto n_nodes    = to_whole(first, in.line());
  const auto n_elements = in.whole("the number of elements");
  in.rest_of_line();
  MeshFile     mesh;
  PointNumbers numbers;
  for (unsigned long i = 0; i < n_nodes; ++i)
    {
      const auto number = in.whole("a node");
      numbers.add(number, in.line());
      dealii::Point<3> point;
      for (unsigned int d = 0; d < 3; ++d)
        point[d] = in.number("a coordinate of node " + std::to_string(number));
      mesh.points.push_back(point);
    }
  for (unsigned long i = 0; i < n_elements; ++i)
    read_element(in, numbers, mesh);
  return mesh;
}
} // namespace snug::mesh_file
