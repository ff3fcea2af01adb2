#include <snug/deck/deck_model.h>

#include <algorithm>
#include <cmath>

namespace snug::deck {
namespace {
using mesh_file::error_at_line;
using mesh_file::Keyword;
using mesh_file::keyword_error;
using mesh_file::numbers_from;
using mesh_file::to_number;
using mesh_file::to_whole;
using mesh_file::upper_case;
using Words = std::vector<std::string>;

/// Keywords that are read with the mesh, or that change no result.
const std::set<std::string> read_elsewhere = {"HEADING",  "NODE",        "ELEMENT",  "ELSET",
                                              "NSET",     "SURFACE",     "PART",     "ENDPART",
                                              "ASSEMBLY", "ENDASSEMBLY", "INSTANCE", "ENDINSTANCE",
                                              "ENDSTEP",  "STATIC",      "PREPRINT"};

/// Return the title of a keyword, with the name of an included file.
std::string title_of(const Keyword &keyword)
{
  return keyword.title + (keyword.file.empty() ? "" : " in '" + keyword.file + "'");
}

/// This class reads the keywords one by one.
class ModelReader
{
public:
  ModelReader(const mesh_file::DeckText &text,
              const mesh_file::DeckMesh &deck,
              DeckBodies                &bodies,
              LeftOut                   &left_out)
    : text(text)
    , sets(deck.sets)
    , n_elements(deck.mesh.elements.size())
    , bodies(bodies)
    , left_out(left_out)
  {}

  DeckModel read()
  {
    prefixes = {""};
    for (const auto &keyword : text.keywords())
      {
        enter(keyword);
        if (keyword.name == "ELEMENT")
          read_family(keyword);
        if (step > 1 && keyword.name != "ENDSTEP")
          left_out.add(title_of(keyword) + " of a step after the first", keyword.line);
        else if (read_elsewhere.count(keyword.name) == 0)
          read_keyword(keyword);
      }
    return std::move(model);
  }

private:
  const mesh_file::DeckText &text;
  const mesh_file::DeckSets &sets;
  const std::size_t          n_elements;
  DeckBodies                &bodies;
  LeftOut                   &left_out;
  DeckModel                  model;
  unsigned int               step = 0;
  std::vector<std::string>   prefixes;    ///< of the instances of the current part
  std::string                interaction; ///< current *SURFACE INTERACTION

  /// Follow the parts, instances and steps of the deck.
  void enter(const Keyword &keyword)
  {
    if (keyword.name == "STEP")
      ++step;
    if (keyword.name == "ENDPART" || keyword.name == "ENDINSTANCE")
      prefixes = {""};
    if (keyword.name == "INSTANCE")
      prefixes = {upper_case(keyword.option("NAME")) + "."};
    if (keyword.name == "PART" && sets.scopes.size() > 1)
      {
        prefixes.clear();
        for (const auto &[prefix, scope] : sets.scopes)
          if (scope.part == upper_case(keyword.option("NAME")))
            prefixes.push_back(prefix);
      }
  }

  /// The elements of plane models determine the model. Other plane elements, such as CPS3 of Gmsh,
  /// may be faces of solids.
  void read_family(const Keyword &keyword)
  {
    const auto type = upper_case(keyword.option("TYPE"));
    if (bodies.dimension() == 2)
      model.model = type.rfind("CPE", 0) == 0   ? "plane strain"
                    : type.rfind("CAX", 0) == 0 ? "axisymmetric"
                                                : "plane stress";
  }

