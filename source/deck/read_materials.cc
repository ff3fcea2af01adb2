#include <snug/deck/keyword_reader.h>

#include <algorithm>
#include <memory>

namespace snug::deck {
using mesh_file::error_at_line;
using mesh_file::Keyword;
using mesh_file::keyword_error;
using mesh_file::upper_case;
using Words = std::vector<std::string>;

namespace {
/// This class reads the elements, their sections and their materials.
class MaterialReader
{
public:
  explicit MaterialReader(Reading &reading) : reading(reading), model(reading.model)
  {
    for (const auto &keyword : reading.text.keywords())
      if (const auto cells = cells_of(keyword); cells && (cells->is_second || cells->bends))
        model.degree = 2;
  }

  /// The elements of plane models determine the model.
  void read_elements(const Keyword &keyword)
  {
    const auto type = upper_case(keyword.option("TYPE"));
    if (mesh_file::is_point_element(type))
      return read_point_elements(keyword, type);
    const auto cells = cells_of(keyword);
    if (!cells)
      return;
    if (reading.bodies.dimension() == 2)
      {
        const std::string kind = type.rfind("CPE", 0) == 0   ? "plane strain"
                                 : type.rfind("CAX", 0) == 0 ? "axisymmetric"
                                                             : "plane stress";
        if (model.model != "solid" && model.model != kind)
          throw keyword_error(keyword, "elements of " + model.model + " and of " + kind +
                                         " in one model are not supported");
        model.model = kind;
      }
    const bool is_simplex = cells->shape == mesh_file::ElementShape::tetrahedron ||
                            cells->shape == mesh_file::ElementShape::triangle ||
                            cells->shape == mesh_file::ElementShape::prism;
    if (!cells->is_second && (model.degree == 2 || is_simplex))
      reading.remarks.replaced("elements of degree 2 instead of " + type, keyword.line);
    else if (cells->is_reduced)
      reading.remarks.replaced("full integration instead of the reduced one of " + type,
                               keyword.line);
  }

  void read_material(const Keyword &keyword)
  {
    const auto name = keyword.option("NAME");
    if (name.empty())
      throw keyword_error(keyword, "*MATERIAL has no NAME");
    for (const auto &material : model.materials)
      if (upper_case(material.name) == upper_case(name))
        throw keyword_error(keyword, "*MATERIAL '" + name + "' occurs twice");
    model.materials.push_back({name, keyword.line, {}, {}});
  }

  void read_elastic(const Keyword &keyword)
  {
    if (!is_isotropic(keyword))
      return;
    const auto numbers = reading.first_line(keyword);
    if (numbers.size() < 2)
      throw keyword_error(keyword, keyword.title + " must have a modulus and a ratio");
    if (numbers.size() > 2)
      reading.remarks.not_needed(title_of(keyword) + ": temperature", keyword.line);
    material(keyword).youngs_modulus = numbers[0];
    material(keyword).poissons_ratio = numbers[1];
  }

  void read_density(const Keyword &keyword) { material(keyword).density = number_of(keyword); }

  void read_expansion(const Keyword &keyword)
  {
    // With a constant coefficient the strain since the initial temperature does not depend on the
    // temperature ZERO of no strain.
    if (is_isotropic(keyword))
      material(keyword).expansion = number_of(keyword);
  }

  /// Plasticity is lacking, but the first yield stress is compared with the stresses.
  void read_plastic(const Keyword &keyword)
  {
    reading.lacks(keyword, "");
    reading.text.for_each_line(keyword, [&](const Words &words, const unsigned long line) {
      if (material(keyword).yield_stress == 0.)
        material(keyword).yield_stress = mesh_file::numbers_from(words, 0, line).at(0);
    });
  }

  void read_section(const Keyword &keyword)
  {
    const auto       &sets = reading.deck.sets;
    const std::string name = keyword.option("ELSET"), of = keyword.option("MATERIAL");
    if (of.empty())
      throw keyword_error(keyword, keyword.title + " has no MATERIAL");
    model.section_lines.emplace(upper_case(of), keyword.line);
    for (const auto &prefix : reading.prefixes)
      for (const unsigned int e : sets.elements(name, prefix, keyword.title, keyword.line))
        {
          const auto shape = reading.deck.mesh.elements[e].shape;
          if (mesh_file::dimension(shape) < reading.bodies.dimension())
            reading.lacks(keyword, " of '" + name + "', whose elements are no cells");
          const auto key       = sets.find(sets.of_elements, name, prefix);
          model.material_of[e] = upper_case(of);
          model.region_of[e]   = name[0] == '_' || key.empty() ? of : sets.spelling.at(key);
        }
    const auto numbers = reading.first_line(keyword);
    if (model.model.rfind("plane", 0) != 0)
      return;
    const double thickness = !numbers.empty() && numbers[0] > 0. ? numbers[0] : 1.;
    if (model.thickness && *model.thickness != thickness)
      throw keyword_error(keyword, "sections of different thicknesses are not supported");
    model.thickness = thickness;
  }

