#include <snug/base/values.h>

#include <algorithm>
#include <cmath>

namespace snug::deck {
namespace {
using Step  = DeckModel::Step;
using Lines = std::vector<unsigned long>;
/// Component -> what a line of a deck prescribes
using Held = std::map<unsigned int, const DeckModel::PrescribedComponent *>;

/// Number of forces of nodes up to which they are meant as forces at points, and not on faces.
const std::size_t most_local_forces = 20;

/// This class collects the entries.
class Collector
{
public:
  Collector(const DeckModel &model, const DeckBodies &bodies, Remarks &remarks)
    : model(model), bodies(bodies), remarks(remarks)
  {
    if (model.steps.empty())
      steps.push_back(&model.initial);
    for (const auto &step : model.steps)
      steps.push_back(&step);
    result.of_bodies.resize(bodies.all().size());
  }

  SceneLoads collect()
  {
    const bool is_one = steps.size() == 1;
    for (unsigned int s = 0; s < steps.size() && !is_one; ++s)
      result.cases.push_back({case_name(s), s > 0 && (has_friction() || !model.bolts.empty()), {}});
    for (unsigned int b = 0; b < bodies.all().size(); ++b)
      {
        add_supports(b);
        add_held_nodes(b);
        add_springs(b);
      }
    add_reference_points(model, bodies, steps, remarks, result);
    for (const auto &bolt : model.bolts)
      add_bolt(bolt);
    for (unsigned int s = 0; s < steps.size(); ++s)
      {
        std::vector<Entry> of_case;
        for (unsigned int b = 0; b < bodies.all().size(); ++b)
          add_loads(*steps[s], b, is_one ? result.of_bodies[b] : of_case);
        require_places(*steps[s]);
        const auto gravity = gravity_of(*steps[s]);
        if (is_one)
          result.gravity = gravity;
        else
          {
            of_case.push_back({"Gravity", gravity});
            auto &entries = result.cases[s].entries;
            entries.insert(entries.end(), of_case.begin(), of_case.end());
          }
      }
    return std::move(result);
  }

private:
  const DeckModel          &model;
  const DeckBodies         &bodies;
  Remarks                  &remarks;
  std::vector<const Step *> steps;
  SceneLoads                result;

  bool has_friction() const
  {
    return std::any_of(model.contacts.begin(), model.contacts.end(),
                       [&](const auto &contact) { return model.friction(contact) > 0.; });
  }

  std::string case_name(const unsigned int s) const
  {
    std::string name = steps[s]->name.empty() ? "step-" + std::to_string(s + 1) : steps[s]->name;
    for (char &c : name)
      if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_')
        c = '-';
    for (unsigned int other = 0; other < s; ++other)
      if (result.cases[other].name == name)
        name += "-" + std::to_string(s + 1);
    return name;
  }

  /// Return a boundary as entries name it: "boundary" in bodies, "body.boundary" in load cases.
  std::string full_name(const unsigned int b, const std::string &boundary) const
  {
    return (steps.size() == 1 ? "" : bodies.all()[b].name + ".") + boundary;
  }

  static std::string component_name(const unsigned int c)
  {
    const char *const names[] = {"x", "y", "z", "normal", "radial", "tangential", "axial"};
    return names[c];
  }

  /// Return what a step prescribes on the boundaries of a body. Of several values the last one
  /// counts.
  std::map<std::string, Held> held_by(const Step &step, const unsigned int b) const
  {
    std::map<std::string, Held> held;
    for (const auto &given : step.prescribed)
      for (const auto &boundary : bodies.boundaries(b, bodies.faces_on(b, given.set)))
        held[boundary][given.component] = &given;
    return held;
  }

  /// Add supports, and prescribed displacements of the steps.
  void add_supports(const unsigned int b)
  {
    std::vector<std::map<std::string, Held>> held;
    std::map<std::string, Held>              all;
    for (const auto *step : steps)
      {
        held.push_back(held_by(*step, b));
        for (const auto &[boundary, components] : held.back())
          all[boundary].insert(components.begin(), components.end());
      }
    Entry supports{"Supports"};
    for (const auto &[boundary, components] : all)
      {
        std::string text;
        for (const auto &[c, given] : components)
          {
            bool is_zero = true;
            for (unsigned int s = 0; s < steps.size(); ++s)
              {
                const auto &of   = held[s][boundary];
                const auto  here = of.find(c);
                if (here == of.end())
                  {
                    remarks.lacks("step", "*BOUNDARY that holds in some steps only", given->line);
                    continue;
                  }
                if (here->second->value == 0.)
                  continue;
                is_zero = false;
                add_item(steps.size() == 1 ? result.of_bodies[b] : result.cases[s].entries,
                         "Displacement",
                         full_name(b, boundary) + ": " + component_name(c) + " = " +
                           to_text(here->second->value),
                         {here->second->line});
              }
            if (!is_zero)
              continue;
            text += (c >= 3 && !text.empty() ? " " : "") + component_name(c);
            supports.add_line(given->line);
          }
        if (!text.empty())
          supports.add(boundary + ": " + text);
      }
    result.of_bodies[b].insert(result.of_bodies[b].begin(), supports);
    if (const auto of = model.cylinders.find(b); of != model.cylinders.end())
      for (const auto &[name, v] : {std::pair("Axis", of->second.b - of->second.a),
                                    std::pair("Axis point", of->second.a - dealii::Point<3>())})
        result.of_bodies[b].push_back(
          {name, to_text(std::vector{v[0], v[1], v[2]}, ' '), {of->second.line}});
  }

