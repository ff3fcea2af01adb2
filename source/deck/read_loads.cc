#include <snug/deck/amplitudes.h>
#include <snug/deck/keyword_reader.h>
#include <snug/deck/local_axes.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace snug::deck {
using mesh_file::error_at_line;
using mesh_file::Keyword;
using mesh_file::keyword_error;
using mesh_file::numbers_from;
using mesh_file::to_number;
using mesh_file::to_whole;
using mesh_file::upper_case;
using Words = std::vector<std::string>;

namespace {
unsigned int step_of(const std::vector<DeckModel::Given> &sum)
{
  return sum.front().step;
}

/// Return the reference nodes of all rigid bodies, which may follow their supports in the deck.
std::set<unsigned int> reference_nodes(const Reading &reading)
{
  std::set<unsigned int> result;
  for (const auto &keyword : reading.text.keywords())
    if (keyword.name == "RIGIDBODY" && keyword.has("REFNODE"))
      for (const unsigned int node :
           reading.deck.sets.nodes(keyword.option("REFNODE"), "", keyword.title, keyword.line))
        result.insert(node);
  return result;
}

template <typename Item>
unsigned int step_of(const Item &item)
{
  return item.step;
}

/// This class reads the supports and the loads of the steps.
class LoadReader
{
public:
  explicit LoadReader(Reading &reading)
    : reading(reading)
    , sets(reading.deck.sets)
    , dim(reading.bodies.dimension())
    , amplitudes(reading.text)
    , axes(reading.text, reading.deck)
    , references(reference_nodes(reading))
  {}

  void begin_step(const Keyword &keyword)
  {
    if (in_step)
      throw keyword_error(keyword, "*STEP within a step; *END STEP is missing");
    if (keyword.has("NLGEOM") && upper_case(keyword.option("NLGEOM")) != "NO")
      reading.remarks.replaced("small displacements instead of NLGEOM", keyword.line);
    in_step = true;
    ++n_steps;
    auto &steps = reading.model.steps;
    steps.push_back(steps.empty() ? reading.model.initial : steps.back());
    steps.back().name = keyword.option("NAME");
    steps.back().line = keyword.line;
  }

  void end_step(const Keyword &keyword)
  {
    if (!in_step)
      throw keyword_error(keyword, "*END STEP without *STEP");
    in_step = false;
  }

  void read_static(const Keyword &keyword) { require_step(keyword); }

  /// Read a line "node or set, first component, last component, value", or "set, ENCASTRE".
  void read_boundary(const Keyword &keyword)
  {
    if (is_new(keyword))
      {
        drop_earlier(current().prescribed);
        drop_earlier(current().held_nodes);
        drop_earlier(current().motions);
      }
    std::set<std::pair<std::string, Words>> known; // lines with the same data are one set
    reading.text.for_each_line(keyword, [&](const Words &words, const unsigned long line) {
      if (words.size() < 2)
        throw error_at_line(line, "a set and its components are expected");
      const auto key    = sets.find(sets.of_nodes, words[0], "");
      const auto listed = sets.of_lines.find(mesh_file::DeckSets::group(keyword, words));
      if (listed == sets.of_lines.end() && key.empty())
        throw error_at_line(line, "there is no node set '" + words[0] + "'");
      const auto set        = key.empty() ? listed->second : sets.boundary_of_nodes(key);
      const auto components = components_of(keyword, words, line);
      if (!known.emplace(set, Words(words.begin() + 1, words.end())).second)
        return;
      if (is_motion(keyword, words, line))
        return;
      const double given = words.size() > 3 && !words[3].empty() ? to_number(words[3], line) : 0.;
      hold(keyword, set, components, {given * factor(keyword), line, n_steps});
    });
  }

  /// Read a line "surface, P, pressure" or "surface, TRVEC, magnitude, direction".
  void read_surface_load(const Keyword &keyword)
  {
    begin_loads(keyword);
    reading.text.for_each_line(keyword, [&](const Words &words, const unsigned long line) {
      const auto type = words.size() > 2 ? upper_case(words[1]) : "";
      if (type != "P" && type != "TRVEC")
        return reading.lacks(keyword, " of type '" + type + "'", line);
      const auto set     = reading.surface(words[0], line);
      const auto numbers = numbers_from(words, 2, line);
      if (!reading.use(keyword, set, line))
        return;
      if (type == "P")
        add(keyword, current().pressures, set, {numbers[0]}, line);
      else
        add(keyword, current().tractions, set, vector_from(numbers), line);
    });
  }

