#include <snug/mesh_file/mesh_formats.h>
#include <snug/mesh_file/mesh_text.h>

#include <array>
#include <limits>

namespace snug::mesh_file {
namespace {
/// Return the element types by their numbers in Gmsh. Elements of both orders begin with their
/// corners, in the order of ElementShape.
const std::map<unsigned long, ElementType> &gmsh_types()
{
  using S                                                 = ElementShape;
  static const std::map<unsigned long, ElementType> types = {
    {1, {S::line, 2}},           {2, {S::triangle, 3}},      {3, {S::quadrilateral, 4}},
    {4, {S::tetrahedron, 4}},    {5, {S::hexahedron, 8}},    {6, {S::prism, 6}},
    {7, {S::pyramid, 5}},        {8, {S::line, 3}},          {9, {S::triangle, 6}},
    {10, {S::quadrilateral, 9}}, {11, {S::tetrahedron, 10}}, {12, {S::hexahedron, 27}},
    {13, {S::prism, 18}},        {14, {S::pyramid, 14}},     {15, {S::vertex, 1}},
    {16, {S::quadrilateral, 8}}, {17, {S::hexahedron, 20}},  {18, {S::prism, 15}},
    {19, {S::pyramid, 13}}};
  return types;
}

/// This class reads a .msh file section by section.
///
/// A section extends from $Name to $EndName. Unknown sections ($Periodic, $NodeData, ...) are
/// skipped. "Physical" groups are defined by the user. An entity is a point, curve, surface or
/// volume of the geometry, and its tag is unique among the entities of its dimension.
class GmshReader
{
public:
  explicit GmshReader(const std::string &text) : in(text) {}

  MeshFile read()
  {
    read_format();
    while (next_section())
      {
        if (section == "$PhysicalNames")
          read_names();
        else if (section == "$Entities" && version == 4)
          read_entities();
        else if (section == "$Nodes")
          version == 2 ? read_nodes_2() : read_nodes_4();
        else if (section == "$Elements")
          version == 2 ? read_elements_2() : read_elements_4();
        in.skip_behind("$End" + section.substr(1));
      }
    return mesh;
  }

private:
  using Entity = std::pair<unsigned int, int>; ///< dimension, tag

  static constexpr int largest = std::numeric_limits<int>::max();

  MeshText                                                      in;
  unsigned int                                                  version = 0;
  bool                                                          binary  = false;
  std::string                                                   section;
  MeshFile                                                      mesh;
  PointNumbers                                                  numbers;
  std::map<std::pair<unsigned int, unsigned long>, std::string> names;
  std::map<Entity, std::vector<unsigned long>>                  physical; ///< in 4.1

  bool next_section()
  {
    while (!in.at_end())
      {
        section = in.rest_of_line();
        if (!section.empty() && section[0] == '$')
          return true;
      }
    return false;
  }

  /// Return the next integer or real number. Integers in text must not be negative; see tag() for
  /// integers that may be negative.
  template <typename T>
  T value(const std::string &what)
  {
    if (binary)
      return in.raw<T>(what);
    if (std::is_floating_point<T>::value)
      return in.number(what);
    const auto number = in.whole(what);
    if (number > static_cast<unsigned long>(largest))
      in.fail(what + " is too large: " + std::to_string(number));
    return static_cast<T>(number);
  }

  /// Return a tag, which may be negative: the sign of a group or a boundary is its orientation.
  int tag(const std::string &what)
  {
    if (binary)
      return in.raw<int>(what);
    const double number = in.number(what);
    if (!(std::abs(number) <= largest))
      in.fail(what + " is too large: " + std::to_string(number));
    return static_cast<int>(number);
  }