  /// Add the supports of nodes, which must be the same in all steps.
  void add_held_nodes(const unsigned int b)
  {
    Entry entry{"Point supports"};
    for (const auto &[place, given] : steps.front()->held_nodes)
      if (const auto boundary = bodies.boundary_at(b, place.first))
        {
          entry.add(*boundary + ": " + component_name(place.second) +
                    (given.value == 0. ? "" : " = " + to_text(given.value)) + " at " +
                    to_text(bodies.position(place.first), ' '));
          entry.add_line(given.line);
        }
    result.of_bodies[b].push_back(entry);
    for (const auto *step : steps)
      for (const auto &[place, given] : step->held_nodes)
        {
          const auto first = steps.front()->held_nodes.find(place);
          if (b == 0 &&
              (first == steps.front()->held_nodes.end() || first->second.value != given.value ||
               step->held_nodes.size() != steps.front()->held_nodes.size()))
            remarks.lacks("step", "*BOUNDARY of nodes that changes from step to step", given.line);
        }
  }

  void add_springs(const unsigned int b)
  {
    Entry entry{"Point springs"};
    for (const auto &spring : model.springs)
      if (const auto boundary = bodies.boundary_at(b, spring.node))
        {
          std::vector<double> stiffness(bodies.dimension(), 0.);
          stiffness[spring.component] = spring.stiffness;
          entry.add(*boundary + ": " + to_text(stiffness, ' ') + " at " +
                    to_text(bodies.position(spring.node), ' '));
          entry.add_line(spring.line);
        }
    result.of_bodies[b].push_back(entry);
    for (const auto &spring : model.springs)
      if (b == 0 && !bodies.body_at(spring.node))
        remarks.lacks("spring", "*SPRING of nodes on no boundary of a body", spring.line);
  }

  /// Add what tightens a bolt. A node without force and displacement is the preload 0.
  void add_bolt(const DeckModel::Bolt &bolt)
  {
    const bool is_one = steps.size() == 1;
    auto      &own    = result.of_bolts.emplace_back();
    for (unsigned int s = 0; s < steps.size(); ++s)
      {
        const auto held    = steps[s]->motions.find({bolt.node, 0});
        const auto loads   = steps[s]->reference_loads.find({bolt.node, 0});
        const bool is_held = held != steps[s]->motions.end();
        double     value   = is_held ? held->second.value : 0.;
        Lines      lines   = {is_held ? held->second.line : bolt.line};
        if (!is_held && loads != steps[s]->reference_loads.end())
          for (const auto &given : loads->second)
            {
              value += given.value;
              lines = {given.line};
            }
        else if (!is_held)
          remarks.replaced("the preload 0 for a step without force and displacement of the NODE of "
                           "*PRE-TENSION SECTION",
                           bolt.line);
        if (s == 0 || !is_held || !held->second.is_fixed)
          add_item(is_one ? own : result.cases[s].entries, is_held ? "Shortening" : "Preload",
                   (is_one ? "" : bolt.name + ": ") + to_text(bolt.sign * value + 0.), lines);
      }
  }

  void add_loads(const Step &step, const unsigned int b, std::vector<Entry> &entries)
  {
    add_faces(b, "Pressure", step.pressures, entries);
    add_faces(b, "Traction", step.tractions, entries);
    add_point_forces(step, b, entries);
    if (const auto temperature = temperature_of(step, b); temperature && *temperature != 0.)
      add_item(entries, "Temperature",
               (steps.size() == 1 ? "" : bodies.all()[b].name + ": ") + to_text(*temperature),
               {step.temperatures.begin()->second.line});
  }

  /// Add pressures or tractions. Several ones on a boundary are added.
  void add_faces(const unsigned int                      b,
                 const std::string                      &name,
                 const std::vector<DeckModel::FaceLoad> &loads,
                 std::vector<Entry>                     &entries) const
  {
    std::map<std::string, std::vector<double>> sums;
    std::map<std::string, Lines>               lines;
    for (const auto &load : loads)
      for (const auto &boundary : bodies.boundaries(b, bodies.faces_on(b, load.set)))
        {
          auto &sum =
            sums.emplace(boundary, std::vector<double>(load.components.size(), 0.)).first->second;
          for (std::size_t i = 0; i < sum.size(); ++i)
            sum[i] += load.components[i];
          lines[boundary].push_back(load.line);
        }
    for (const auto &[boundary, sum] : sums)
      add_item(entries, name, full_name(b, boundary) + ": " + to_text(sum, ' '), lines[boundary]);
  }