  /// Read a line "elements, P3, pressure" or "elements, GRAV, magnitude, direction".
  void read_element_load(const Keyword &keyword)
  {
    begin_loads(keyword);
    std::set<std::string> known; // lines with the same data are one set
    reading.text.for_each_line(keyword, [&](const Words &words, const unsigned long line) {
      const auto type   = words.size() > 2 ? upper_case(words[1]) : "";
      const auto listed = sets.of_lines.find(mesh_file::DeckSets::group(keyword, words));
      if (type == "GRAV")
        read_gravity(keyword, words, line);
      else if (type.size() != 2 || type[0] != 'P' || listed == sets.of_lines.end())
        reading.lacks(keyword, " of type '" + type + "'", line);
      else if (known.insert(listed->second).second && reading.use(keyword, listed->second, line))
        add(keyword, current().pressures, listed->second, {to_number(words[2], line)}, line);
    });
  }

  /// Read a line "node or set, component, force".
  void read_point_load(const Keyword &keyword)
  {
    begin_loads(keyword);
    reading.text.for_each_line(keyword, [&](const Words &words, const unsigned long line) {
      if (words.size() < 3)
        throw error_at_line(line, "a node or set, a component and a force are expected");
      const auto   nodes     = sets.nodes(words[0], "", keyword.title, line);
      const auto   component = to_whole(words[1], line);
      const double force     = to_number(words[2], line) * factor(keyword);
      if (component < 1 || component > dim)
        return reading.lacks(keyword, " of component " + words[1], line);
      if (component == 1 && reading.model.model == "axisymmetric")
        return reading.lacks(keyword, " along the radius of an axisymmetric model", line);
      for (const unsigned int node : nodes)
        {
          const auto direction = axes.direction(node, component - 1);
          for (unsigned int c = 0; c < dim; ++c)
            if (direction[c] != 0.)
              {
                auto &sum = current().point_forces[{node, c}];
                if (!sum.empty() && step_of(sum) < n_steps)
                  sum.clear();
                sum.push_back({force * direction[c], line, n_steps});
              }
        }
    });
  }

  /// Read a line "node or set, temperature" of a step or of the initial state.
  void read_temperature(const Keyword &keyword)
  {
    const bool is_initial = keyword.name == "INITIALCONDITIONS";
    if (is_initial && upper_case(keyword.option("TYPE")) != "TEMPERATURE")
      return reading.lacks(keyword, " of type " + keyword.option("TYPE"));
    if (is_new(keyword))
      drop_earlier(current().temperatures);
    reading.text.for_each_line(keyword, [&](const Words &words, const unsigned long line) {
      if (words.size() < 2)
        throw error_at_line(line, "a node or set and a temperature are expected");
      const double value = to_number(words[1], line) * factor(keyword);
      for (const unsigned int node : sets.nodes(words[0], "", keyword.title, line))
        if (is_initial)
          reading.model.initial_temperatures[node] = value;
        else
          current().temperatures[node] = {value, line, n_steps};
    });
  }

private:
  Reading                     &reading;
  const mesh_file::DeckSets   &sets;
  const unsigned int           dim;
  const Amplitudes             amplitudes;
  const LocalAxes              axes;
  const std::set<unsigned int> references; ///< reference nodes of rigid bodies
  unsigned int                 n_steps = 0;
  bool                         in_step = false;

  DeckModel::Step &current()
  {
    return n_steps == 0 ? reading.model.initial : reading.model.steps.back();
  }

  void require_step(const Keyword &keyword) const
  {
    if (!in_step)
      throw keyword_error(keyword, keyword.title + " must stand in a step");
  }

  static bool is_new(const Keyword &keyword) { return upper_case(keyword.option("OP")) == "NEW"; }

  double factor(const Keyword &keyword) const { return amplitudes.at_end(keyword, n_steps); }

  /// Erase the items for which a condition holds.
  template <typename Item, typename Condition>
  static void erase_if(std::vector<Item> &items, const Condition &condition)
  {
    items.erase(std::remove_if(items.begin(), items.end(), condition), items.end());
  }

  template <typename Item>
  void drop_earlier(std::vector<Item> &items) const
  {
    erase_if(items, [&](const Item &item) { return item.step < n_steps; });
  }

