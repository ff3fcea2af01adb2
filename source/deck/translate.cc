#include <snug/base/values.h>
#include <snug/deck/deck_model.h>
#include <snug/deck/translation.h>

#include <algorithm>
#include <sstream>

namespace snug::deck {
namespace {
/// Maximum number of nodes with forces of a deck. Loads of more nodes are those of faces.
const std::size_t most_point_forces = 20;

using mesh_file::error_at_line;
using mesh_file::upper_case;

/// Entry of a parameter file, with the lines of the deck from which it comes.
struct Entry
{
  std::string                name, value = {};
  std::vector<unsigned long> lines = {};

  void add(const std::string &item, const std::string &separator = ", ")
  {
    value += (value.empty() ? "" : separator) + item;
  }

  void add_line(const unsigned long line)
  {
    if (std::find(lines.begin(), lines.end(), line) == lines.end())
      lines.push_back(line);
  }
};

/// This class writes a model of a deck as a parameter file.
class Writer
{
public:
  Writer(const DeckModel   &model,
         const DeckBodies  &bodies,
         const std::string &file,
         LeftOut           &left_out)
    : model(model), bodies(bodies), file(file), left_out(left_out)
  {}

  std::string parameters()
  {
    collect_materials();
    write("set Dimension = " + to_text(bodies.dimension()));
    if (bodies.dimension() == 2)
      write("set Model = " + model.model);
    if (model.thickness && bodies.dimension() == 2)
      write("set Thickness = " + to_text(*model.thickness));
    if (bodies.is_second_order())
      write("set Element degree = 2");
    std::vector<std::string> names;
    for (const auto &body : bodies.all())
      names.push_back(body.name);
    write("set Bodies = " + to_text(names));
    names.clear();
    for (const auto *material : used)
      names.push_back(name_of(*material));
    write("set Materials = " + to_text(names));
    write_gravity();
    place_point_forces();
    for (const auto *material : used)
      write_material(*material);
    for (unsigned int b = 0; b < bodies.all().size(); ++b)
      write_body(b);
    write_contacts();
    return out.str();
  }

private:
  const DeckModel                         &model;
  const DeckBodies                        &bodies;
  const std::string                       &file;
  LeftOut                                 &left_out;
  std::ostringstream                       out;
  std::vector<const DeckModel::Material *> used;         ///< materials of cells
  std::vector<Entry>                       point_forces; ///< per body

  void write(const std::string &line) { out << line << '\n'; }

  void write_entry(const Entry &entry)
  {
    if (entry.value.empty())
      return;
    if (!entry.lines.empty())
      write("  # " + list_of_lines(entry.lines));
    write("  set " + entry.name + " = " + entry.value);
  }

  /// Return the name of a material without the characters that separate items in lists.
  static std::string name_of(const DeckModel::Material &material)
  {
    std::string name = material.name;
    for (char &c : name)
      if (std::string(",:;=#\\/").find(c) != std::string::npos)
        c = '-';
    return name;
  }

  /// Collect the materials of cells. @throws InputError if a cell has none.
  void collect_materials()
  {
    std::set<std::string> names;
    for (const auto &body : bodies.all())
      for (const unsigned int e : body.elements)
        {
          const auto found = model.material_of.find(e);
          if (found == model.material_of.end())
            throw InputError("the cells of '" + body.name +
                             "' have no material; *SOLID SECTION must assign one");
          names.insert(found->second);
        }
    for (const auto &name : names)
      {
        const auto found =
          std::find_if(model.materials.begin(), model.materials.end(),
                       [&](const auto &material) { return upper_case(material.name) == name; });
        if (found == model.materials.end())
          throw InputError("there is no *MATERIAL '" + name + "'");
        if (!found->youngs_modulus)
          throw error_at_line(found->line,
                              "*MATERIAL '" + found->name + "' has no isotropic *ELASTIC");
        used.push_back(&*found);
      }
  }

  void write_material(const DeckModel::Material &material)
  {
    write("\nsubsection Material " + name_of(material));
    write_entry({"Young's modulus", to_text(*material.youngs_modulus), {material.line}});
    write_entry({"Poisson's ratio", to_text(*material.poissons_ratio)});
    if (material.density > 0.)
      write_entry({"Density", to_text(material.density)});
    write("end");
  }

