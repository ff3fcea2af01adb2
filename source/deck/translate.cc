#include <snug/base/values.h>
#include <snug/deck/scene_loads.h>
#include <snug/deck/translation.h>

#include <algorithm>
#include <sstream>

namespace snug::deck {
namespace {
using mesh_file::error_at_line;
using mesh_file::upper_case;

/// This class writes a model of a deck as a parameter file.
class Writer
{
public:
  Writer(const DeckModel   &model,
         const DeckBodies  &bodies,
         const std::string &file,
         const SceneLoads  &loads)
    : model(model), bodies(bodies), file(file), loads(loads)
  {}

  std::string parameters()
  {
    collect_materials();
    write("set Dimension = " + to_text(bodies.dimension()));
    if (bodies.dimension() == 2)
      write("set Model = " + model.model);
    if (model.thickness && bodies.dimension() == 2)
      write("set Thickness = " + to_text(*model.thickness));
    if (model.degree == 2)
      write("set Element degree = 2");
    if (!model.units.empty())
      write("set Units = " + model.units);
    std::vector<std::string> names;
    for (const auto &body : bodies.all())
      names.push_back(body.name);
    write("set Bodies = " + to_text(names));
    names.clear();
    for (const auto *material : used)
      names.push_back(name_of(*material));
    write("set Materials = " + to_text(names));
    if (!loads.gravity.empty())
      write("set Gravity = " + loads.gravity);
    write_case_names();
    names.clear();
    for (const auto &obstacle : model.obstacles)
      names.push_back(obstacle.name);
    if (!names.empty())
      write("set Obstacles = " + to_text(names));
    names.clear();
    for (const auto &point : loads.points)
      names.push_back(point.first);
    if (!names.empty())
      write("set Reference points = " + to_text(names));
    names.clear();
    for (const auto &bolt : model.bolts)
      names.push_back(bolt.name);
    if (!names.empty())
      write("set Bolts = " + to_text(names));
    for (const auto *material : used)
      write_material(*material);
    for (unsigned int b = 0; b < bodies.all().size(); ++b)
      write_body(b);
    write_obstacles();
    for (const auto &[name, entries] : loads.points)
      {
        write("\nsubsection Reference point " + name);
        for (const auto &entry : entries)
          write_entry(entry);
        write("end");
      }
    write_contacts();
    for (std::size_t i = 0; i < model.bolts.size(); ++i)
      {
        write("\nsubsection Bolt " + model.bolts[i].name);
        write_entry({"Pair", sides(model.bolts[i].cut), {model.bolts[i].line}});
        for (const auto &entry : loads.of_bolts[i])
          write_entry(entry);
        write("end");
      }
    write_cases();
    return out.str();
  }

private:
  const DeckModel                         &model;
  const DeckBodies                        &bodies;
  const std::string                       &file;
  const SceneLoads                        &loads;
  std::ostringstream                       out;
  std::vector<const DeckModel::Material *> used; ///< materials of cells

  void write(const std::string &line) { out << line << '\n'; }

  void write_entry(const Entry &entry) { deck::write(out, entry); }

  /// Return the name of a material without the characters that separate items in lists.
  static std::string name_of(const DeckModel::Material &material)
  {
    std::string name = material.name;
    for (char &c : name)
      if (std::string(",:;=#\\/").find(c) != std::string::npos)
        c = '-';
    return name;
  }

  /// Collect the materials of cells.
  void collect_materials()
  {
    std::set<std::string> names;
    for (const auto &of_element : model.material_of)
      names.insert(of_element.second);
    for (const auto &name : names)
      for (const auto &material : model.materials)
        if (upper_case(material.name) == name)
          used.push_back(&material);
  }

  void write_material(const DeckModel::Material &material)
  {
    write("\nsubsection Material " + name_of(material));
    write_entry({"Young's modulus", to_text(*material.youngs_modulus), {material.line}});
    write_entry({"Poisson's ratio", to_text(*material.poissons_ratio)});
    if (material.density > 0.)
      write_entry({"Density", to_text(material.density)});
    if (material.expansion != 0.)
      write_entry({"Expansion", to_text(material.expansion)});
    if (material.yield_stress > 0.)
      write_entry({"Yield stress", to_text(material.yield_stress)});
    write("end");
  }

  void write_body(const unsigned int b)
  {
    const auto &body = bodies.all()[b];
    write("\nsubsection Body " + body.name);
    write_entry({"Mesh", "file"});
    write_entry({"File", file});
    write_entry({"Mesh regions", body.group});
    for (const auto &[set, same] : body.alias)
      if (set != same)
        write("  # '" + set + "' has the faces of '" + same + "'");
    write_entry({"Boundary sets", to_text(body.sets)});
    TextMap names;
    for (const auto &set : body.sets)
      if (bodies.boundary_name(b, set) != set)
        names[set] = bodies.boundary_name(b, set);
    write_entry({"Boundary names", to_text(names)});
    write_entry(materials_of(body));
    for (const auto &entry : loads.of_bodies[b])
      write_entry(entry);
    write("end");
  }

