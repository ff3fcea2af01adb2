#include <snug/deck/keyword_reader.h>

#include <algorithm>

namespace snug::deck {
using mesh_file::error_at_line;
using mesh_file::Keyword;
using mesh_file::keyword_error;
using mesh_file::numbers_from;
using mesh_file::upper_case;
using Words = std::vector<std::string>;

namespace {
/// A keyword that is read with the mesh.
struct ReadElsewhere
{
  bool                  takes_lines; ///< whether data lines follow
  std::set<std::string> options;
};

const std::map<std::string, ReadElsewhere> read_elsewhere = {
  {"HEADING", {true, {}}},
  {"NODE", {true, {"NSET", "SYSTEM"}}},
  {"ELSET", {true, {"ELSET", "GENERATE", "INSTANCE", "INTERNAL"}}},
  {"NSET", {true, {"NSET", "GENERATE", "INSTANCE", "INTERNAL", "UNSORTED"}}},
  {"SURFACE", {true, {"NAME", "TYPE", "INTERNAL"}}},
  {"PART", {false, {"NAME"}}},
  {"ENDPART", {false, {}}},
  {"ASSEMBLY", {false, {"NAME"}}},
  {"ENDASSEMBLY", {false, {}}},
  {"INSTANCE", {true, {"NAME", "PART"}}},
  {"ENDINSTANCE", {false, {}}},
  {"TRANSFORM", {true, {"NSET", "TYPE"}}},
  {"AMPLITUDE", {true, {"NAME", "DEFINITION", "TIME", "VALUE", "SMOOTH"}}},
  {"PREPRINT", {false, {"ECHO", "MODEL", "HISTORY", "CONTACT", "PARVALUES", "PARSUBSTITUTION"}}}};

/// Requests for output, controls, and data that a static, isothermal state does not depend on.
const std::set<std::string> without_effect = {"NODEFILE",
                                              "ELFILE",
                                              "CONTACTFILE",
                                              "NODEPRINT",
                                              "ELPRINT",
                                              "CONTACTPRINT",
                                              "FACEPRINT",
                                              "ENERGYPRINT",
                                              "ENERGYFILE",
                                              "SECTIONPRINT",
                                              "SECTIONFILE",
                                              "OUTPUT",
                                              "NODEOUTPUT",
                                              "ELEMENTOUTPUT",
                                              "CONTACTOUTPUT",
                                              "ENERGYOUTPUT",
                                              "INTEGRATEDOUTPUT",
                                              "RESTART",
                                              "MONITOR",
                                              "PRINT",
                                              "FILEFORMAT",
                                              "FILEOUTPUT",
                                              "CONTROLS",
                                              "CONTACTCONTROLS",
                                              "SOLVERCONTROLS",
                                              "SECTIONCONTROLS",
                                              "HOURGLASSSTIFFNESS",
                                              "TIMEPOINTS",
                                              "FILTER",
                                              "DIAGNOSTICS",
                                              "ORIENTATION",
                                              "PHYSICALCONSTANTS",
                                              "DAMPING",
                                              "SPECIFICHEAT",
                                              "CONDUCTIVITY",
                                              "CONTACTFORMULATION",
                                              "CONTACTSTABILIZATION"};

/// Largest numbers of words in data lines. More of them come from a comma as decimal point.
const std::map<std::string, std::size_t> most_words = {
  {"NODE", 7},        {"ELASTIC", 3},      {"DENSITY", 2},
  {"EXPANSION", 2},   {"FRICTION", 2},     {"DLOAD", 9},
  {"DSLOAD", 6},      {"CLOAD", 3},        {"BOUNDARY", 4},
  {"SPRING", 2},      {"CONTACTPAIR", 2},  {"TIE", 2},
  {"TEMPERATURE", 2}, {"STATIC", 4},       {"INITIALCONDITIONS", 2},
  {"KINEMATIC", 2},   {"DISTRIBUTING", 2}, {"PRE-TENSIONSECTION", 3}};

/// Throw for a data line with too many words.
void require_few_words(const Reading &reading, const Keyword &keyword)
{
  const auto most = most_words.find(keyword.name);
  if (most == most_words.end())
    return;
  reading.text.for_each_line(keyword, [&](const Words &words, const unsigned long line) {
    std::size_t n = words.size(), allowed = most->second;
    while (n > 0 && words[n - 1].empty())
      --n;
    // A node may have a normal behind its three coordinates, and a pressure is one number.
    if (keyword.name == "NODE" && n < 7)
      allowed = 4;
    if (n > 1 && (keyword.name == "DLOAD" || keyword.name == "DSLOAD") &&
        upper_case(words[1])[0] == 'P')
      allowed = 3;
    if (n > allowed)
      throw error_at_line(line, keyword.title + " has " + std::to_string(n) +
                                  " words instead of at most " + std::to_string(allowed) +
                                  "; a decimal number has a point, and no comma");
  });
}

/// Follow the parts and instances of the deck.
void enter(Reading &reading, const Keyword &keyword)
{
  const auto &scopes = reading.deck.sets.scopes;
  if (keyword.name == "ENDPART" || keyword.name == "ENDINSTANCE")
    reading.prefixes = {""};
  if (keyword.name == "INSTANCE")
    reading.prefixes = {upper_case(keyword.option("NAME")) + "."};
  if (keyword.name == "PART" && scopes.size() > 1)
    {
      reading.prefixes.clear();
      for (const auto &[prefix, scope] : scopes)
        if (scope.part == upper_case(keyword.option("NAME")))
          reading.prefixes.push_back(prefix);
    }
}

/// Read the unit system that PrePoMax writes to the heading.
void read_heading(Reading &reading, const Keyword &keyword)
{
  static const std::map<std::string, std::string> systems = {{"M_KG_S_C", "m, N"},
                                                             {"MM_TON_S_C", "mm, N"},
                                                             {"M_TON_S_C", "m, kN"},
                                                             {"IN_LB_S_F", "in, lbf"}};
  const std::string                               title   = "Unit system: ";
  reading.text.for_each_line(keyword, [&](const Words &words, unsigned long) {
    for (const auto &word : words)
      if (const auto found = systems.find(word.substr(std::min(title.size(), word.size())));
          word.rfind(title, 0) == 0 && found != systems.end())
        reading.model.units = found->second;
  });
}

void read_keyword(Reading &reading, const KeywordReadings &readings, const Keyword &keyword)
{
  require_few_words(reading, keyword);
  const auto elsewhere = read_elsewhere.find(keyword.name);
  const auto found     = readings.find(keyword.name);
  if (without_effect.count(keyword.name) > 0)
    reading.remarks.not_needed(title_of(keyword), keyword.line);
  else if (elsewhere != read_elsewhere.end())
    {
      for (const auto &option : keyword.options)
        if (elsewhere->second.options.count(option.first) == 0)
          reading.lacks(keyword, ": the option " + option.first);
      if (!elsewhere->second.takes_lines)
        require_no_lines(reading, keyword);
      if (keyword.name == "HEADING")
        read_heading(reading, keyword);
    }
  else if (found == readings.end())
    reading.lacks(keyword, "");
  else
    {
      for (const auto &[option, value] : keyword.options)
        if (found->second.options.unneeded.count(option) > 0)
          reading.remarks.not_needed(title_of(keyword) + ": " + option, keyword.line);
        else if (found->second.options.read.count(option) == 0 && upper_case(value) != "NO")
          reading.lacks(keyword, ": the option " + option);
      if (!found->second.takes_lines)
        require_no_lines(reading, keyword);
      found->second.read(keyword);
    }
}
} // namespace

std::string title_of(const Keyword &keyword)
{
  return keyword.title + (keyword.file.empty() ? "" : " in '" + keyword.file + "'");
}

void Reading::lacks(const Keyword &keyword, const std::string &what, const unsigned long line)
{
  std::string kind = keyword.title.substr(1);
  for (char &c : kind)
    c = std::tolower(static_cast<unsigned char>(c));
  remarks.lacks(kind, title_of(keyword) + what, line);
}

std::vector<double> Reading::first_line(const Keyword &keyword)
{
  std::vector<double> numbers;
  unsigned int        n = 0;
  text.for_each_line(keyword, [&](const Words &words, const unsigned long line) {
    if (n++ == 0)
      numbers = numbers_from(words, 0, line);
    else
      lacks(keyword, ": lines after the first", line);
  });
  return numbers;
}

std::string Reading::surface(const std::string &word, const unsigned long line) const
{
  const auto &sets  = deck.sets;
  const auto  found = sets.spelling.find(upper_case(word));
  if (found != sets.spelling.end() && sets.surfaces.count(found->second) > 0)
    return found->second;
  if (found == sets.spelling.end() || sets.of_nodes.count(found->first) == 0)
    throw error_at_line(line, "there is no surface '" + word + "'");
  return sets.boundary_of_nodes(found->first);
}

bool Reading::use(const Keyword &keyword, const std::string &set, const unsigned long line)
{
  if (set.find_first_of(",:;=#\\+") != std::string::npos)
    lacks(keyword, " of '" + set + "': the name must not contain , : ; = # \\ or +", line);
  else if (!bodies.use(set))
    lacks(keyword, " of '" + set + "', which has no face of a body", line);
  else
    return true;
  return false;
}

void require_no_lines(const Reading &reading, const Keyword &keyword)
{
  reading.text.for_each_line(keyword, [&](const Words &words, const unsigned long line) {
    throw error_at_line(line, "'" + words[0] + "' follows " + keyword.title +
                                ", which has no data lines");
  });
}

namespace {
/// Throw unless all cells have an isotropic material.
void require_materials(const Reading &reading)
{
  const auto &model = reading.model;
  for (const auto &body : reading.bodies.all())
    for (const unsigned int e : body.elements)
      {
        const auto &element = reading.deck.mesh.elements[e];
        const auto  name    = model.material_of.find(e);
        if (name == model.material_of.end())
          throw error_at_line(element.line, "element " + std::to_string(element.number) +
                                              " has no material; *SOLID SECTION must assign one");
        const auto found =
          std::find_if(model.materials.begin(), model.materials.end(), [&](const auto &material) {
            return upper_case(material.name) == name->second;
          });
        if (found == model.materials.end())
          throw error_at_line(model.section_lines.at(name->second),
                              "there is no *MATERIAL '" + name->second + "'");
        if (!found->youngs_modulus)
          throw error_at_line(found->line,
                              "*MATERIAL '" + found->name + "' has no isotropic *ELASTIC");
      }
}
} // namespace

DeckModel read_model(const mesh_file::DeckText &text,
                     const mesh_file::DeckMesh &deck,
                     DeckBodies                &bodies,
                     Remarks                   &remarks)
{
  Reading         reading{text, deck, bodies, remarks, Amplitudes(text), LocalAxes(text, deck)};
  KeywordReadings readings = material_readings(reading);
  readings.merge(support_readings(reading));
  readings.merge(load_readings(reading));
  readings.merge(rigid_readings(reading));
  readings.merge(bolt_readings(reading));
  readings.merge(contact_readings(reading));
  for (const auto &keyword : text.keywords())
    {
      enter(reading, keyword);
      read_keyword(reading, readings, keyword);
    }
  if (reading.in_step)
    throw error_at_line(reading.model.steps.back().line, "*STEP without *END STEP");
  require_materials(reading);
  return std::move(reading.model);
}
} // namespace snug::deck
