#include <snug/mesh_file/mesh_formats.h>
#include <snug/mesh_file/mesh_text.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace snug::mesh_file {
namespace {
/// By number, as in vtkCellType.h: linear types up to 14, quadratic ones from 21 on, which begin
/// with their corners. Pixels and voxels (8, 11) are cells of images and are not read.
const std::map<unsigned long, ElementType> &vtk_types()
{
  using S                                                 = ElementShape;
  static const std::map<unsigned long, ElementType> types = {
    {1, {S::vertex, 1}},        {3, {S::line, 2}},           {5, {S::triangle, 3}},
    {9, {S::quadrilateral, 4}}, {10, {S::tetrahedron, 4}},   {12, {S::hexahedron, 8}},
    {13, {S::prism, 6}},        {14, {S::pyramid, 5}},       {21, {S::line, 3}},
    {22, {S::triangle, 6}},     {23, {S::quadrilateral, 8}}, {24, {S::tetrahedron, 10}},
    {25, {S::hexahedron, 20}},  {26, {S::prism, 15}},        {28, {S::quadrilateral, 9}},
    {29, {S::hexahedron, 27}},  {32, {S::prism, 18}}};
  return types;
}

/// Reads a legacy file keyword by keyword.
///
/// Points and cells are numbered from 0, in their order. Binary data are big-endian.
class VtkReader
{
public:
  explicit VtkReader(const std::string &text) : in(text) {}

  MeshFile read()
  {
    // "# vtk DataFile Version 5.1"; the title may be any line
    in.rest_of_line(); // version
    in.rest_of_line(); // title
    const std::string form = in.word("ASCII or BINARY");
    binary                 = form == "BINARY";
    if (form != "ASCII" && !binary)
      in.fail("ASCII or BINARY is expected");
    in.rest_of_line();
    if (binary)
      in.be_binary();
    while (!in.at_end())
      read_section();
    if (types.size() != nodes.size())
      in.fail("there are " + std::to_string(nodes.size()) + " cells and " +
              std::to_string(types.size()) + " cell types");
    if (!groups.empty() && groups.size() != nodes.size())
      in.fail("there are " + std::to_string(nodes.size()) + " cells and groups of " +
              std::to_string(groups.size()));
    make_elements();
    return mesh;
  }

private:
  MeshText                                in;
  bool                                    binary       = false;
  bool                                    in_cell_data = false; ///< not in that of points
  std::vector<std::vector<unsigned long>> nodes;
  std::vector<unsigned long>              lines, types;
  std::vector<std::string>                groups;
  MeshFile                                mesh;

  /// A number as it lies in the file, most significant byte first.
  template <typename T>
  T big_endian(const std::string &what)
  {
    const auto                           bytes = in.raw<std::array<unsigned char, sizeof(T)>>(what);
    std::array<unsigned char, sizeof(T)> own   = bytes;
    const std::uint16_t                  one   = 1;
    unsigned char                        first;
    std::memcpy(&first, &one, 1);
    if (first == 1)
      std::reverse(own.begin(), own.end());
    T value;
    std::memcpy(&value, own.data(), sizeof(T));
    if (!std::isfinite(static_cast<double>(value)))
      in.fail(what + " is no number");
    return value;
  }

  double number(const std::string &type, const std::string &what)
  {
    if (!binary)
      return in.number(what);
    if (type == "float")
      return big_endian<float>(what);
    if (type == "double")
      return big_endian<double>(what);
    in.fail("points of type '" + type + "', not float or double");
  }

  /// Negative numbers become huge ones, which no cell has as a point or as a count.
  unsigned long whole(const std::string &type, const std::string &what)
  {
    if (!binary)
      return in.whole(what);
    if (type == "int" || type == "unsigned_int")
      return big_endian<std::int32_t>(what);
    if (type == "long" || type == "vtktypeint64" || type == "vtkIdType")
      return big_endian<std::int64_t>(what);
    in.fail("whole numbers of type '" + type + "', not int or long");
  }

  void read_section()
  {
    // Sections that are not read (METADATA, FIELD, POINT_DATA) are passed line by line, as if
    // each began with an unknown keyword.
    const std::string keyword = in.word("a keyword");
    if (keyword == "CELL_DATA" || keyword == "POINT_DATA")
      in_cell_data = keyword == "CELL_DATA";
    if (keyword == "DATASET" && in.word("the kind of data") != "UNSTRUCTURED_GRID")
      in.fail("the data are no UNSTRUCTURED_GRID");
    const unsigned long n  = keyword == "POINTS" || keyword == "CELLS" || keyword == "CELL_TYPES"
                               ? in.whole("a number behind " + keyword)
                               : 0;
    const bool named_data  = keyword == "SCALARS" && in_cell_data && is_group(in.word("a name"));
    const std::string rest = in.rest_of_line();
    const std::string type = rest.substr(0, rest.find(' '));
    if (keyword == "POINTS")
      read_points(n, type);
    else if (keyword == "CELLS")
      read_cells(n);
    else if (keyword == "CELL_TYPES")
      read_types(n);
    else if (named_data)
      read_groups(type);
  }