  void read_keyword(const Keyword &keyword)
  {
    struct Reading
    {
      void (ModelReader::*read)(const Keyword &);
      std::set<std::string> options; ///< that are read
    };
    using M                                              = ModelReader;
    static const std::map<std::string, Reading> readings = {
      {"STEP", {&M::read_nothing, {"NAME", "INC"}}},
      {"MATERIAL", {&M::read_material, {"NAME"}}},
      {"ELASTIC", {&M::read_elastic, {"TYPE"}}},
      {"DENSITY", {&M::read_density, {}}},
      {"SOLIDSECTION", {&M::read_section, {"ELSET", "MATERIAL"}}},
      {"BOUNDARY", {&M::read_boundary, {"OP"}}},
      {"DSLOAD", {&M::read_surface_load, {"OP"}}},
      {"DLOAD", {&M::read_element_load, {"OP"}}},
      {"CLOAD", {&M::read_point_load, {"OP"}}},
      {"SURFACEINTERACTION", {&M::read_interaction, {"NAME"}}},
      {"SURFACEBEHAVIOR", {&M::read_behavior, {"PRESSURE-OVERCLOSURE"}}},
      {"FRICTION", {&M::read_friction, {}}},
      {"CONTACTPAIR", {&M::read_contact, {"INTERACTION", "TYPE", "SMALLSLIDING"}}}};
    const auto found = readings.find(keyword.name);
    if (found == readings.end())
      return left_out.add(title_of(keyword), keyword.line);
    for (const auto &[option, value] : keyword.options)
      if (found->second.options.count(option) == 0 && upper_case(value) != "NO")
        left_out.add(title_of(keyword) + ": the option " + option, keyword.line);
    (this->*found->second.read)(keyword);
  }

  void read_nothing(const Keyword & /*keyword*/) {}

  void read_material(const Keyword &keyword)
  {
    model.materials.push_back({keyword.option("NAME"), keyword.line, {}, {}, 0.});
  }

  /// Return the numbers of the first data line. Further lines belong to further temperatures.
  std::vector<double> first_line(const Keyword &keyword)
  {
    std::vector<double> numbers;
    unsigned int        n = 0;
    text.for_each_line(keyword, [&](const Words &words, const unsigned long line) {
      if (n++ == 0)
        numbers = numbers_from(words, 0, line);
      else
        left_out.add(title_of(keyword) + ": lines after the first", line);
    });
    return numbers;
  }

  DeckModel::Material &material(const Keyword &keyword)
  {
    if (model.materials.empty())
      throw keyword_error(keyword, keyword.title + " must follow *MATERIAL");
    return model.materials.back();
  }

  void read_elastic(const Keyword &keyword)
  {
    const auto type = upper_case(keyword.option("TYPE"));
    if (!type.empty() && type.rfind("ISO", 0) != 0)
      return left_out.add(title_of(keyword) + " of type " + type, keyword.line);
    const auto numbers = first_line(keyword);
    if (numbers.size() < 2)
      throw keyword_error(keyword, keyword.title + " must have a modulus and a ratio");
    material(keyword).youngs_modulus = numbers[0];
    material(keyword).poissons_ratio = numbers[1];
  }

  void read_density(const Keyword &keyword)
  {
    const auto numbers = first_line(keyword);
    if (!numbers.empty())
      material(keyword).density = numbers[0];
  }

  void read_section(const Keyword &keyword)
  {
    const std::string name = keyword.option("ELSET"), of = keyword.option("MATERIAL");
    for (const auto &prefix : prefixes)
      for (const unsigned int e : sets.elements(name, prefix, keyword.title, keyword.line))
        {
          const auto key       = sets.find(sets.of_elements, name, prefix);
          model.material_of[e] = upper_case(of);
          model.region_of[e]   = name[0] == '_' || key.empty() ? of : sets.spelling.at(key);
        }
    if (model.model == "plane stress" || model.model == "plane strain")
      {
        const auto numbers = first_line(keyword);
        if (!numbers.empty() && numbers[0] > 0.)
          model.thickness = numbers[0];
      }
  }

  /// Return whether the set has faces, and note a set without faces or with further nodes.
  bool has_faces(const Keyword &keyword, const std::string &set, const unsigned long line)
  {
    if (set.find_first_of(",:;=#\\+") != std::string::npos)
      left_out.add(title_of(keyword) + " of '" + set +
                     "': the name must not contain , : ; = # \\ or +",
                   line);
    else if (!bodies.use(set))
      left_out.add(title_of(keyword) +
                     " of nodes or sets without a face whose nodes are all in the set" +
                     (keyword.name == "BOUNDARY" ? "; supports hold whole faces" : ""),
                   line);
    else
      {
        if (bodies.nodes_without_face(set) > 0)
          left_out.add(title_of(keyword) + ": nodes of '" + set +
                         "' without a face whose nodes are all in the set",
                       line);
        return true;
      }
    return false;
  }