  template <typename Key, typename Item>
  void drop_earlier(std::map<Key, Item> &items) const
  {
    for (auto item = items.begin(); item != items.end();)
      item = step_of(item->second) < n_steps ? items.erase(item) : std::next(item);
  }

  /// Loads belong to a step. With OP = NEW those of earlier steps end.
  void begin_loads(const Keyword &keyword)
  {
    require_step(keyword);
    if (!is_new(keyword))
      return;
    if (keyword.name == "CLOAD")
      return drop_earlier(current().point_forces);
    for (auto *loads : {&current().pressures, &current().tractions})
      erase_if(*loads, [&](const auto &load) {
        return load.step < n_steps && load.keyword == keyword.name;
      });
    if (keyword.name == "DLOAD")
      drop_earlier(current().gravities);
  }

  /// Add a load of faces. Loads of the same faces in one step are added, and replace those of
  /// earlier steps.
  void add(const Keyword                    &keyword,
           std::vector<DeckModel::FaceLoad> &loads,
           const std::string                &set,
           std::vector<double>               components,
           const unsigned long               line)
  {
    for (auto &component : components)
      component *= factor(keyword);
    const auto is_replaced = [&](const auto &load) {
      return load.step < n_steps && load.keyword == keyword.name &&
             reading.bodies.have_same_faces(load.set, set);
    };
    erase_if(loads, is_replaced);
    for (const auto &load : loads)
      if (load.step < n_steps && load.keyword == keyword.name &&
          reading.bodies.have_common_faces(load.set, set))
        reading.lacks(keyword, " that changes a part of the faces of an earlier step", line);
    loads.push_back({set, components, keyword.name, line, n_steps});
  }

  void read_gravity(const Keyword &keyword, const Words &words, const unsigned long line)
  {
    DeckModel::Gravity gravity{{}, vector_from(numbers_from(words, 2, line)), line, n_steps};
    for (auto &component : gravity.acceleration)
      component *= factor(keyword);
    for (unsigned int e = 0; e < reading.deck.mesh.elements.size() && words[0].empty(); ++e)
      gravity.elements.insert(e);
    if (!words[0].empty())
      for (const unsigned int e : sets.elements(words[0], "", keyword.title, line))
        gravity.elements.insert(e);
    auto &all = current().gravities;
    erase_if(all, [&](const auto &other) {
      return other.step < n_steps && other.elements == gravity.elements;
    });
    all.push_back(gravity);
  }

  /// Return a vector of dim components from {magnitude, direction}.
  std::vector<double> vector_from(std::vector<double> numbers) const
  {
    numbers.resize(4, 0.);
    const double        norm = std::hypot(numbers[1], numbers[2], numbers[3]);
    std::vector<double> result;
    for (unsigned int d = 0; d < dim; ++d)
      result.push_back(norm > 0. ? numbers[0] * numbers[1 + d] / norm : 0.);
    return result;
  }

  /// Read a line of *BOUNDARY of reference nodes of rigid bodies. Return whether it is one.
  bool is_motion(const Keyword &keyword, const Words &words, const unsigned long line)
  {
    if (references.empty())
      return false;
    bool has_motion = false;
    for (const unsigned int node : sets.nodes(words[0], "", keyword.title, line))
      if (references.count(node) > 0)
        {
          has_motion = true;
          // ENCASTRE and the like hold all components.
          const bool   is_number = words[1].find_first_not_of("0123456789") == std::string::npos;
          const auto   first     = is_number ? to_whole(words[1], line) : 1;
          const auto   last      = !is_number ? 6
                                   : words.size() > 2 && !words[2].empty() ? to_whole(words[2], line)
                                                                           : first;
          const double value =
            words.size() > 3 && !words[3].empty() ? to_number(words[3], line) : 0.;
          for (auto c = std::max(1ul, first); c <= std::min(6ul, last); ++c)
            current().motions[{node, c - 1}] = {value * factor(keyword), line, n_steps};
        }
    return has_motion;
  }

