#include <snug/mesh_file/element_split.h>
#include <snug/mesh_file/mesh_formats.h>
#include <snug/mesh_file/mesh_text.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cctype>
#include <set>

namespace snug::mesh_file {
namespace {
std::string upper_case(std::string text)
{
  for (char &c : text)
    c = std::toupper(static_cast<unsigned char>(c));
  return text;
}

/// The type @p name, in upper case, is a family, a number of nodes and letters for variants of
/// the formulation (R, H, I, M, T), which do not matter here. What 6 or 8 nodes mean depends on
/// the family: C3D6 is a prism, CPS6 a triangle.
ElementType abaqus_type(const std::string &name, unsigned long line)
{
  using S                                      = ElementShape;
  static const std::map<unsigned int, S> solid = {{4, S::tetrahedron},  {5, S::pyramid},
                                                  {6, S::prism},        {8, S::hexahedron},
                                                  {10, S::tetrahedron}, {15, S::prism},
                                                  {20, S::hexahedron},  {27, S::hexahedron}};
  static const std::map<unsigned int, S> flat  = {{3, S::triangle},
                                                  {4, S::quadrilateral},
                                                  {6, S::triangle},
                                                  {8, S::quadrilateral},
                                                  {9, S::quadrilateral}};
  static const std::map<unsigned int, S> thin  = {{2, S::line}, {3, S::line}};
  using Families = std::vector<std::pair<std::string, const std::map<unsigned int, S> *>>;
  // a prefix of other families must come behind them: CPE would take CPEG4, S STRI3
  static const Families families = {{"DC3D", &solid}, {"C3D", &solid}, {"CPS", &flat},
                                    {"CPEG", &flat},  {"CPE", &flat},  {"CAX", &flat},
                                    {"SFM3D", &flat}, {"STRI", &flat}, {"SAX", &thin},
                                    {"S", &flat},     {"M3D", &flat},  {"R3D", &flat},
                                    {"DC2D", &flat},  {"T2D", &thin},  {"T3D", &thin},
                                    {"R2D", &thin},   {"DC1D", &thin}};
  // A family with another number of nodes is passed over, since S also begins types that are
  // no shells (SPRINGA, without a number: atoi gives 0).
  for (const auto &family : families)
    if (name.rfind(family.first, 0) == 0)
      {
        // SAX1 and SAX2 are called by their order, the others by their number of nodes
        const unsigned int n =
          std::atoi(name.c_str() + family.first.size()) + (family.first == "SAX" ? 1 : 0);
        const auto found = family.second->find(n);
        if (found != family.second->end())
          return {found->second, n};
      }
  throw error_at_line(line, "elements of the type '" + name + "' cannot be read");
}

/// Reads an .inp file keyword by keyword.
///
/// A keyword line begins with one * and has options "KEY=VALUE" behind commas; data lines follow
/// up to the next keyword; ** is a comment. Keywords and names of sets mean the same in upper and
/// lower case. Nodes and elements have arbitrary positive numbers.
class AbaqusReader
{
public:
  explicit AbaqusReader(const std::string &text) : in(text) {}

  MeshFile read()
  {
    while (!in.at_end())
      {
        at                     = in.line();
        const std::string line = in.rest_of_line();
        if (line.empty() || line.rfind("**", 0) == 0)
          continue;
        if (line[0] == '*')
          begin_keyword(line);
        else
          read_data(comma_list(line), line);
      }
    if (!pending.empty())
      throw error_at_line(at, "the file ends within element " + pending[0]);
    return mesh;
  }

private:
  MeshText                                       in;
  unsigned long                                  at = 0; ///< line that is read
  std::string                                    keyword;
  std::map<std::string, std::string>             options; ///< of the keyword
  ElementType                                    type{ElementShape::line, 0};
  std::vector<std::string>                       pending; ///< an element over several lines
  unsigned int                                   n_parts = 0;
  MeshFile                                       mesh;
  PointNumbers                                   numbers;
  std::map<unsigned long, unsigned int>          element_index;
  std::map<std::string, std::set<unsigned long>> sets;
  std::map<std::string, std::string>             groups; ///< as they are written first