  /// Read a line "node or set, first component, last component, value", or "set, ENCASTRE".
  void read_boundary(const Keyword &keyword)
  {
    static const std::map<std::string, std::vector<unsigned int>> names = {
      {"ENCASTRE", {0, 1, 2}}, {"PINNED", {0, 1, 2}}, {"XSYMM", {0}},     {"YSYMM", {1}},
      {"ZSYMM", {2}},          {"XASYMM", {1, 2}},    {"YASYMM", {0, 2}}, {"ZASYMM", {0, 1}}};
    text.for_each_line(keyword, [&](const Words &words, const unsigned long line) {
      if (words.size() < 2)
        throw error_at_line(line, "a set and its components are expected");
      const auto                named = names.find(upper_case(words[1]));
      std::vector<unsigned int> components;
      if (named != names.end())
        components = named->second;
      else
        {
          const auto first = to_whole(words[1], line);
          const auto last =
            words.size() > 2 && !words[2].empty() ? to_whole(words[2], line) : first;
          for (auto c = first; c <= last && c <= 6; ++c)
            components.push_back(c - 1);
        }
      // Nodes of solids have no rotations (4 to 6), and nodes of a plane model no third component.
      components.erase(std::remove_if(components.begin(), components.end(),
                                      [&](const auto c) { return c >= bodies.dimension(); }),
                       components.end());
      const double value  = words.size() > 3 && !words[3].empty() ? to_number(words[3], line) : 0.;
      const auto   listed = sets.of_lines.find(line);
      const auto   key    = sets.find(sets.of_nodes, words[0], "");
      if (listed == sets.of_lines.end() && key.empty())
        throw error_at_line(line, "there is no node set '" + words[0] + "'");
      const auto set = key.empty() ? listed->second : sets.boundary_of_nodes(key);
      if (has_faces(keyword, set, line))
        for (const unsigned int c : components)
          model.prescribed.push_back({set, c, value, line});
    });
  }

  /// Return the name of the surface @p word, which may consist of nodes.
  std::string surface(const std::string &word, const unsigned long line) const
  {
    const auto found = sets.spelling.find(upper_case(word));
    if (found != sets.spelling.end() && sets.surfaces.count(found->second) > 0)
      return found->second;
    if (found == sets.spelling.end() || sets.of_nodes.count(found->first) == 0)
      throw error_at_line(line, "there is no surface '" + word + "'");
    return sets.boundary_of_nodes(found->first);
  }

  /// Return a vector of dim components from {magnitude, direction}.
  std::vector<double> vector_from(std::vector<double> numbers) const
  {
    numbers.resize(4, 0.);
    const double        norm = std::hypot(numbers[1], numbers[2], numbers[3]);
    std::vector<double> result;
    for (unsigned int d = 0; d < bodies.dimension(); ++d)
      result.push_back(norm > 0. ? numbers[0] * numbers[1 + d] / norm : 0.);
    return result;
  }

  /// Read a line "surface, P, pressure" or "surface, TRVEC, magnitude, direction".
  void read_surface_load(const Keyword &keyword)
  {
    text.for_each_line(keyword, [&](const Words &words, const unsigned long line) {
      const auto type = words.size() > 2 ? upper_case(words[1]) : "";
      if (type != "P" && type != "TRVEC")
        return left_out.add(title_of(keyword) + " of type '" + type + "'", line);
      const auto set = surface(words[0], line);
      if (!has_faces(keyword, set, line))
        return;
      const auto numbers = numbers_from(words, 2, line);
      if (type == "P")
        model.pressures.push_back({set, {numbers[0]}, line});
      else
        model.tractions.push_back({set, vector_from(numbers), line});
    });
  }

