#include <snug/geometry/cell_numbering.h>
#include <snug/mesh_file/deck_parts.h>
#include <snug/mesh_file/deck_sets.h>
#include <snug/mesh_file/deck_text.h>
#include <snug/mesh_file/element_split.h>
#include <snug/mesh_file/mesh_formats.h>

#include <algorithm>

namespace snug::mesh_file {
namespace {
using Words = std::vector<std::string>;
using Point = dealii::Point<3>;

/// This class reads a deck. Keywords and names of sets are equal in upper and lower case. Sets are
/// stored under their names in upper case, those of an instance behind "INSTANCE.".
class AbaqusReader
{
public:
  explicit AbaqusReader(const std::string &text) : deck(text), parts(deck) {}

  DeckMesh read()
  {
    const auto &keywords = deck.keywords();
    sets.scopes[""];
    sets.qualified_names = parts.qualified_names;
    for (std::size_t k = 0; k < keywords.size(); ++k)
      if (keywords[k].name == "INSTANCE")
        k = read_instance(k);
      else if (keywords[k].name == "PART" && parts.has_instances)
        k = parts.end_of(k);
      else if (keywords[k].name == "PART" && ++n_parts > 1)
        throw keyword_error(keywords[k],
                            "the file has more than one part, but no *INSTANCE that places them");
      else
        read_keyword(keywords[k], "");
    cut_at_sections(deck, sets, mesh);
    add_node_sets();
    name_connected_cells(mesh);
    auto pairs = general_pairs(deck, sets, mesh);
    return {std::move(mesh), std::move(sets), std::move(point_elements), std::move(pairs)};
  }

private:
  DeckText                             deck;
  DeckParts                            parts;
  unsigned long                        at      = 0; ///< current line
  unsigned int                         n_parts = 0;
  MeshFile                             mesh;
  DeckSets                             sets;
  std::map<unsigned int, PointElement> point_elements;
  /// key of lines of *DLOAD and sorted corners of a face -> number of its loads
  std::map<std::pair<std::pair<std::size_t, std::string>, std::vector<unsigned int>>, unsigned int>
    n_loads;

  /// Read the instance that keyword @p k begins, and return the index of its last keyword.
  std::size_t read_instance(const std::size_t k)
  {
    const auto       &keywords = deck.keywords();
    const auto       &keyword  = keywords[k];
    const std::string name = keyword.option("NAME"), prefix = upper_case(name) + ".";
    const auto        part = parts.keyword_of.find(upper_case(keyword.option("PART")));
    if (part == parts.keyword_of.end())
      throw keyword_error(keyword, "instance '" + name + "' has the part '" +
                                     keyword.option("PART") + "', which does not exist");
    if (name.empty() || sets.scopes.count(prefix) > 0)
      throw keyword_error(keyword, "instance '" + name + "' has no name or occurs twice");
    sets.scopes[prefix].instance = name;
    sets.scopes[prefix].part     = part->first;
    sets.scopes[prefix].place    = instance_place(deck, keyword);
    for (std::size_t p = part->second + 1; p < parts.end_of(part->second); ++p)
      read_keyword(keywords[p], prefix);
    const std::size_t end = parts.end_of(k);
    for (std::size_t own = k + 1; own < end; ++own)
      read_keyword(keywords[own], prefix);
    return end;
  }

  void read_keyword(const Keyword &keyword, const std::string &prefix)
  {
    refuse_generation(keyword);
    at = keyword.line;
    if (keyword.name == "ELEMENT")
      return read_elements(keyword, prefix);
    if (keyword.name == "SOLIDSECTION")
      return read_section(keyword, prefix);
    using Read = void (AbaqusReader::*)(const Words &, const Keyword &, const std::string &);
    static const std::map<std::string, Read> reads = {{"NODE", &AbaqusReader::read_node},
                                                      {"ELSET", &AbaqusReader::read_elset},
                                                      {"NSET", &AbaqusReader::read_nset},
                                                      {"SURFACE", &AbaqusReader::read_surface},
                                                      {"BOUNDARY", &AbaqusReader::read_boundary},
                                                      {"DLOAD", &AbaqusReader::read_pressure}};
    const auto                               found = reads.find(keyword.name);
    if (found == reads.end())
      return;
    deck.for_each_line(keyword, [&](const Words &words, const unsigned long line) {
      at = line;
      (this->*found->second)(words, keyword, prefix);
    });
  }

