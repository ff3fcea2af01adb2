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

/// Return the element type @p name, which is in upper case. A name consists of a family, a number
/// of nodes and letters for variants of the formulation (R, H, I, M, T), which are ignored. The
/// shape depends on the family: C3D6 is a prism, CPS6 a triangle.
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
  // A family that is a prefix of others follows them, because otherwise CPE would match CPEG4, and
  // S would match STRI3.
  static const Families families = {{"DC3D", &solid}, {"C3D", &solid}, {"CPS", &flat},
                                    {"CPEG", &flat},  {"CPE", &flat},  {"CAX", &flat},
                                    {"SFM3D", &flat}, {"STRI", &flat}, {"SAX", &thin},
                                    {"S", &flat},     {"M3D", &flat},  {"R3D", &flat},
                                    {"DC2D", &flat},  {"T2D", &thin},  {"T3D", &thin},
                                    {"R2D", &thin},   {"DC1D", &thin}};
  // A family with another number of nodes is skipped, because S also begins types that are no
  // shells (SPRINGA has no number, and atoi returns 0).
  for (const auto &family : families)
    if (name.rfind(family.first, 0) == 0)
      {
        // The names SAX1 and SAX2 contain the order, all others the number of nodes.
        const unsigned int n =
          std::atoi(name.c_str() + family.first.size()) + (family.first == "SAX" ? 1 : 0);
        const auto found = family.second->find(n);
        if (found != family.second->end())
          return {found->second, n};
      }
  throw error_at_line(line, "element type '" + name + "' is not supported");
}

/// This class reads an .inp file keyword by keyword.
///
/// A keyword line begins with one * and has options "KEY=VALUE" behind commas. Data lines follow up
/// to the next keyword; ** begins a comment. Keywords and names of sets are equal in upper and
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
  MeshText                              in;
  unsigned long                         at = 0; ///< current line
  std::string                           keyword;
  std::map<std::string, std::string>    options; ///< options of the keyword
  ElementType                           type{ElementShape::line, 0};
  std::vector<std::string>              pending; ///< an incomplete element of several lines
  unsigned int                          n_parts = 0;
  MeshFile                              mesh;
  PointNumbers                          numbers;
  std::map<unsigned long, unsigned int> element_index;
  std::map<std::string, std::set<unsigned long>> sets;
  std::map<std::string, std::string>             groups; ///< upper case -> name as it occurs first

  void begin_keyword(const std::string &line)
  {
    if (!pending.empty())
      throw error_at_line(at, "element " + pending[0] + " is incomplete");
    options.clear();
    for (const auto &part : comma_list(line))
      {
        const auto equals = part.find('=');
        const auto key    = upper_case(dealii::Utilities::trim(part.substr(0, equals)));
        options[key] =
          equals == std::string::npos ? "" : dealii::Utilities::trim(part.substr(equals + 1));
      }
    keyword = upper_case(comma_list(line)[0]);
    // Several parts are refused, because every part numbers its nodes and elements from 1, and the
    // instances that place the parts are not read.
    if (keyword == "*PART" && ++n_parts > 1)
      throw error_at_line(at, "the file has more than one part");
    refuse_generation();
    if (keyword == "*ELEMENT")
      type = abaqus_type(upper_case(options["TYPE"]), at);
  }

  /// Refuse keywords that place or generate nodes and elements, because they are not supported and
  /// would change the mesh.
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
    throw error_at_line(at, what + " is not supported; write all nodes and elements to one file, "
                                   "in Cartesian coordinates");
  }

  /// Read a data line. Data of other keywords (materials, steps, node sets) are skipped.
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
      refuse("*INSTANCE with a translation or rotation");
    else if (keyword.empty())
      throw error_at_line(at, "a keyword is expected, not '" + line + "'");
  }

  /// Read a node: its number and 2 or 3 coordinates. Direction cosines of a shell's normal may
  /// follow.
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

  /// Read an element: its number and nodes. Elements of many nodes, such as C3D20, continue on
  /// further lines.
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
    // Abaqus lists the corners before the nodes on edges, but the middle node of a line second.
    if (type.shape == ElementShape::line)
      std::swap(nodes[1], nodes.back());
    add_nodes(mesh, element, nodes, abaqus_middles(type.shape));
    mesh.elements.push_back(element);
    pending.clear();
    if (!options["ELSET"].empty())
      add_to_set(options["ELSET"], number);
  }

  /// Add an element to a set. Names of sets are equal in upper and lower case, and the group has
  /// the name as it occurs first. Internal sets of Abaqus/CAE, such as _Surf-1_S2 for faces of a
  /// surface, are no groups, because they would become regions.
  void add_to_set(const std::string &name, unsigned long number)
  {
    const auto found = element_index.find(number);
    if (found == element_index.end())
      throw error_at_line(at, "set '" + name + "' has the element " + std::to_string(number) +
                                ", which does not exist");
    const std::string key = upper_case(name);
    // An element is added once, because a set that is added to itself would double with every line.
    if (sets[key].insert(number).second && name[0] != '_')
      mesh.elements[found->second].groups.push_back(groups.emplace(key, name).first->second);
  }

  /// Read a set: first, last and increment (GENERATE), or a list of elements and other sets.
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

  /// Return the elements of the set @p word, or the element with the number @p word.
  std::vector<unsigned long> elements_of(const std::string &word) const
  {
    const auto found = sets.find(upper_case(word));
    if (found != sets.end())
      return {found->second.begin(), found->second.end()};
    return {to_whole(word, at)};
  }

  /// Read a line "element or set, face" of a surface, such as "_Surf-1_S2, S2" with an internal set
  /// of Abaqus/CAE, which has one for each face number of a surface.
  void read_surface(const std::vector<std::string> &words)
  {
    // Surfaces of nodes have no faces. ELEMENT is the default of TYPE.
    if (options.count("TYPE") > 0 && upper_case(options["TYPE"]) != "ELEMENT")
      return;
    const std::string name = options["NAME"];
    for (const auto number : elements_of(words[0]))
      {
        const auto found = element_index.find(number);
        if (found == element_index.end())
          throw error_at_line(at, "surface '" + name + "' has the element " +
                                    std::to_string(number) + ", which does not exist");
        // The cell is copied, because add_face() may reallocate the list of elements.
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

  /// Add a face of a surface as an element one dimension lower, with the number of the cell.
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