  /// Read the stiffness of springs: a line of the component, then a line of the stiffness.
  void read_spring(const Keyword &keyword)
  {
    std::vector<std::vector<double>> lines;
    reading.text.for_each_line(keyword, [&](const Words &words, const unsigned long line) {
      lines.push_back(mesh_file::numbers_from(words, 0, line));
    });
    const auto &sets = reading.deck.sets;
    for (const auto &prefix : reading.prefixes)
      for (const unsigned int e :
           sets.elements(keyword.option("ELSET"), prefix, keyword.title, keyword.line))
        {
          const auto spring = reading.deck.point_elements.find(e);
          if (spring == reading.deck.point_elements.end() || spring->second.type != "SPRING1")
            return reading.lacks(keyword, " of other elements than SPRING1");
          if (lines.size() != 2 || lines[0].empty() || lines[1].empty())
            throw keyword_error(keyword, "a line with the component and a line with the stiffness "
                                         "are expected");
          if (lines[0][0] < 1. || lines[0][0] > reading.bodies.dimension() || lines[1][0] < 0.)
            return reading.lacks(keyword, " of a component or a stiffness that is not that of "
                                          "a solid");
          const unsigned int component = static_cast<unsigned int>(lines[0][0]) - 1;
          model.springs.push_back({spring->second.nodes[0], component, lines[1][0], keyword.line});
        }
  }

private:
  Reading                              &reading;
  DeckModel                            &model;
  std::optional<std::set<unsigned int>> cell_nodes; ///< once they are needed

  /// The meaning of the type of an element for cells.
  struct Cells
  {
    mesh_file::ElementShape shape;
    bool                    is_second;  ///< quadratic
    bool                    is_reduced; ///< reduced integration
    bool                    bends;      ///< linear, but flexible in bending, as degree 2 is
  };

  /// Return the cells of *ELEMENT, or nothing for other elements, such as CPS3 of Gmsh, which are
  /// faces of solids.
  std::optional<Cells> cells_of(const Keyword &keyword) const
  {
    const auto type = upper_case(keyword.option("TYPE"));
    if (keyword.name != "ELEMENT" || mesh_file::is_point_element(type))
      return {};
    const auto element = mesh_file::abaqus_type(type, keyword.line);
    if (mesh_file::dimension(element.shape) < reading.bodies.dimension())
      return {};
    // Letters behind the number of nodes are variants: reduced integration, incompatible modes.
    const auto variant    = type.substr(type.find_last_of("0123456789") + 1);
    const bool is_second  = element.n_nodes > mesh_file::n_corners(element.shape);
    const bool is_reduced = variant.find('R') != std::string::npos;
    return Cells{element.shape, is_second, is_reduced,
                 !is_second && (is_reduced || variant.find('I') != std::string::npos)};
  }

  DeckModel::Material &material(const Keyword &keyword)
  {
    if (model.materials.empty())
      throw keyword_error(keyword, keyword.title + " must follow *MATERIAL");
    return model.materials.back();
  }

  /// Return whether the type of *ELASTIC or *EXPANSION is isotropic; if not, it is lacking.
  bool is_isotropic(const Keyword &keyword)
  {
    const auto type = upper_case(keyword.option("TYPE"));
    if (type.empty() || type.rfind("ISO", 0) == 0)
      return true;
    reading.lacks(keyword, " of type " + type);
    return false;
  }

  double number_of(const Keyword &keyword)
  {
    const auto numbers = reading.first_line(keyword);
    if (numbers.empty())
      throw keyword_error(keyword, keyword.title + " must have a number");
    return numbers[0];
  }

  /// Springs are read with their section. Other elements are not needed if no cell has their nodes.
  void read_point_elements(const Keyword &keyword, const std::string &type)
  {
    if (type == "SPRING1")
      return;
    if (!cell_nodes)
      {
        cell_nodes.emplace();
        for (const auto &body : reading.bodies.all())
          for (const unsigned int e : body.elements)
            for (const unsigned int node : reading.deck.mesh.elements[e].corners)
              cell_nodes->insert(node);
      }
    bool is_attached = false;
    for (const auto &[index, element] : reading.deck.point_elements)
      for (const unsigned int node : element.nodes)
        is_attached = is_attached || (element.line == keyword.line && element.type == type &&
                                      cell_nodes->count(node) > 0);
    // A mass has a weight only.
    const auto &keywords = reading.text.keywords();
    const bool  is_heavy = std::any_of(keywords.begin(), keywords.end(),
                                       [](const auto &other) { return other.name == "DLOAD"; });
    if (is_attached && (type != "MASS" || is_heavy))
      reading.lacks(keyword, " of type " + type);
    else
      reading.remarks.not_needed(title_of(keyword) + " of type " + type, keyword.line);
  }
};
} // namespace

KeywordReadings material_readings(Reading &reading)
{
  const auto reader = std::make_shared<MaterialReader>(reading);
  using M           = MaterialReader;
  const auto by     = [reader](void (M::*read)(const Keyword &)) {
    return [reader, read](const Keyword &keyword) { (reader.get()->*read)(keyword); };
  };
  return {{"ELEMENT", {by(&M::read_elements), {{"TYPE", "ELSET"}, {}}}},
          {"MATERIAL", {by(&M::read_material), {{"NAME"}, {}}, false}},
          {"ELASTIC", {by(&M::read_elastic), {{"TYPE"}, {"MODULI"}}}},
          {"DENSITY", {by(&M::read_density)}},
          {"PLASTIC", {by(&M::read_plastic), {{"HARDENING"}, {}}}},
          {"EXPANSION", {by(&M::read_expansion), {{"TYPE", "ZERO"}, {}}}},
          {"SOLIDSECTION",
           {by(&M::read_section), {{"ELSET", "MATERIAL"}, {"ORIENTATION", "CONTROLS"}}}},
          {"SPRING", {by(&M::read_spring), {{"ELSET"}, {}}}},
          {"MASS",
           {[&reading](const Keyword &keyword) {
              reading.remarks.not_needed(title_of(keyword), keyword.line);
            },
            {{"ELSET"}, {}}}}};
}
} // namespace snug::deck