  /// Read a node: its number and 2 or 3 coordinates. The normal of a shell may follow.
  void read_node(const Words &words, const Keyword &keyword, const std::string &prefix)
  {
    if (words.size() < 3)
      throw error_at_line(at, "a node and its coordinates are expected");
    Scope             &scope = sets.scopes.at(prefix);
    const unsigned int index = mesh.points.size();
    scope.nodes.add(to_whole(words[0], at), index, at);
    Point point;
    for (unsigned int d = 0; d < 3 && d + 1 < words.size(); ++d)
      point[d] = to_number(words[d + 1], at);
    mesh.points.push_back(scope.place(point));
    if (keyword.has("NSET"))
      sets.of_nodes[sets.key(keyword.option("NSET"), prefix)].insert(index);
  }

  /// Read elements: their numbers and nodes. Elements such as C3D20 continue on further lines.
  void read_elements(const Keyword &keyword, const std::string &prefix)
  {
    const std::string name = upper_case(keyword.option("TYPE"));
    if (is_point_element(name))
      return read_point_elements(keyword, prefix, name);
    const ElementType type = abaqus_type(name, keyword.line);
    Words             pending;
    deck.for_each_line(keyword, [&](const Words &words, const unsigned long line) {
      at = line;
      pending.insert(pending.end(), words.begin(), words.end());
      if (pending.size() < 1 + type.n_nodes)
        return;
      read_element(pending, type, keyword, prefix);
      pending.clear();
    });
    if (!pending.empty())
      throw error_at_line(at, "element " + pending[0] + " is incomplete");
  }

  /// Read elements with one line each: their numbers and nodes.
  void
  read_point_elements(const Keyword &keyword, const std::string &prefix, const std::string &type)
  {
    Scope &scope = sets.scopes.at(prefix);
    deck.for_each_line(keyword, [&](const Words &words, const unsigned long line) {
      at                 = line;
      const auto   name  = "element " + words[0];
      const auto   index = new_element(words[0], prefix);
      PointElement element{type, {}, keyword.line};
      for (std::size_t i = 1; i < words.size(); ++i)
        if (!words[i].empty())
          element.nodes.push_back(scope.nodes.index(to_whole(words[i], at), name, at));
      if (element.nodes.empty())
        throw error_at_line(at, name + " has no node");
      mesh.elements.push_back(
        {ElementShape::vertex, {element.nodes[0]}, {}, to_whole(words[0], at), at});
      point_elements.emplace(index, std::move(element));
      if (keyword.has("ELSET"))
        add_to_set(keyword.option("ELSET"), prefix, index);
    });
  }

  /// Return the index of the next element, whose number in the file is @p number.
  unsigned int new_element(const std::string &number, const std::string &prefix)
  {
    const unsigned int index = mesh.elements.size();
    if (!sets.scopes.at(prefix).elements.emplace(to_whole(number, at), index).second)
      throw error_at_line(at, "element " + number + " occurs twice");
    return index;
  }

  void read_element(const Words       &words,
                    const ElementType &type,
                    const Keyword     &keyword,
                    const std::string &prefix)
  {
    Scope                    &scope = sets.scopes.at(prefix);
    const std::string         name  = "element " + words[0];
    const unsigned int        index = new_element(words[0], prefix);
    MeshFile::Element         element{type.shape, {}, {}, to_whole(words[0], at), at};
    std::vector<unsigned int> nodes;
    for (unsigned int i = 1; i <= type.n_nodes; ++i)
      nodes.push_back(scope.nodes.index(to_whole(words[i], at), name, at));
    // Abaqus lists the corners before the nodes on edges, but the middle node of a line second.
    if (type.shape == ElementShape::line)
      std::swap(nodes[1], nodes.back());
    add_nodes(mesh, element, nodes, abaqus_middles(type.shape));
    if (!prefix.empty())
      element.groups.push_back(scope.instance);
    mesh.elements.push_back(element);
    if (keyword.has("ELSET"))
      add_to_set(keyword.option("ELSET"), prefix, index);
  }