  /// MaterialID is deal.II's name, CellEntityIds that of Gmsh, which writes the first physical
  /// group of a cell and -1 where there is none.
  static bool is_group(const std::string &name)
  {
    return name == "MaterialID" || name == "CellEntityIds";
  }

  void read_points(unsigned long n, const std::string &type)
  {
    for (unsigned long i = 0; i < n; ++i)
      {
        dealii::Point<3> point;
        for (unsigned int d = 0; d < 3; ++d)
          point[d] = number(type, "a coordinate of point " + std::to_string(i));
        mesh.points.push_back(point);
      }
  }

  /// Up to version 4: the number of points and the points of each cell, in binary files int.
  void read_cells(unsigned long n)
  {
    if (in.is_next("OFFSETS"))
      return read_connectivity(n);
    for (unsigned long i = 0; i < n; ++i)
      {
        const std::string name = "cell " + std::to_string(i);
        nodes.emplace_back(count("int", name));
        lines.push_back(in.line());
        for (auto &node : nodes.back())
          node = whole("int", "a point of " + name);
      }
  }

  /// Number of points of a cell. No type has more than 27: what is far above is a broken file,
  /// which must not make us allocate.
  unsigned long count(const std::string &type, const std::string &name)
  {
    const unsigned long n = whole(type, name);
    if (n > 1000)
      in.fail(name + " has too many points");
    return n;
  }

  /// Version 5: the places in one list of points where the cells begin, and its end; the number
  /// behind CELLS is that of these offsets, one more than cells.
  void read_connectivity(unsigned long n_offsets)
  {
    in.word("OFFSETS");
    const std::string          offset_type = in.rest_of_line();
    std::vector<unsigned long> offsets;
    for (unsigned long i = 0; i < n_offsets; ++i)
      offsets.push_back(whole(offset_type, "an offset"));
    if (in.word("CONNECTIVITY") != "CONNECTIVITY")
      in.fail("CONNECTIVITY is expected");
    const std::string type = in.rest_of_line();
    for (unsigned long i = 0; i + 1 < n_offsets; ++i)
      {
        if (offsets[i + 1] < offsets[i] || offsets[i + 1] - offsets[i] > 1000)
          in.fail("offsets must not fall, nor cells be that large");
        nodes.emplace_back(offsets[i + 1] - offsets[i]);
        lines.push_back(in.line());
        for (auto &node : nodes.back())
          node = whole(type, "a point of cell " + std::to_string(i));
      }
  }

  void read_types(unsigned long n)
  {
    for (unsigned long i = 0; i < n; ++i)
      types.push_back(whole("int", "the type of a cell"));
  }

  void read_groups(const std::string &type)
  {
    if (in.word("LOOKUP_TABLE") != "LOOKUP_TABLE")
      in.fail("LOOKUP_TABLE is expected");
    in.rest_of_line();
    // a later data set replaces an earlier one, or cells would get groups of both
    groups.clear();
    for (unsigned int i = 0; i < nodes.size(); ++i)
      {
        const std::string what = "the number of cell " + std::to_string(i);
        groups.push_back(binary ? std::to_string(static_cast<long>(whole(type, what)))
                                : in.word(what));
      }
  }

  /// Types come behind the cells, so elements are made when all has been read.
  void make_elements()
  {
    for (unsigned int i = 0; i < nodes.size(); ++i)
      {
        const std::string name  = "cell " + std::to_string(i);
        const auto        found = vtk_types().find(types[i]);
        if (found == vtk_types().end() || found->second.n_nodes != nodes[i].size())
          throw error_at_line(lines[i], name + " of type " + std::to_string(types[i]) + " with " +
                                          std::to_string(nodes[i].size()) +
                                          " points cannot be read");
        MeshFile::Element element{found->second.shape, {}, {}, i, lines[i]};
        for (const auto node : nodes[i])
          if (node >= mesh.points.size())
            throw error_at_line(lines[i], name + " has the point " + std::to_string(node) +
                                            ", which is not there");
        add_nodes(mesh, element, {nodes[i].begin(), nodes[i].end()}, vtk_middles(element.shape));
        if (!groups.empty() && groups[i] != "-1")
          {
            element.groups.push_back(groups[i]);
            mesh.unnamed[groups[i]] = true;
          }
        mesh.elements.push_back(element);
      }
  }
};
} // namespace

MeshFile read_vtk(const std::string &text)
{
  return VtkReader(text).read();
}
} // namespace snug::mesh_file