  void add_point_forces(const Step &step, const unsigned int b, std::vector<Entry> &entries) const
  {
    std::map<unsigned int, std::vector<double>> forces; // by node
    std::map<unsigned int, Lines>               lines;
    for (const auto &[place, sum] : step.point_forces)
      if (bodies.body_at(place.first) == b)
        for (const auto &given : sum)
          {
            auto &force = forces[place.first];
            force.resize(bodies.dimension(), 0.);
            force[place.second] += given.value;
            lines[place.first].push_back(given.line);
          }
    for (const auto &[node, force] : forces)
      add_item(entries, "Point force",
               full_name(b, *bodies.boundary_at(b, node)) + ": " + to_text(force, ' ') + " at " +
                 to_text(bodies.position(node), ' '),
               lines[node]);
  }

  /// Note forces that have no place on a body.
  void require_places(const Step &step)
  {
    // Consistent forces of faces of elements without inner nodes are not those of Snug's elements.
    if (model.degree == 2 && step.point_forces.size() > most_local_forces)
      remarks.replaced(
        "point forces on elements of degree 2 with nodes inside of faces instead of "
        "*CLOAD of many nodes, near which displacements and stresses differ; *DSLOAD "
        "states loads of faces",
        step.point_forces.begin()->second.front().line);
    for (const auto &[place, sum] : step.point_forces)
      if (!bodies.body_at(place.first))
        for (const auto &given : sum)
          remarks.lacks("cload", "*CLOAD of nodes on no boundary of a body", given.line);
  }

  /// Return the temperature of a body above its initial one, or nothing where it is not uniform or
  /// causes no strain.
  std::optional<double> temperature_of(const Step &step, const unsigned int b)
  {
    if (step.temperatures.empty())
      return {};
    std::optional<double> least, largest;
    bool                  expands = false;
    for (const unsigned int e : bodies.all()[b].elements)
      {
        for (const auto &material : model.materials)
          expands = expands || (material.expansion != 0. &&
                                mesh_file::upper_case(material.name) == model.material_of.at(e));
        for (const unsigned int node : bodies.corners_of(e))
          {
            const auto   now     = step.temperatures.find(node);
            const auto   before  = model.initial_temperatures.find(node);
            const double initial = before == model.initial_temperatures.end() ? 0. : before->second;
            const double rise = now == step.temperatures.end() ? 0. : now->second.value - initial;
            least             = std::min(rise, least.value_or(rise));
            largest           = std::max(rise, largest.value_or(rise));
          }
      }
    if (!expands)
      return {};
    if (*largest - *least <= 1e-9 * std::max(std::abs(*least), std::abs(*largest)))
      return *largest;
    remarks.lacks("temperature",
                  "*TEMPERATURE that varies within the body '" + bodies.all()[b].name + "'",
                  step.temperatures.begin()->second.line);
    return {};
  }

  void require_density(const std::vector<unsigned int> &cells, const unsigned long line) const
  {
    for (const auto &material : model.materials)
      for (const unsigned int e : cells)
        if (material.density == 0. &&
            mesh_file::upper_case(material.name) == model.material_of.at(e))
          throw mesh_file::error_at_line(line, "gravity needs the *DENSITY of *MATERIAL '" +
                                                 material.name + "'");
  }

  /// Return the acceleration of a step if it is equal in all bodies.
  std::string gravity_of(const Step &step)
  {
    std::vector<std::vector<double>> of_bodies(bodies.all().size(),
                                               std::vector<double>(bodies.dimension(), 0.));
    for (const auto &gravity : step.gravities)
      for (unsigned int b = 0; b < of_bodies.size(); ++b)
        {
          const auto &cells = bodies.all()[b].elements;
          const auto  n     = std::count_if(cells.begin(), cells.end(),
                                            [&](const auto e) { return gravity.elements.count(e) > 0; });
          if (n > 0 && n < static_cast<long>(cells.size()))
            remarks.lacks("dload", "*DLOAD: gravity of a part of a body", gravity.line);
          else if (n > 0)
            require_density(cells, gravity.line);
          if (n == static_cast<long>(cells.size()))
            for (unsigned int d = 0; d < bodies.dimension(); ++d)
              of_bodies[b][d] += gravity.acceleration[d];
        }
    const bool is_equal = std::all_of(of_bodies.begin(), of_bodies.end(),
                                      [&](const auto &other) { return other == of_bodies[0]; });
    for (const auto &gravity : step.gravities)
      if (!is_equal)
        remarks.lacks("dload", "*DLOAD: gravity that differs between bodies", gravity.line);
    return is_equal && !step.gravities.empty() ? to_text(of_bodies[0], ' ') : "";
  }
};
} // namespace

SceneLoads scene_loads(const DeckModel &model, const DeckBodies &bodies, Remarks &remarks)
{
  return Collector(model, bodies, remarks).collect();
}
} // namespace snug::deck