  void read_format()
  {
    in.word("$MeshFormat");
    const std::string given = in.word("the version");
    // All versions 2.x have the same sections; those of 4.0 differ from those of 4.1.
    version = given[0] - '0';
    if (given[0] != '2' && given != "4.1")
      in.fail("version " + given +
              " of Gmsh's format is not supported; it must be 2.2 or 4.1 (gmsh -format msh41)");
    binary = in.whole("the file type") != 0;
    if (in.whole("the data size") != sizeof(double))
      in.fail("the data size must be 8");
    in.rest_of_line();
    if (binary)
      in.be_binary();
    // The header line of a binary file is followed by an int 1 in the byte order of the file.
    if (binary && in.raw<int>("the number 1") != 1)
      in.fail("the byte order differs from that of this machine");
    in.skip_behind("$EndMeshFormat");
  }

  /// Read lines 'dimension number "name"', which are text also in binary files. Names may contain
  /// blanks.
  void read_names()
  {
    const auto n = in.whole("the number of physical names");
    for (unsigned long i = 0; i < n; ++i)
      {
        const auto        dim  = in.whole("the dimension of a group");
        const auto        tag  = in.whole("the number of a group");
        const auto        line = in.line();
        const std::string name = in.rest_of_line();
        if (name.size() < 3 || name.front() != '"' || name.back() != '"')
          throw error_at_line(line, "a physical name in quotes is expected");
        names[{dim, tag}] = name.substr(1, name.size() - 2);
      }
  }

  /// Return a count, or the number of a node or element in 4.1 (size_t if binary). Values above 4e9
  /// are errors, because they do not fit in the indices, and loops of a broken file would take
  /// hours.
  unsigned long count(const std::string &what)
  {
    const auto n = binary && version == 4 ? in.raw<unsigned long>(what) : in.whole(what);
    if (n > 4000000000ul)
      in.fail(what + " exceeds 4e9");
    return n;
  }

  /// Skip the numbers of the boxes of entities.
  void skip_values(unsigned long n, const std::string &what)
  {
    for (unsigned long i = 0; i < n; ++i)
      value<double>(what);
  }

  /// Read the groups of the entities of version 4, whose elements refer to an entity. Points have 3
  /// coordinates, other entities a box of 6. Groups follow, and then, except for points, the tags
  /// of the bounding entities.
  void read_entities()
  {
    std::array<unsigned long, 4> n;
    for (auto &entities : n)
      entities = count("the number of entities");
    for (unsigned int dim = 0; dim < 4; ++dim)
      for (unsigned long i = 0; i < n[dim]; ++i)
        {
          const int own = tag("the number of an entity");
          skip_values(dim == 0 ? 3 : 6, "the box of an entity");
          const auto groups = count("the number of physical groups");
          for (unsigned long g = 0; g < groups; ++g)
            physical[{dim, own}].push_back(std::abs(long(tag("a physical group"))));
          if (dim == 0)
            continue;
          const auto bounding = count("the number of its boundaries");
          for (unsigned long b = 0; b < bounding; ++b)
            tag("a boundary of an entity");
        }
  }

  void read_point(unsigned long number)
  {
    numbers.add(number, mesh.points.size(), in.line());
    dealii::Point<3> point;
    for (unsigned int d = 0; d < 3; ++d)
      point[d] = value<double>("a coordinate of node " + std::to_string(number));
    mesh.points.push_back(point);
  }

  /// Read lines "number x y z". In binary files only the count is text.
  void read_nodes_2()
  {
    const auto n = in.whole("the number of nodes");
    in.rest_of_line();
    for (unsigned long i = 0; i < n; ++i)
      read_point(value<int>("a node"));
  }

  /// Read blocks, one per entity: the numbers of all its nodes, then the coordinates of all its
  /// nodes. The header contains the numbers of blocks and nodes, and the minimum and maximum node.
  void read_nodes_4()
  {
    const auto blocks = count("the number of node blocks");
    for (unsigned int i = 0; i < 3; ++i)
      count("the numbers of nodes");
    for (unsigned long b = 0; b < blocks; ++b)
      {
        value<int>("the dimension of an entity");
        tag("the number of an entity");
        const bool parametric = value<int>("0 or 1") != 0;
        if (parametric)
          in.fail("nodes have parametric coordinates; save the mesh without them");
        const auto                 n = count("the number of nodes");
        std::vector<unsigned long> tags;
        for (unsigned long i = 0; i < n; ++i)
          tags.push_back(count("the number of a node"));
        for (const auto number : tags)
          read_point(number);
      }
  }

