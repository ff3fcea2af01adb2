#include <snug/deck/keyword_reader.h>
#include <snug/deck/step_items.h>

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
/// This class reads the steps and their loads.
class LoadReader
{
public:
  explicit LoadReader(Reading &reading)
    : reading(reading), sets(reading.deck.sets), dim(reading.bodies.dimension())
  {}

  void begin_step(const Keyword &keyword)
  {
    if (reading.in_step)
      throw keyword_error(keyword, "*STEP within a step; *END STEP is missing");
    if (keyword.has("NLGEOM") && upper_case(keyword.option("NLGEOM")) != "NO")
      reading.remarks.replaced("small displacements instead of NLGEOM", keyword.line);
    reading.in_step = true;
    ++reading.n_steps;
    auto &steps = reading.model.steps;
    steps.push_back(steps.empty() ? reading.model.initial : steps.back());
    steps.back().name = keyword.option("NAME");
    steps.back().line = keyword.line;
  }

  void end_step(const Keyword &keyword)
  {
    if (!reading.in_step)
      throw keyword_error(keyword, "*END STEP without *STEP");
    reading.in_step = false;
  }

  void read_static(const Keyword &keyword) { require_step(keyword); }

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
        add(keyword, reading.current().pressures, set, {numbers[0]}, line);
      else
        add(keyword, reading.current().tractions, set, vector_from(numbers), line);
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
        return read_gravity(keyword, words, line);
      if (type.size() != 2 || type[0] != 'P' || listed == sets.of_lines.end())
        return reading.lacks(keyword, " of type '" + type + "'", line);
      for (const auto &set : listed->second)
        if (known.insert(set).second && reading.use(keyword, set, line))
          add(keyword, reading.current().pressures, set, {to_number(words[2], line)}, line);
    });
  }

  /// Read a line "node or set, component, force".
  void read_point_load(const Keyword &keyword)
  {
    begin_loads(keyword);
    reading.text.for_each_line(keyword, [&](const Words &words, const unsigned long line) {
      if (words.size() < 3)
        throw error_at_line(line, "a node or set, a component and a force are expected");
      auto         nodes     = sets.nodes(words[0], "", keyword.title, line);
      const auto   component = to_whole(words[1], line);
      const double force     = to_number(words[2], line) * reading.factor(keyword);
      erase_if(nodes, [&](const unsigned int node) {
        if (sets.copies.count(node) > 0)
          return true;
        const auto found = reading.references.find({node, component - 1});
        if (found == reading.references.end())
          return false;
        add(reading.current().reference_loads[found->second], {force, line, reading.n_steps});
        return true;
      });
      if (nodes.empty())
        return;
      if (component < 1 || component > dim)
        return reading.lacks(keyword, " of component " + words[1], line);
      if (component == 1 && reading.model.model == "axisymmetric")
        return reading.lacks(keyword, " along the radius of an axisymmetric model", line);
      for (const unsigned int node : nodes)
        {
          const auto direction = reading.axes.direction(node, component - 1);
          for (unsigned int c = 0; c < dim; ++c)
            if (direction[c] != 0.)
              add(reading.current().point_forces[{node, c}],
                  {force * direction[c], line, reading.n_steps});
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
      drop_earlier(reading.current().temperatures, reading.n_steps);
    reading.text.for_each_line(keyword, [&](const Words &words, const unsigned long line) {
      if (words.size() < 2)
        throw error_at_line(line, "a node or set and a temperature are expected");
      const double value = to_number(words[1], line) * reading.factor(keyword);
      for (const unsigned int node : sets.nodes(words[0], "", keyword.title, line))
        if (is_initial)
          reading.model.initial_temperatures[node] = value;
        else
          reading.current().temperatures[node] = {value, line, reading.n_steps};
    });
  }

private:
  Reading                   &reading;
  const mesh_file::DeckSets &sets;
  const unsigned int         dim;

  void require_step(const Keyword &keyword) const
  {
    if (!reading.in_step)
      throw keyword_error(keyword, keyword.title + " must stand in a step");
  }

  /// Loads belong to a step. With OP = NEW those of earlier steps end, and *DLOAD and *DSLOAD are
  /// one kind, as in CalculiX.
  void begin_loads(const Keyword &keyword)
  {
    require_step(keyword);
    if (!is_new(keyword))
      return;
    if (keyword.name == "CLOAD")
      {
        drop_earlier(reading.current().reference_loads, reading.n_steps);
        return drop_earlier(reading.current().point_forces, reading.n_steps);
      }
    drop_earlier(reading.current().pressures, reading.n_steps);
    drop_earlier(reading.current().tractions, reading.n_steps);
    drop_earlier(reading.current().gravities, reading.n_steps);
  }

  /// Add a force to those of its step, which replace those of earlier steps.
  static void add(std::vector<DeckModel::Given> &sum, const DeckModel::Given &force)
  {
    if (!sum.empty() && step_of(sum) < force.step)
      sum.clear();
    sum.push_back(force);
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
      component *= reading.factor(keyword);
    const auto is_replaced = [&](const auto &load) {
      return load.step < reading.n_steps && reading.bodies.have_same_faces(load.set, set);
    };
    erase_if(loads, is_replaced);
    for (const auto &load : loads)
      if (load.step < reading.n_steps && reading.bodies.have_common_faces(load.set, set))
        reading.lacks(keyword, " that changes a part of the faces of an earlier step", line);
    loads.push_back({set, components, line, reading.n_steps});
  }

  void read_gravity(const Keyword &keyword, const Words &words, const unsigned long line)
  {
    DeckModel::Gravity gravity{{},
                               vector_from(numbers_from(words, 2, line)),
                               line,
                               reading.n_steps};
    for (auto &component : gravity.acceleration)
      component *= reading.factor(keyword);
    const auto &before = reading.current().gravities;
    if (std::any_of(before.begin(), before.end(), [&](const auto &other) {
          return other.step < reading.n_steps &&
                 !is_parallel(other.acceleration, gravity.acceleration);
        }))
      reading.lacks(
        keyword,
        " GRAV of a later step along another direction, which Abaqus replaces and CalculiX adds",
        line);
    for (unsigned int e = 0; e < reading.deck.mesh.elements.size() && words[0].empty(); ++e)
      gravity.elements.insert(e);
    if (!words[0].empty())
      for (const unsigned int e : sets.elements(words[0], "", keyword.title, line))
        gravity.elements.insert(e);
    auto &all = reading.current().gravities;
    erase_if(all, [&](const auto &other) {
      return other.step < reading.n_steps && other.elements == gravity.elements;
    });
    all.push_back(gravity);
  }

  static bool is_parallel(const std::vector<double> &a, const std::vector<double> &b)
  {
    double product = 0., of_a = 0., of_b = 0.;
    for (std::size_t d = 0; d < a.size(); ++d)
      {
        product += a[d] * b[d];
        of_a += a[d] * a[d];
        of_b += b[d] * b[d];
      }
    return product * product >= (1. - 1e-9) * of_a * of_b;
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
          {"DSLOAD", {by(&M::read_surface_load), {load, {"CONSTANTRESULTANT", "FOLLOWER"}}}},
          {"DLOAD", {by(&M::read_element_load), {load, {}}}},
          {"CLOAD", {by(&M::read_point_load), {load, {}}}},
          {"TEMPERATURE", {by(&M::read_temperature), {load, {}}}},
          {"INITIALCONDITIONS", {by(&M::read_temperature), {{"TYPE"}, {}}}}};
}
} // namespace snug::deck