  /// Read a line "elements, P3, pressure" or "elements, GRAV, magnitude, direction".
  void read_element_load(const Keyword &keyword)
  {
    text.for_each_line(keyword, [&](const Words &words, const unsigned long line) {
      const auto type   = words.size() > 2 ? upper_case(words[1]) : "";
      const auto listed = sets.of_lines.find(line);
      if (type == "GRAV")
        {
          DeckModel::Gravity gravity{{}, vector_from(numbers_from(words, 2, line)), line};
          for (unsigned int e = 0; e < n_elements && words[0].empty(); ++e)
            gravity.elements.insert(e);
          if (!words[0].empty())
            for (const unsigned int e : sets.elements(words[0], "", keyword.title, line))
              gravity.elements.insert(e);
          model.gravities.push_back(gravity);
        }
      else if (listed == sets.of_lines.end())
        left_out.add(title_of(keyword) + " of type '" + type + "'", line);
      else if (has_faces(keyword, listed->second, line))
        {
          // The lines of one boundary have the same pressure.
          const auto is_same = [&](const auto &load) { return load.set == listed->second; };
          if (std::none_of(model.pressures.begin(), model.pressures.end(), is_same))
            model.pressures.push_back({listed->second, {to_number(words[2], line)}, line});
        }
    });
  }

  void read_interaction(const Keyword &keyword)
  {
    interaction = upper_case(keyword.option("NAME"));
    model.friction.emplace(interaction, 0.);
  }

  /// Contact is hard, whatever the penalty of the deck.
  void read_behavior(const Keyword &keyword)
  {
    const auto law = upper_case(keyword.option("PRESSURE-OVERCLOSURE"));
    if (!law.empty() && law != "HARD")
      left_out.add(title_of(keyword) + " " + law + ": contact is hard", keyword.line);
  }

  /// Read a line "node or set, component, force".
  void read_point_load(const Keyword &keyword)
  {
    text.for_each_line(keyword, [&](const Words &words, const unsigned long line) {
      if (words.size() < 3)
        throw error_at_line(line, "a node or set, a component and a force are expected");
      const auto   nodes     = sets.nodes(words[0], "", keyword.title, line);
      const auto   component = to_whole(words[1], line);
      const double force     = to_number(words[2], line);
      if (component < 1 || component > bodies.dimension())
        return left_out.add(title_of(keyword) + " of component " + words[1], line);
      if (component == 1 && model.model == "axisymmetric")
        return left_out.add(title_of(keyword) + " along the radius of an axisymmetric model", line);
      for (const unsigned int node : nodes)
        {
          auto &sum = model.point_forces[node];
          sum.components.resize(bodies.dimension(), 0.);
          sum.components[component - 1] += force;
          sum.lines.push_back(line);
        }
    });
  }

  void read_friction(const Keyword &keyword)
  {
    const auto numbers = first_line(keyword);
    if (!numbers.empty())
      model.friction[interaction] = numbers[0];
    if (numbers.size() > 1)
      left_out.add(title_of(keyword) + ": numbers after the coefficient", keyword.line);
  }

  /// Read a line "slave surface, master surface".
  void read_contact(const Keyword &keyword)
  {
    text.for_each_line(keyword, [&](const Words &words, const unsigned long line) {
      if (words.size() < 2)
        return left_out.add(title_of(keyword) + " of a surface with itself", line);
      if (upper_case(keyword.option("TYPE")) == "TIED")
        return left_out.add(title_of(keyword) + " of type TIED", line);
      const auto slave = surface(words[0], line), master = surface(words[1], line);
      if (!has_faces(keyword, slave, line) || !has_faces(keyword, master, line))
        return;
      const auto of_slave = bodies.bodies_of(slave), of_master = bodies.bodies_of(master);
      if (of_slave.size() > 1 || of_master.size() > 1)
        left_out.add(title_of(keyword) + " of a surface on several bodies", line);
      else if (of_slave == of_master)
        left_out.add(title_of(keyword) + " of a body with itself", line);
      else
        model.contacts.push_back({slave, master, upper_case(keyword.option("INTERACTION")), line});
    });
  }
};
} // namespace

DeckModel read_model(const mesh_file::DeckText &text,
                     const mesh_file::DeckMesh &deck,
                     DeckBodies                &bodies,
                     LeftOut                   &left_out)
{
  return ModelReader(text, deck, bodies, left_out).read();
}
} // namespace snug::deck