  const ElementType &type(unsigned long number) const
  {
    const auto found = gmsh_types().find(number);
    if (found == gmsh_types().end())
      throw error_at_line(in.line(), "element type " + std::to_string(number) +
                                       " of Gmsh is not supported; elements must be linear or "
                                       "quadratic");
    return found->second;
  }

  /// Return the name of a physical group; group-7 for group 7 without a name. A name belongs to a
  /// number and a dimension, because a curve and a surface may both be group 1.
  std::string group(ElementShape shape, unsigned long number)
  {
    const auto found = names.find({dimension(shape), number});
    return found != names.end() ? found->second : unnamed_group + std::to_string(number);
  }

  /// Read the nodes of an element and store the element.
  template <typename Node>
  void read_element(const ElementType                &type,
                    unsigned long                     number,
                    const std::vector<unsigned long> &groups,
                    const Node                       &read_node)
  {
    MeshFile::Element element{type.shape, {}, {}, number, in.line()};
    for (const auto physical_group : groups)
      if (physical_group != 0)
        element.groups.push_back(group(type.shape, physical_group));
    const std::string         name = "element " + std::to_string(number);
    std::vector<unsigned int> nodes;
    for (unsigned int i = 0; i < type.n_nodes; ++i)
      nodes.push_back(numbers.index(read_node("a node of " + name), name, in.line()));
    add_nodes(mesh, element, nodes, gmsh_middles(type.shape));
    mesh.elements.push_back(element);
  }

  /// Read lines "number type n_tags tags nodes" of a text file. Binary files have blocks with the
  /// header (type, number of elements, n_tags) and (number, tags, nodes) for each element. The
  /// first tag is the physical group, 0 for none, and the second tag is the entity. Partitions may
  /// follow, ghost partitions with a minus sign.
  void read_elements_2()
  {
    const auto n = in.whole("the number of elements");
    in.rest_of_line();
    unsigned long done = 0;
    while (done < n)
      {
        unsigned long number = 0;
        if (!binary)
          number = in.whole("an element");
        const ElementType &own  = type(value<int>("the type of an element"));
        const auto         many = binary ? value<int>("a number") : 1;
        const auto         tags = value<int>("the number of tags");
        for (int i = 0; i < many; ++i, ++done)
          {
            if (binary)
              number = value<int>("an element");
            unsigned long first = 0;
            for (int t = 0; t < tags; ++t)
              {
                const int own_tag = tag("a tag of an element");
                first             = t == 0 ? std::abs(own_tag) : first;
              }
            read_element(own, number, {first},
                         [&](const std::string &what) { return value<int>(what); });
          }
      }
  }

  /// Read blocks of elements of one type and entity. All elements of a block have the groups of the
  /// entity. The header contains the numbers of blocks and elements, and the minimum and maximum
  /// element.
  void read_elements_4()
  {
    const auto blocks = count("the number of element blocks");
    for (unsigned int i = 0; i < 3; ++i)
      count("the numbers of elements");
    for (unsigned long b = 0; b < blocks; ++b)
      {
        const unsigned int dim     = value<int>("the dimension of an entity");
        const int          own_tag = tag("the number of an entity");
        const ElementType &own     = type(value<int>("the type of elements"));
        const auto         n       = count("the number of elements");
        for (unsigned long i = 0; i < n; ++i)
          read_element(own, count("an element"), physical[{dim, own_tag}],
                       [&](const std::string &what) { return count(what); });
      }
  }
};
} // namespace

MeshFile read_gmsh(const std::string &text)
{
  return GmshReader(text).read();
}
} // namespace snug::mesh_file