  void begin_keyword(const std::string &line)
  {
    if (!pending.empty())
      throw error_at_line(at, "element " + pending[0] + " is cut off");
    options.clear();
    for (const auto &part : comma_list(line))
      {
        const auto equals = part.find('=');
        const auto key    = upper_case(dealii::Utilities::trim(part.substr(0, equals)));
        options[key] =
          equals == std::string::npos ? "" : dealii::Utilities::trim(part.substr(equals + 1));
      }
    keyword = upper_case(comma_list(line)[0]);
    // Every part numbers its nodes and elements from 1, and the assembly places instances of the
    // parts; without reading that, numbers of two parts would clash.
    if (keyword == "*PART" && ++n_parts > 1)
      throw error_at_line(at, "the file has more than one part");
    refuse_generation();
    if (keyword == "*ELEMENT")
      type = abaqus_type(upper_case(options["TYPE"]), at);
  }

  /// What places or makes nodes and elements is not read, and must not be passed over: the mesh
  /// would be another one.
  void refuse_generation() const
  {
    static const std::set<std::string> others = {"*NGEN",  "*NFILL",  "*NCOPY",   "*NMAP",
                                                 "*ELGEN", "*ELCOPY", "*INCLUDE", "*SYSTEM"};
    const bool                         data   = keyword == "*NODE" || keyword == "*ELEMENT";
    const auto                         found  = options.find("SYSTEM");
    if (keyword == "*NODE" && found != options.end() && upper_case(found->second) != "R")
      refuse("*NODE with SYSTEM = " + found->second);
    if (others.count(keyword) > 0 || (data && options.count("INPUT") > 0))
      refuse(keyword + (data ? " with INPUT" : ""));
  }

  [[noreturn]] void refuse(const std::string &what) const
  {
    throw error_at_line(at, what + " is not read; save all nodes and elements in one file, the "
                                   "nodes at their places in Cartesian coordinates");
  }

  /// Data of keywords that are not listed here (materials, steps, node sets) are skipped.
  void read_data(const std::vector<std::string> &words, const std::string &line)
  {
    if (keyword == "*NODE")
      read_node(words);
    else if (keyword == "*ELEMENT")
      read_element(words);
    else if (keyword == "*ELSET")
      read_set(words);
    else if (keyword == "*SURFACE")
      read_surface(words);
    else if (keyword == "*INSTANCE")
      refuse("*INSTANCE that moves its part");
    else if (keyword.empty())
      throw error_at_line(at, "a keyword is expected, not '" + line + "'");
  }

  /// Number and 2 or 3 coordinates; direction cosines of a shell's normal may follow.
  void read_node(const std::vector<std::string> &words)
  {
    if (words.size() < 3)
      throw error_at_line(at, "a node and its coordinates are expected");
    numbers.add(to_whole(words[0], at), at);
    dealii::Point<3> point;
    for (unsigned int d = 0; d < 3 && d + 1 < words.size(); ++d)
      point[d] = to_number(words[d + 1], at);
    mesh.points.push_back(point);
  }

  /// Number and nodes. Elements of many nodes, such as C3D20, go on in further lines.
  void read_element(const std::vector<std::string> &words)
  {
    pending.insert(pending.end(), words.begin(), words.end());
    if (pending.size() < 1 + type.n_nodes)
      return;
    const auto        number = to_whole(pending[0], at);
    const std::string name   = "element " + pending[0];
    if (!element_index.emplace(number, mesh.elements.size()).second)
      throw error_at_line(at, name + " occurs twice");
    MeshFile::Element         element{type.shape, {}, {}, number, at};
    std::vector<unsigned int> nodes;
    for (unsigned int i = 1; i <= type.n_nodes; ++i)
      nodes.push_back(numbers.index(to_whole(pending[i], at), name, at));
    // Abaqus lists the corners first, then the nodes on edges, but of lines the middle second.
    if (type.shape == ElementShape::line)
      std::swap(nodes[1], nodes.back());
    add_nodes(mesh, element, nodes, abaqus_middles(type.shape));
    mesh.elements.push_back(element);
    pending.clear();
    if (!options["ELSET"].empty())
      add_to_set(options["ELSET"], number);
  }