  /// Add an element to a set. Internal sets of Abaqus/CAE, such as _Surf-1_S2 for faces of a
  /// surface, are no groups, because they would become regions.
  void add_to_set(const std::string &name, const std::string &prefix, const unsigned int element)
  {
    const std::string key = sets.key(name, prefix);
    // An element is added once, because a set that is added to itself would double with every line.
    if (sets.of_elements[key].insert(element).second && name[0] != '_')
      {
        // Sets with the same name in several instances are one group.
        auto &groups = mesh.elements[element].groups;
        if (std::find(groups.begin(), groups.end(), sets.spelling.at(key)) == groups.end())
          groups.push_back(sets.spelling.at(key));
      }
  }

  /// Call @p add with each member of a line of a set: first, last and increment (GENERATE), or a
  /// list of numbers and other sets. INSTANCE names the numbering of the members.
  template <typename Find, typename Add>
  void read_members(const Words       &words,
                    const Keyword     &keyword,
                    const std::string &prefix,
                    const Find        &find,
                    const Add         &add) const
  {
    std::string scope = prefix;
    if (keyword.has("INSTANCE"))
      scope = upper_case(keyword.option("INSTANCE")) + ".";
    if (sets.scopes.count(scope) == 0)
      throw keyword_error(keyword, "there is no instance '" + keyword.option("INSTANCE") + "'");
    if (!keyword.has("GENERATE"))
      {
        for (const auto &word : words)
          for (const unsigned int index : find(word, scope))
            add(index);
        return;
      }
    if (words.size() < 2)
      throw error_at_line(at, "first and last member are expected");
    const auto last = to_whole(words[1], at);
    const auto step = words.size() > 2 ? std::max(1ul, to_whole(words[2], at)) : 1ul;
    for (auto n = to_whole(words[0], at); n <= last; n += step)
      for (const unsigned int index : find(std::to_string(n), scope))
        add(index);
  }

  void read_elset(const Words &words, const Keyword &keyword, const std::string &prefix)
  {
    const std::string name = keyword.option("ELSET");
    read_members(
      words, keyword, prefix,
      [&](const std::string &word, const std::string &scope) {
        return sets.elements(word, scope, "set '" + name + "'", at);
      },
      [&](const unsigned int element) { add_to_set(name, prefix, element); });
  }

  void read_nset(const Words &words, const Keyword &keyword, const std::string &prefix)
  {
    const std::string name = keyword.option("NSET");
    const std::string key  = sets.key(name, prefix);
    read_members(
      words, keyword, prefix,
      [&](const std::string &word, const std::string &scope) {
        return sets.nodes(word, scope, "set '" + name + "'", at);
      },
      [&](const unsigned int node) { sets.of_nodes[key].insert(node); });
  }

  /// Read a line "element or set, face" of a surface, such as "_Surf-1_S2, S2". Without a face all
  /// outer faces of the elements belong to the surface. A surface of nodes is a node set.
  void read_surface(const Words &words, const Keyword &keyword, const std::string &prefix)
  {
    const std::string name = keyword.option("NAME"), type = upper_case(keyword.option("TYPE"));
    const std::string key = sets.key(name, prefix);
    if (type == "NODE")
      for (const unsigned int node : sets.nodes(words[0], prefix, "surface '" + name + "'", at))
        sets.of_nodes[key].insert(node);
    if (!type.empty() && type != "ELEMENT")
      return;
    sets.surfaces.insert(sets.spelling.at(key));
    for (const unsigned int element : sets.elements(words[0], prefix, "surface '" + name + "'", at))
      {
        // The cell is copied, because push_back() may move the elements.
        const MeshFile::Element cell = mesh.elements[element];
        const auto              side = words.size() > 1 ? upper_case(words[1]) : "";
        if (side == "SPOS" || side == "SNEG")
          {
            // A shell or a rigid element is a face itself.
            mesh.elements.push_back(cell);
            mesh.elements.back().groups = {sets.spelling.at(key)};
          }
        else if (words.size() > 1)
          mesh.elements.push_back(
            face_of(cell, face_number(cell, words[1], 'S'), sets.spelling.at(key)));
        else
          for (unsigned int f = 0; f < faces_of(cell.shape).size(); ++f)
            mesh.elements.push_back(face_of(cell, f, sets.spelling.at(key)));
      }
  }