  /// Write the gravity if it is equal in all bodies.
  void write_gravity()
  {
    std::vector<std::vector<double>> of_bodies(bodies.all().size(),
                                               std::vector<double>(bodies.dimension(), 0.));
    for (const auto &gravity : model.gravities)
      for (unsigned int b = 0; b < of_bodies.size(); ++b)
        {
          const auto &cells = bodies.all()[b].elements;
          const auto  n     = std::count_if(cells.begin(), cells.end(),
                                            [&](const auto e) { return gravity.elements.count(e) > 0; });
          if (n > 0 && n < static_cast<long>(cells.size()))
            left_out.add("*DLOAD: gravity of a part of a body", gravity.line);
          else if (n > 0)
            for (unsigned int d = 0; d < bodies.dimension(); ++d)
              of_bodies[b][d] += gravity.acceleration[d];
        }
    const bool is_equal = std::all_of(of_bodies.begin(), of_bodies.end(),
                                      [&](const auto &other) { return other == of_bodies[0]; });
    for (const auto &gravity : model.gravities)
      if (!is_equal)
        left_out.add("*DLOAD: gravity that differs between bodies", gravity.line);
    if (is_equal && !model.gravities.empty())
      write("set Gravity = " + to_text(of_bodies[0], ' '));
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
    write_prescribed(b);
    write_loads(b, {"Pressure"}, model.pressures);
    write_loads(b, {"Traction"}, model.tractions);
    write_entry(point_forces[b]);
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

  /// Write supports and prescribed displacements. Of several values the last one counts.
  void write_prescribed(const unsigned int b)
  {
    std::map<std::string, std::map<unsigned int, const DeckModel::PrescribedComponent *>>
      prescribed;
    for (const auto &component : model.prescribed)
      for (const auto &boundary : bodies.boundaries(b, component.set))
        prescribed[boundary][component.component] = &component;
    Entry supports{"Supports"}, displacements{"Displacement"};
    for (const auto &[boundary, of_components] : prescribed)
      {
        std::string components;
        for (const auto &[c, of] : of_components)
          if (of->value == 0.)
            {
              components += "xyz"[c];
              supports.add_line(of->line);
            }
          else
            {
              displacements.add(boundary + ": " + "xyz"[c] + " = " + to_text(of->value));
              displacements.add_line(of->line);
            }
        if (!components.empty())
          supports.add(boundary + ": " + components);
      }
    write_entry(supports);
    write_entry(displacements);
  }

  /// Write pressures or tractions. Several ones on a boundary are added.
  void write_loads(const unsigned int b, Entry entry, const std::vector<DeckModel::FaceLoad> &loads)
  {
    std::map<std::string, std::vector<double>> sums;
    for (const auto &load : loads)
      for (const auto &boundary : bodies.boundaries(b, load.set))
        {
          auto &sum =
            sums.emplace(boundary, std::vector<double>(load.components.size(), 0.)).first->second;
          for (std::size_t i = 0; i < sum.size(); ++i)
            sum[i] += load.components[i];
          entry.add_line(load.line);
        }
    for (const auto &[boundary, sum] : sums)
      entry.add(boundary + ": " + to_text(sum, ' '));
    write_entry(entry);
  }

  /// Assign the forces at nodes to boundaries of the bodies.
  void place_point_forces()
  {
    point_forces.resize(bodies.all().size(), {"Point force"});
    const bool              are_many = model.point_forces.size() > most_point_forces;
    std::set<unsigned long> without_boundary, of_many;
    for (const auto &[node, force] : model.point_forces)
      {
        std::optional<std::string> boundary;
        for (unsigned int b = 0; b < point_forces.size() && !boundary && !are_many; ++b)
          if ((boundary = bodies.boundary_at(b, node)))
            {
              point_forces[b].add(*boundary + ": " + to_text(force.components, ' ') + " at " +
                                  to_text(bodies.position(node), ' '));
              for (const auto line : force.lines)
                point_forces[b].add_line(line);
            }
        if (!boundary)
          (are_many ? of_many : without_boundary).insert(force.lines.begin(), force.lines.end());
      }
    for (const auto line : without_boundary)
      left_out.add("*CLOAD of nodes on no boundary of a body", line);
    for (const auto line : of_many)
      left_out.add("*CLOAD of more than " + std::to_string(most_point_forces) +
                     " nodes; use *DSLOAD",
                   line);
  }

  /// Return the side of a contact: "body.a + body.a and b".
  std::string side(const std::string &set) const
  {
    const unsigned int b = bodies.bodies_of(set).front();
    Entry              faces{""};
    for (const auto &boundary : bodies.boundaries(b, set))
      faces.add(bodies.all()[b].name + "." + boundary, " + ");
    return faces.value;
  }

  void write_contacts()
  {
    if (model.contacts.empty())
      return;
    Entry pairs{"Pairs"};
    for (const auto &contact : model.contacts)
      {
        pairs.add(side(contact.slave) + ": " + side(contact.master));
        pairs.add_line(contact.line);
      }
    write("\nsubsection Contact");
    write_entry(pairs);
    write("end");
    for (const auto &contact : model.contacts)
      {
        write("\nsubsection Pair " + side(contact.slave) + ": " + side(contact.master));
        write_entry({"Slave", "first"});
        const auto friction = model.friction.find(contact.interaction);
        if (friction != model.friction.end() && friction->second > 0.)
          {
            write_entry({"Friction", "Coulomb"});
            write_entry({"Friction coefficient", to_text(friction->second)});
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
  LeftOut     left_out;
  const auto  model = read_model(mesh_file::DeckText(text), deck, bodies, left_out);
  Translation result;
  const auto  parameters = Writer(model, bodies, file, left_out).parameters();
  result.left_out        = left_out.lines();
  result.text            = "# Translation of " + file + " by 'snug --translate'.\n";
  if (!result.left_out.empty())
    result.text += "# These keywords of the deck are not part of this file:\n";
  for (const auto &line : result.left_out)
    result.text += "#   " + line + '\n';
  result.text += '\n' + parameters;
  return result;
}
} // namespace snug::deck