  /// Sets are found in any case of letters; the group has the name as it is written first.
  /// Abaqus/CAE makes sets for its own use, such as _Surf-1_S2 of faces of a surface, which are no
  /// groups but would be regions.
  void add_to_set(const std::string &name, unsigned long number)
  {
    const auto found = element_index.find(number);
    if (found == element_index.end())
      throw error_at_line(at, "set '" + name + "' has the element " + std::to_string(number) +
                                ", which is not there");
    const std::string key = upper_case(name);
    // a set that is added to itself would double with every line
    if (sets[key].insert(number).second && name[0] != '_')
      mesh.elements[found->second].groups.push_back(groups.emplace(key, name).first->second);
  }

  /// Either first, last and increment (GENERATE), or any list of elements and other sets.
  void read_set(const std::vector<std::string> &words)
  {
    const std::string name = options["ELSET"];
    if (options.count("GENERATE") > 0)
      {
        if (words.size() < 2)
          throw error_at_line(at, "first and last element are expected");
        const auto last = to_whole(words[1], at);
        const auto step = words.size() > 2 ? std::max(1ul, to_whole(words[2], at)) : 1ul;
        for (auto e = to_whole(words[0], at); e <= last; e += step)
          add_to_set(name, e);
        return;
      }
    for (const auto &word : words)
      for (const auto number : elements_of(word))
        add_to_set(name, number);
  }

  /// Elements of a set or, by its number, one.
  std::vector<unsigned long> elements_of(const std::string &word) const
  {
    const auto found = sets.find(upper_case(word));
    if (found != sets.end())
      return {found->second.begin(), found->second.end()};
    return {to_whole(word, at)};
  }

  /// Lines "element or set, face", such as "_Surf-1_S2, S2": Abaqus/CAE makes an internal set for
  /// each face number of a surface.
  void read_surface(const std::vector<std::string> &words)
  {
    // Surfaces of nodes have no faces; ELEMENT is the default of TYPE.
    if (options.count("TYPE") > 0 && upper_case(options["TYPE"]) != "ELEMENT")
      return;
    const std::string name = options["NAME"];
    for (const auto number : elements_of(words[0]))
      {
        const auto found = element_index.find(number);
        if (found == element_index.end())
          throw error_at_line(at, "surface '" + name + "' has the element " +
                                    std::to_string(number) + ", which is not there");
        // a copy, since add_face() lets the list of elements grow
        const MeshFile::Element cell  = mesh.elements[found->second];
        const std::string       face  = words.size() > 1 ? upper_case(words[1]) : "";
        const auto             &faces = faces_of(cell.shape);
        const std::size_t which = face.size() == 2 && face[0] == 'S' ? face[1] - '1' : faces.size();
        if (which >= faces.size())
          throw error_at_line(at,
                              "element " + std::to_string(number) + " has no face '" + face + "'");
        add_face(cell, faces[which], name);
      }
  }

  /// Faces of surfaces are elements one dimension lower, as other formats have them; messages show
  /// the number of the cell.
  void add_face(const MeshFile::Element         &cell,
                const std::vector<unsigned int> &corners,
                const std::string               &name)
  {
    MeshFile::Element face = cell;
    face.shape             = corners.size() == 2   ? ElementShape::line
                             : corners.size() == 3 ? ElementShape::triangle
                                                   : ElementShape::quadrilateral;
    face.line              = at;
    face.groups            = {name};
    face.corners.clear();
    for (const unsigned int corner : corners)
      face.corners.push_back(cell.corners[corner]);
    mesh.elements.push_back(face);
  }
};
} // namespace

MeshFile read_abaqus(const std::string &text)
{
  return AbaqusReader(text).read();
}
} // namespace snug::mesh_file