  /// Add an optional boundary for the lines of a keyword that have the same data as @p words. It is
  /// named by the first of these lines, "Dload-17"; lines of several files may have one number.
  std::string add_boundary(const Keyword &keyword, const Words &words)
  {
    const std::string first =
      (keyword.name == "DLOAD" ? "Dload-" : "Boundary-") + std::to_string(at);
    std::string name = first;
    for (unsigned int n = 2; mesh.optional_boundaries.count(name) > 0; ++n)
      name = first + "-" + std::to_string(n);
    sets.of_lines[DeckSets::group(keyword, words)].push_back(name);
    mesh.optional_boundaries[name];
    return name;
  }

  /// Read a line "element or set, P3, pressure" of *DLOAD. A face that is loaded again by equal
  /// data belongs to a further boundary, because its pressures are added.
  void read_pressure(const Words &words, const Keyword &keyword, const std::string &prefix)
  {
    if (words.size() < 3 || words[1].size() != 2 || upper_case(words[1])[0] != 'P')
      return;
    const auto key = DeckSets::group(keyword, words);
    for (const unsigned int element : sets.elements(words[0], prefix, keyword.title, at))
      {
        const auto &cell  = mesh.elements[element];
        const auto  face  = face_of(cell, face_number(cell, words[1], 'P'), "");
        const auto  times = n_loads[{key, geometry::sorted(face.corners)}]++;
        const auto &names = sets.of_lines[key];
        const auto  name  = times < names.size() ? names[times] : add_boundary(keyword, words);
        mesh.optional_boundaries[name].faces.push_back(face);
      }
  }

  /// Read a line of *BOUNDARY that begins with a number of a node, and not with a set.
  void read_boundary(const Words &words, const Keyword &keyword, const std::string &prefix)
  {
    if (!sets.find(sets.of_nodes, words[0], prefix).empty())
      return;
    const auto &names = sets.of_lines[DeckSets::group(keyword, words)];
    const auto  name  = names.empty() ? add_boundary(keyword, words) : names[0];
    for (const unsigned int node : sets.nodes(words[0], prefix, keyword.title, at))
      mesh.optional_boundaries[name].nodes.insert(node);
  }

  /// Read a section. Elements of an internal set of Abaqus/CAE are in the group of their material.
  void read_section(const Keyword &keyword, const std::string &prefix)
  {
    const std::string name = keyword.option("ELSET");
    if (name.empty() || name[0] != '_')
      return;
    for (const unsigned int element : sets.elements(name, prefix, keyword.title, keyword.line))
      add_to_set(keyword.option("MATERIAL"), prefix, element);
  }

  /// Return the index of the face @p word, such as S2, of a cell.
  unsigned int
  face_number(const MeshFile::Element &cell, const std::string &word, char letter) const
  {
    const auto       &faces  = faces_of(cell.shape);
    const auto        face   = upper_case(word);
    const std::size_t number = face.size() == 2 && face[0] == letter ? face[1] - '1' : faces.size();
    if (number >= faces.size())
      throw error_at_line(at,
                          "element " + std::to_string(cell.number) + " has no face '" + word + "'");
    return number;
  }

  /// Return a face as an element one dimension lower, with the number of the cell.
  MeshFile::Element
  face_of(const MeshFile::Element &cell, const unsigned int number, const std::string &name) const
  {
    const auto       &corners = faces_of(cell.shape)[number];
    MeshFile::Element face    = cell;
    face.shape                = face_shape(corners);
    face.line                 = at;
    face.groups               = {name};
    face.corners.clear();
    for (const unsigned int corner : corners)
      face.corners.push_back(cell.corners[corner]);
    return face;
  }

  void add_node_sets()
  {
    for (const auto &[key, nodes] : sets.of_nodes)
      mesh.optional_boundaries[sets.boundary_of_nodes(key)].nodes.insert(nodes.begin(),
                                                                         nodes.end());
  }
};
} // namespace

DeckMesh read_deck(const std::string &text)
{
  return AbaqusReader(text).read();
}

MeshFile read_abaqus(const std::string &text)
{
  return read_deck(text).mesh;
}
} // namespace snug::mesh_file
