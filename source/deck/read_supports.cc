#include <snug/deck/keyword_reader.h>
#include <snug/deck/step_items.h>

#include <algorithm>
#include <memory>

namespace snug::deck {
using mesh_file::error_at_line;
using mesh_file::Keyword;
using mesh_file::to_number;
using mesh_file::to_whole;
using mesh_file::upper_case;
using Words = std::vector<std::string>;

namespace {
/// This class reads the supports of faces and nodes, and the motions of rigid bodies.
class SupportReader
{
public:
  explicit SupportReader(Reading &reading)
    : reading(reading), sets(reading.deck.sets), dim(reading.bodies.dimension())
  {}

  /// Read a line "node or set, first component, last component, value", or "set, ENCASTRE".
  void read_boundary(const Keyword &keyword)
  {
    if (is_new(keyword))
      {
        drop_earlier(reading.current().prescribed, reading.n_steps);
        drop_earlier(reading.current().held_nodes, reading.n_steps);
        drop_earlier(reading.current().motions, reading.n_steps);
      }
    std::set<std::pair<std::string, Words>> known; // lines with the same data are one set
    reading.text.for_each_line(keyword, [&](const Words &words, const unsigned long line) {
      if (words.size() < 2)
        throw error_at_line(line, "a set and its components are expected");
      const auto key    = sets.find(sets.of_nodes, words[0], "");
      const auto listed = sets.of_lines.find(mesh_file::DeckSets::group(keyword, words));
      if (listed == sets.of_lines.end() && key.empty())
        throw error_at_line(line, "there is no node set '" + words[0] + "'");
      const auto set        = key.empty() ? listed->second[0] : sets.boundary_of_nodes(key);
      auto       components = components_of(keyword, words, line);
      const auto value = words.size() > 3 && !words[3].empty() ? to_number(words[3], line) : 0.;
      const DeckModel::Given given{value * reading.factor(keyword), line, reading.n_steps,
                                   keyword.has("FIXED")};
      bool                   is_motion = true; // of reference nodes only
      for (const unsigned int node : sets.nodes(words[0], "", keyword.title, line))
        {
          is_motion = is_motion && reading.references.count({node, 0}) > 0;
          // Only the nodes of bolts have one component.
          if (given.is_fixed && (!is_motion || reading.references.count({node, 1}) > 0))
            return reading.lacks(keyword, ": the option FIXED of a node that is not a bolt's",
                                 line);
          for (const unsigned int c : components)
            if (const auto of = reading.references.find({node, c}); of != reading.references.end())
              reading.current().motions[of->second] = given;
        }
      if (is_motion || !known.emplace(set, Words(words.begin() + 1, words.end())).second)
        return;
      // Nodes of solids have no rotations (4 to 6), and nodes of a plane model no third component.
      erase_if(components, [&](const auto c) { return c >= dim; });
      hold(keyword, set, components, given);
    });
  }

private:
  Reading                   &reading;
  const mesh_file::DeckSets &sets;
  const unsigned int         dim;

  /// Return the components, from 0, of a line of *BOUNDARY, with rotations.
  std::vector<unsigned int>
  components_of(const Keyword &keyword, const Words &words, const unsigned long line)
  {
    static const std::map<std::string, std::string> names = {
      {"ENCASTRE", "123456"}, {"PINNED", "123"}, {"XSYMM", "156"},  {"YSYMM", "246"},
      {"ZSYMM", "345"},       {"XASYMM", "234"}, {"YASYMM", "135"}, {"ZASYMM", "126"}};
    const auto                named = names.find(upper_case(words[1]));
    std::vector<unsigned int> components;
    if (named != names.end())
      for (const char digit : named->second)
        components.push_back(digit - '1');
    else
      {
        const auto first = to_whole(words[1], line);
        const auto last  = words.size() > 2 && !words[2].empty() ? to_whole(words[2], line) : first;
        if (first < 1 || last < first || last > 6)
          {
            reading.lacks(keyword, " of components other than 1 to 6", line);
            return {};
          }
        for (auto c = first; c <= last; ++c)
          components.push_back(c - 1);
      }
    return components;
  }

