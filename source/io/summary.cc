#include <snug/io/summary.h>
#include <snug/io/text_file.h>

#include <algorithm>
#include <sstream>

namespace snug::io {
namespace {
/// A JSON object that keeps the order in which members are written. Numbers that are not finite
/// become null.
using Json = nlohmann::ordered_json;

/// Return the part of the program. Other tools read the keys: keys may be added, but are never
/// renamed.
Json summary_part(const Summary::Program &program)
{
  return {{"version", program.version}, {"dealii", program.dealii},     {"petsc", program.petsc},
          {"blas", program.blas},       {"compiler", program.compiler}, {"ranks", program.ranks}};
}

Json summary_part(const Summary::Mesh &mesh)
{
  return {{"bodies", mesh.bodies},
          {"cells", mesh.cells},
          {"dofs", mesh.dofs},
          {"subdomains", mesh.subdomains},
          {"clusters", mesh.clusters},
          {"ranks", mesh.ranks},
          {"constraints", mesh.constraints},
          {"contact_rows", mesh.contact_rows},
          {"rigid_body_modes", mesh.rigid_body_modes}};
}

Json summary_part(const Summary::GradientRow &row)
{
  return {{"method", row.method},
          {"f_mults", row.f_mults},
          {"numeric_factorizations", row.numeric_factorizations},
          {"seconds", row.seconds},
          {"values", row.values},
          {"step", row.step},
          {"displacement_difference", row.displacement_difference},
          {"differentiable", row.differentiable}};
}

Json summary_part(const Summary::Gradient &gradient)
{
  // The copy selects the overload of the base class, because otherwise this function would call
  // itself.
  Json part       = summary_part(Summary::GradientRow(gradient));
  part["reason"]  = gradient.reason;
  part["methods"] = Json::array();
  for (const auto &row : gradient.methods)
    part["methods"].push_back(summary_part(row));
  return part;
}

template <typename Part>
Json summary_part(const std::optional<Part> &part);

Json summary_part(const Summary::Gain &gain)
{
  return {{"initial", gain.initial},
          {"initial_error", gain.initial_error},
          {"final", gain.final},
          {"final_error", gain.final_error},
          {"counts", gain.counts}};
}

Json summary_part(const std::vector<Summary::Constraint> &constraints)
{
  Json part = Json::array();
  for (const auto &constraint : constraints)
    part.push_back({{"name", constraint.name},
                    {"initial", constraint.initial},
                    {"value", constraint.value},
                    {"limit", constraint.limit},
                    {"relation", constraint.relation},
                    {"violation", constraint.violation},
                    {"active", constraint.active}});
  return part;
}

Json summary_part(const Summary::Optimization &optimization)
{
  Json shapes = Json::object();
  for (const auto &[name, variables] : optimization.shapes)
    shapes[name] = variables;
  return {{"algorithm", optimization.algorithm},
          {"iterations", optimization.iterations},
          {"evaluations", optimization.evaluations},
          {"objective_initial", optimization.objective_initial},
          {"objective_final", optimization.objective_final},
          {"constraint_violation", optimization.constraint_violation},
          {"constraints", summary_part(optimization.constraints)},
          {"objective_after_contact_update", optimization.objective_after_contact_update},
          {"constraint_violation_after_contact_update",
           optimization.constraint_violation_after_contact_update},
          {"gain", summary_part(optimization.gain)},
          {"projected_gradient", optimization.projected_gradient},
          {"stop_reason", optimization.stop_reason},
          {"design", optimization.x},
          {"shapes", shapes}};
}

Json summary_part(const Summary::LoadCase &load_case)
{
  Json part = {{"name", load_case.name}, {"weight", load_case.weight}, {"state", load_case.state}};
  if (load_case.initial_state)
    part["initial_state"] = *load_case.initial_state;
  return part;
}

/// Return the values by which load cases are compared.
Json main_values(const Summary::State &state)
{
  Json   values;
  double worst = 0.;
  for (const auto &error : state.at("certificate"))
    worst = std::max(worst, error.get<double>());
  for (const char *key : {"compliance", "contact_area", "max_pressure", "max_von_mises",
                          "max_displacement", "yield_utilization", "pressure_over_shear_yield"})
    if (!state.at(key).is_null())
      values[key] = state.at(key);
  if (const auto &accuracy = state.at("accuracy"); !accuracy.is_null())
    values["discretization_error"] = accuracy.at("relative");
  values["worst_certificate"] = worst;
  values["responses"]         = state.at("responses");
  return values;
}

/// Replace values in @p largest that are smaller than the @p values of a load case.
void keep_largest(const std::string &load_case, const Json &values, Json &largest)
{
  for (const auto &[name, value] : values.items())
    {
      Json &place = largest[name];
      if (value.is_object())
        {
          if (place.is_null())
            place = Json::object();
          keep_largest(load_case, value, place);
        }
      // The negated comparison counts NaN as larger.
      else if (place.is_null() || !(value.get<double>() <= place["value"].get<double>()))
        place = {{"load_case", load_case}, {"value", value}};
    }
}

/// Add which load case @p state shows, the main values of all load cases, and the maximum of each
/// value with its load case. All are null if there is only one load case.
void add_load_cases(const std::vector<Summary::LoadCase> &load_cases, Json &state)
{
  for (const char *key : {"load_case", "load_cases", "largest"})
    state[key] = nullptr;
  if (load_cases.empty())
    return;
  state["load_case"] = load_cases.front().name;
  for (const auto &load_case : load_cases)
    {
      const Json values                   = main_values(load_case.state);
      state["load_cases"][load_case.name] = values;
      keep_largest(load_case.name, values, state["largest"]);
    }
}

/// Return the part. If it was not computed, its keys are written with null for values.
template <typename Part>
Json summary_part(const std::optional<Part> &part)
{
  // Start from a default part, so that the keys are written in one place only.
  Json result = summary_part(part.value_or(Part()));
  if (!part)
    for (auto &entry : result.items())
      entry.value() = nullptr;
  return result;
}

Json summary_part(const Work &work)
{
  return {{"f_mults", work.f_mults},
          {"preconditioner_applications", work.preconditioner_applications},
          {"coarse_factorizations", work.coarse_factorizations},
          {"coarse_solves", work.coarse_solves},
          {"subdomain_solves", work.subdomain_solves},
          {"symbolic_factorizations", work.symbolic_factorizations},
          {"numeric_factorizations", work.numeric_factorizations},
          {"assembled_subdomains", work.assembled_subdomains},
          {"soft_modes", work.soft_modes}};
}

Json summary_part(const std::vector<Summary::MeasuredResponse> &responses)
{
  Json part = Json::object();
  for (const auto &response : responses)
    part[response.name] = {{"value", response.value}, {"error", response.error}};
  return part;
}

Json summary_part(const Summary::Adaptation &adaptation)
{
  Json meshes = Json::array();
  for (const auto &mesh : adaptation.meshes)
    meshes.push_back({{"dofs", mesh.dofs},
                      {"contact_faces", mesh.contact_faces},
                      {"tolerance", mesh.tolerance},
                      {"f_mults", mesh.f_mults},
                      {"seconds", mesh.seconds},
                      {"responses", summary_part(mesh.responses)}});
  return {{"met", adaptation.met},
          {"meshes", meshes},
          {"verified", summary_part(adaptation.verified)}};
}

Json summary_part(const Summary::Times &times)
{
  return {{"setup", times.setup},
          {"assembly", times.assembly},
          {"factorization", times.factorization},
          {"soft_modes", times.soft_modes},
          {"solve", times.solve},
          {"gradient", times.gradient},
          {"accuracy", times.accuracy},
          {"output", times.output},
          {"total", times.total}};
}

Json summary_part(const Summary::Memory &memory)
{
  Json stages = Json::object();
  for (const auto &[stage, used] : memory.stages)
    stages[stage] = used;
  return {{"largest", memory.largest}, {"total", memory.total}, {"stages", stages}};
}

Json summary_part(const Spread &spread)
{
  return {{"least", spread.least}, {"mean", spread.mean}, {"largest", spread.largest}};
}

Json summary_part(const Balance &balance)
{
  Json seconds = Json::object();
  for (const auto &[stage, spread] : balance.seconds)
    seconds[stage] = summary_part(spread);
  return {{"subdomains", summary_part(balance.subdomains)},
          {"cells", summary_part(balance.cells)},
          {"unknowns", summary_part(balance.unknowns)},
          {"seconds", seconds},
          {"f_mult",
           {{"neighbours", balance.neighbours},
            {"messages", balance.messages},
            {"bytes", balance.bytes}}}};
}
} // namespace

namespace {
/// Add the numbers of a state to a table: numbers, components of vectors and responses by name.
void add_numbers(const Json &state, std::vector<std::string> &names, std::vector<double> &numbers)
{
  const auto add = [&](const std::string &name, const Json &value) {
    names.push_back(name);
    numbers.push_back(value.is_number() ? value.get<double>() : Summary::none);
  };
  for (const char *key : {"contact_area", "max_pressure", "max_von_mises", "max_displacement",
                          "active_contacts", "energy", "compliance", "strain_energy"})
    add(key, state.at(key));
  for (std::size_t d = 0; d < state.at("contact_force").size(); ++d)
    add(std::string("contact_force_") + "xyz"[d], state.at("contact_force")[d]);
  for (const auto &tie : state.at("ties"))
    {
      const auto of = " " + tie.at("name").get<std::string>();
      for (const char *key : {"force", "moment"})
        for (std::size_t d = 0; d < tie.at(key).size(); ++d)
          add(std::string("tie_") + key + "_" + "xyz"[d] + of, tie.at(key)[d]);
      for (const char *key : {"max_tension", "max_shear"})
        add(std::string("tie_") + key + of, tie.at(key));
    }
  for (const auto &point : state.at("points"))
    for (const char *key : {"displacement", "rotation", "force", "moment"})
      for (std::size_t d = 0; d < point.at(key).size(); ++d)
        add(std::string("point_") + key + "_" + "xyz"[d] + " " +
              point.at("name").get<std::string>(),
            point.at(key)[d]);
  for (const auto &bolt : state.at("bolts"))
    for (const char *key : {"tension", "shortening"})
      add(std::string("bolt_") + key + " " + bolt.at("name").get<std::string>(), bolt.at(key));
  for (const auto &[name, value] : state.at("responses").items())
    add(name, value);
}
} // namespace

std::string Summary::load_case_table() const
{
  std::ostringstream text;
  for (const auto &load_case : load_cases)
    {
      const auto add_row = [&](const char *design, const State &state) {
        std::vector<std::string> names;
        std::vector<double>      numbers;
        add_numbers(state, names, numbers);
        if (text.tellp() == 0)
          {
            text << "load_case,design";
            for (const auto &name : names)
              text << ',' << name;
            text << '\n';
          }
        text << load_case.name << ',' << design;
        for (const double number : numbers)
          text << ',' << exact(number);
        text << '\n';
      };
      if (load_case.initial_state)
        add_row("first", *load_case.initial_state);
      add_row("last", load_case.state);
    }
  return text.str();
}

std::string Summary::json() const
{
  Json text = {{"program", summary_part(program)},
               {"mesh", summary_part(mesh)},
               {"state", state},
               {"gradient", summary_part(gradient)},
               {"optimization", summary_part(optimization)},
               {"work", summary_part(work)},
               {"times", summary_part(times)},
               {"memory", summary_part(memory)},
               {"task", task},
               {"warnings", Json::array()},
               {"checks", Json::array()}};
  for (const auto &warning : warnings)
    {
      text["warnings"].push_back(warning.text);
      text["checks"].push_back({{"code", warning.code},
                                {"text", warning.text},
                                {"value", warning.value},
                                {"bound", warning.bound}});
    }
  add_load_cases(load_cases, text["state"]);
  // Add these keys only if there is a second state, load case or rank, or a target. The keys above
  // are always written.
  if (initial_state)
    text["initial_state"] = *initial_state;
  for (const auto &load_case : load_cases)
    text["load_cases"].push_back(summary_part(load_case));
  for (const auto &[quantity, unit] : units)
    text["units"][quantity] = unit;
  for (const auto &face : profile)
    text["profile"].push_back({{"face", face.name},
                               {"kind", face.kind},
                               {"spans", face.spans},
                               {"deviation", face.deviation},
                               {"asked", face.asked}});
  if (advice)
    {
      text["advice"] = Json::array();
      for (const auto &item : *advice)
        text["advice"].push_back({{"kind", item.kind},
                                  {"text", item.text},
                                  {"saving", item.saving},
                                  {"saves", item.saves},
                                  {"error", item.error}});
    }
  if (balance)
    text["balance"] = summary_part(*balance);
  if (accuracy)
    text["accuracy"] = summary_part(*accuracy);
  // Replace invalid characters, because file names in messages need not be UTF-8, but JSON must be.
  return text.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

void Summary::write(const std::string &path) const
{
  write_text_file(path, json());
}
} // namespace snug::io