  Entry materials_of(const DeckBodies::Body &body) const
  {
    TextMap               of_regions;
    std::set<std::string> names;
    for (const unsigned int e : body.elements)
      {
        const auto &of = model.material_of.at(e);
        for (const auto *material : used)
          if (upper_case(material->name) == of)
            {
              of_regions[model.region_of.at(e)] = name_of(*material);
              names.insert(name_of(*material));
            }
      }
    return {"Materials", names.size() == 1 ? *names.begin() : to_text(of_regions)};
  }

  void write_case_names()
  {
    std::vector<std::string> names;
    for (const auto &load_case : loads.cases)
      names.push_back(load_case.name);
    if (!names.empty())
      write("set Load cases = " + to_text(names));
  }

  void write_cases()
  {
    for (const auto &load_case : loads.cases)
      {
        write("\nsubsection Load case " + load_case.name);
        if (load_case.is_load_step)
          write("  set Load step = true");
        for (const auto &entry : load_case.entries)
          write_entry(entry);
        write("end");
      }
  }

  void write_obstacles()
  {
    for (unsigned int i = 0; i < model.obstacles.size(); ++i)
      {
        const auto &obstacle = model.obstacles[i];
        write("\nsubsection Obstacle " + obstacle.name);
        write_entry({"Shape", obstacle.shape});
        write_entry({"Point", to_text(obstacle.point, ' ')});
        write_entry(
          {obstacle.shape == "plane" ? "Normal" : "Axis", to_text(obstacle.direction, ' ')});
        if (obstacle.shape != "plane")
          write_entry({"Radius", to_text(obstacle.radius)});
        write_entry(loads.of_obstacles[i]);
        write("end");
      }
  }

  /// Return the side of a contact: "body.a + body.a and b".
  std::string side(const unsigned int b, const std::set<unsigned int> &faces) const
  {
    Entry boundaries{""};
    for (const auto &boundary : bodies.boundaries(b, faces))
      boundaries.add(bodies.all()[b].name + "." + boundary, " + ");
    return boundaries.value;
  }

  /// Return the pair of a contact: "punch.bottom: base.top".
  std::string sides(const DeckModel::Contact &of) const
  {
    if (of.obstacle)
      return side(of.slave_body, bodies.faces_on(of.slave_body, of.slave)) + ": " +
             model.obstacles[*of.obstacle].name;
    return side(of.slave_body, bodies.faces_on(of.slave_body, of.slave)) + ": " +
           side(of.master_body, bodies.faces_on(of.master_body, of.master));
  }

  /// Return whether faces of the slave side follow a reference point.
  bool has_rigid_slave(const DeckModel::Contact &contact) const
  {
    return std::any_of(model.rigid_bodies.begin(), model.rigid_bodies.end(), [&](const auto &of) {
      return !of.is_distributing && bodies.have_common_faces(of.set, contact.slave) &&
             std::count(of.bodies.begin(), of.bodies.end(), contact.slave_body) > 0;
    });
  }

  void write_contacts()
  {
    if (model.contacts.empty())
      return;
    Entry pairs{"Pairs"};
    for (const auto &contact : model.contacts)
      {
        pairs.add(sides(contact));
        pairs.add_line(contact.line);
      }
    write("\nsubsection Contact");
    write_entry(pairs);
    write("end");
    for (const auto &contact : model.contacts)
      {
        write("\nsubsection Pair " + sides(contact));
        if (contact.is_tied)
          write_entry({"Law", "tied"});
        if (contact.reach > 0.)
          write_entry({"Search distance", to_text(contact.reach)});
        if (!contact.is_general && !contact.obstacle && !has_rigid_slave(contact))
          write_entry({"Slave", "first"});
        if (contact.gap != 0.)
          write_entry({"Gap", to_text(contact.gap)});
        if (const double friction = model.friction(contact); friction > 0.)
          {
            write_entry({"Friction", "Coulomb"});
            write_entry({"Friction coefficient", to_text(friction)});
          }
        write("end");
      }
  }
};
} // namespace

bool is_deck(const std::string &text)
{
  const auto begin = text.find_first_not_of(" \t\r\n");
  return begin != std::string::npos && text[begin] == '*';
}

Translation translate(const std::string &text, const std::string &file)
{
  const auto  deck = mesh_file::read_deck(text);
  DeckBodies  bodies(deck);
  Remarks     remarks;
  const auto  model      = read_model(mesh_file::DeckText(text), deck, bodies, remarks);
  const auto  loads      = scene_loads(model, bodies, remarks);
  const auto  parameters = Writer(model, bodies, file, loads).parameters();
  Translation result{"", remarks.not_needed(), remarks.replaced(), remarks.lacking()};
  result.text = "# Translation of " + file + " by 'snug --translate'.\n";
  if (!result.lacking.empty())
    result.text += "# These parts of the model are not in this file:\n";
  for (const auto &part : result.lacking)
    result.text += "#   " + part.text + '\n';
  if (!result.replaced.empty())
    result.text += "# This file has, instead of the deck:\n";
  for (const auto &line : result.replaced)
    result.text += "#   " + line + '\n';
  if (!result.not_needed.empty())
    result.text += "# Not needed: " + result.not_needed + '\n';
  result.text += '\n' + parameters;
  return result;
}
} // namespace snug::deck