  /// Hold the whole faces of a set, and its nodes that are on none of them.
  void hold(const Keyword                   &keyword,
            const std::string               &set,
            const std::vector<unsigned int> &components,
            const DeckModel::Given          &given)
  {
    auto      &step           = reading.current();
    auto       nodes          = reading.bodies.nodes_without_face(set);
    const bool has_cell_nodes = !nodes.empty();
    const bool is_full        = given.value == 0. && components.size() == dim;
    reading.bodies.use(set);
    if (drop_inner(nodes, set))
      reading.lacks(keyword, " of nodes inside of a body", given.line);
    if (set.find_first_of(",:;=#\\+") != std::string::npos || reading.bodies.use(set))
      {
        if (!reading.use(keyword, set, given.line))
          return;
        const auto &of_set = reading.deck.mesh.optional_boundaries.at(set).nodes;
        for (const unsigned int c : components)
          if (const auto along = component(of_set, c, is_full, reading.bodies.bodies_of(set)))
            step.prescribed.push_back(
              {set, along->first, along->second * given.value, given.line, reading.n_steps});
          else if (given.value == 0. && is_normal(set, c))
            step.prescribed.push_back({set, 3, 0., given.line, reading.n_steps});
          else
            reading.lacks(keyword,
                          " along axes of *TRANSFORM that are neither coordinate axes nor "
                          "normals of the faces nor of one cylinder of the body",
                          given.line);
      }
    for (const unsigned int node : nodes)
      for (const unsigned int c : components)
        if (const auto along = component({node}, c, is_full, {*reading.bodies.body_at(node)}))
          step.held_nodes[{node, along->first}] = {along->second * given.value, given.line,
                                                   reading.n_steps};
        else
          reading.lacks(keyword,
                        " of nodes along axes of *TRANSFORM that are neither coordinate axes nor "
                        "those of one cylinder of the body",
                        given.line);
    if (!nodes.empty())
      reading.remarks.replaced("point supports for nodes of " + title_of(keyword) +
                                 " that are not those of whole faces; stresses there depend on the "
                                 "mesh",
                               given.line);
    else if (!reading.bodies.use(set) && !has_cell_nodes)
      reading.remarks.not_needed(title_of(keyword) + " of nodes that belong to no cell",
                                 given.line);
  }

  /// Erase the nodes that lie on no outer face. Return whether their supports are needed: if all
  /// faces of a body are held equally, they hold its inside as well.
  bool drop_inner(std::set<unsigned int> &nodes, const std::string &set) const
  {
    bool is_whole = true;
    for (const unsigned int b : reading.bodies.bodies_of(set))
      is_whole =
        is_whole && reading.bodies.faces_on(b, set).size() == reading.bodies.all()[b].outer.size();
    bool is_needed = false;
    for (auto node = nodes.begin(); node != nodes.end();)
      if (reading.bodies.body_at(*node))
        ++node;
      else
        {
          is_needed = is_needed || !is_whole || reading.bodies.bodies_of(set).empty();
          node      = nodes.erase(node);
        }
    return is_needed;
  }

  /// Return the component of the scene along local component @p c at the nodes of @p bodies, and
  /// its sign, or nothing. Components about an axis become those of the bodies. @p is_full: nodes
  /// that are held in all components need no local ones.
  std::optional<std::pair<unsigned int, double>> component(const std::set<unsigned int>    &nodes,
                                                           const unsigned int               c,
                                                           const bool                       is_full,
                                                           const std::vector<unsigned int> &bodies)
  {
    if (is_full)
      return std::make_pair(c, 1.);
    if (const auto axis = reading.axes.axis(nodes, c); axis && axis->first < dim)
      return axis;
    const auto round = reading.axes.cylinder(nodes);
    if (dim == 2 || !round)
      return {};
    for (const unsigned int b : bodies)
      if (!(reading.model.cylinders.emplace(b, *round).first->second == *round))
        return {};
    return std::make_pair(4 + c, 1.);
  }

  bool is_normal(const std::string &set, const unsigned int component) const
  {
    const auto faces = reading.bodies.faces_of(set);
    return std::all_of(faces.begin(), faces.end(), [&](const auto &corners) {
      return reading.axes.is_normal(corners, component);
    });
  }
};
} // namespace

KeywordReadings support_readings(Reading &reading)
{
  const auto reader = std::make_shared<SupportReader>(reading);
  return {{"BOUNDARY",
           {[reader](const Keyword &keyword) { reader->read_boundary(keyword); },
            {{"OP", "AMPLITUDE", "FIXED"}, {}}}}};
}
} // namespace snug::deck