  /// Return the components, from 0, of a line of *BOUNDARY that a model of solids has.
  std::vector<unsigned int>
  components_of(const Keyword &keyword, const Words &words, const unsigned long line)
  {
    static const std::map<std::string, std::vector<unsigned int>> names = {
      {"ENCASTRE", {0, 1, 2}}, {"PINNED", {0, 1, 2}}, {"XSYMM", {0}},     {"YSYMM", {1}},
      {"ZSYMM", {2}},          {"XASYMM", {1, 2}},    {"YASYMM", {0, 2}}, {"ZASYMM", {0, 1}}};
    const auto                named = names.find(upper_case(words[1]));
    std::vector<unsigned int> components;
    if (named != names.end())
      components = named->second;
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
    // Nodes of solids have no rotations (4 to 6), and nodes of a plane model no third component.
    components.erase(std::remove_if(components.begin(), components.end(),
                                    [&](const auto c) { return c >= dim; }),
                     components.end());
    return components;
  }

  /// Hold the whole faces of a set, and its nodes that are on none of them.
  void hold(const Keyword                   &keyword,
            const std::string               &set,
            const std::vector<unsigned int> &components,
            const DeckModel::Given          &given)
  {
    auto      &step  = current();
    const auto nodes = reading.bodies.nodes_without_face(set);
    if (set.find_first_of(",:;=#\\+") != std::string::npos || reading.bodies.use(set))
      {
        if (!reading.use(keyword, set, given.line))
          return;
        const auto &of_set = reading.deck.mesh.optional_boundaries.at(set).nodes;
        for (const unsigned int c : components)
          if (const auto axis = axes.axis(of_set, c); axis && axis->first < dim)
            step.prescribed.push_back(
              {set, axis->first, axis->second * given.value, given.line, n_steps});
          else if (given.value == 0. && components.size() == dim)
            step.prescribed.push_back({set, c, 0., given.line, n_steps});
          else if (given.value == 0. && is_normal(set, c))
            step.prescribed.push_back({set, 3, 0., given.line, n_steps});
          else
            reading.lacks(keyword,
                          " along axes of *TRANSFORM that are neither coordinate axes nor "
                          "normals of the faces",
                          given.line);
      }
    for (const unsigned int node : nodes)
      for (const unsigned int c : components)
        if (const auto axis = axes.axis({node}, c); axis && axis->first < dim)
          step.held_nodes[{node, axis->first}] = {axis->second * given.value, given.line, n_steps};
        else if (given.value == 0. && components.size() == dim)
          step.held_nodes[{node, c}] = given;
        else
          reading.lacks(keyword, " of nodes along axes of *TRANSFORM that are no coordinate axes",
                        given.line);
    if (!nodes.empty())
      reading.remarks.replaced("point supports for nodes of " + title_of(keyword) +
                                 " that are not those of whole faces; stresses there depend on the "
                                 "mesh",
                               given.line);
    else if (!reading.bodies.use(set))
      reading.remarks.not_needed(title_of(keyword) + " of nodes that belong to no cell",
                                 given.line);
  }

  bool is_normal(const std::string &set, const unsigned int component) const
  {
    const auto faces = reading.bodies.faces_of(set);
    return std::all_of(faces.begin(), faces.end(),
                       [&](const auto &corners) { return axes.is_normal(corners, component); });
  }
};
} // namespace

KeywordReadings load_readings(Reading &reading)
{
  const auto reader = std::make_shared<LoadReader>(reading);
  using M           = LoadReader;
  const auto by     = [reader](void (M::*read)(const Keyword &)) {
    return [reader, read](const Keyword &keyword) { (reader.get()->*read)(keyword); };
  };
  const std::set<std::string> load     = {"OP", "AMPLITUDE"};
  const std::set<std::string> controls = {"INC", "INCF", "AMPLITUDE", "UNSYMM", "SOLVER"};
  return {{"STEP", {by(&M::begin_step), {{"NAME", "NLGEOM"}, controls}}},
          {"ENDSTEP", {by(&M::end_step), {}, false}},
          {"STATIC",
           {by(&M::read_static),
            {{},
             {"DIRECT", "SOLVER", "STABILIZE", "ALLSDTOL", "CONTINUE", "FACTOR", "TIMERESET"}}}},
          {"BOUNDARY", {by(&M::read_boundary), {load, {}}}},
          {"DSLOAD", {by(&M::read_surface_load), {load, {"CONSTANTRESULTANT", "FOLLOWER"}}}},
          {"DLOAD", {by(&M::read_element_load), {load, {}}}},
          {"CLOAD", {by(&M::read_point_load), {load, {}}}},
          {"TEMPERATURE", {by(&M::read_temperature), {load, {}}}},
          {"INITIALCONDITIONS", {by(&M::read_temperature), {{"TYPE"}, {}}}}};
}
} // namespace snug::deck
