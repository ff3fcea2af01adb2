#include <snug/base/errors.h>
#include <snug/io/answer.h>

#include <unistd.h>

#include <algorithm>
#include <cerrno>

namespace snug::io {
namespace {
template <int dim>
Json list(const dealii::Tensor<1, dim> &vector)
{
  Json result = Json::array();
  for (unsigned int d = 0; d < dim; ++d)
    result.push_back(vector[d]);
  return result;
}

std::string load_case_name(const scene::Scene &scene, const unsigned int c)
{
  return scene.load_cases.empty() ? "" : scene.load_cases[c].name;
}

std::string kind_of(const std::exception &error)
{
  if (dynamic_cast<const RequestError *>(&error) != nullptr ||
      dynamic_cast<const nlohmann::json::exception *>(&error) != nullptr)
    return "request";
  if (dynamic_cast<const InputError *>(&error) != nullptr)
    return "input";
  if (dynamic_cast<const TangledMesh *>(&error) != nullptr)
    return "tangled";
  if (dynamic_cast<const SolveError *>(&error) != nullptr)
    return "solve";
  if (dynamic_cast<const Interrupted *>(&error) != nullptr)
    return "interrupted";
  return is_out_of_memory(error) ? "memory" : "internal";
}

std::string status(const state::ContactPoint &point)
{
  if (point.friction != state::FrictionStatus::none)
    return to_text(point.friction);
  return point.active ? "closed" : "open";
}
} // namespace

bool write_line(const int descriptor, const Json &answer)
{
  const auto text = answer.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
  for (std::size_t begin = 0; begin < text.size();)
    {
      const auto n = ::write(descriptor, text.data() + begin, text.size() - begin);
      if (n < 0 && errno != EINTR)
        return false;
      begin += std::max<ssize_t>(n, 0);
    }
  return true;
}

Json error_part(const std::exception &error)
{
  Json        part  = {{"kind", kind_of(error)}, {"message", one_line(error)}};
  const auto *input = dynamic_cast<const InputError *>(&error);
  if (input == nullptr)
    return part;
  const auto add = [&part](const char *key, const std::string &text) {
    if (!text.empty())
      part[key] = text;
  };
  add("file", input->place().file);
  if (input->place().line > 0)
    part["line"] = input->place().line;
  add("entry", input->wrong().entry);
  add("value", input->wrong().value);
  add("allowed", input->wrong().allowed);
  add("suggestion", input->wrong().suggestion);
  return part;
}

Json warnings_part(const std::vector<Warning> &warnings)
{
  Json part = Json::array();
  for (const auto &warning : warnings)
    part.push_back({{"code", warning.code},
                    {"text", warning.text},
                    {"value", warning.value},
                    {"bound", warning.bound}});
  return part;
}

template <int dim>
Json load_cases_part(const scene::Scene &scene, const std::vector<state::ContactState<dim>> &states)
{
  Json part = Json::array();
  for (const auto &state : states)
    part.push_back({{"name", load_case_name(scene, state.load_case)},
                    {"max_pressure", state.max_pressure},
                    {"contact_area", state.contact_area},
                    {"contact_force", list(state.contact_force)},
                    {"active_contacts", state.active_contacts},
                    {"weak_contacts", state.weak_contacts},
                    {"certificate", state.certificate.worst()}});
  return part;
}

template <int dim>
Json contact_part(const scene::Scene                          &scene,
                  const state::StateSolver<dim>               &solver,
                  const std::vector<state::ContactState<dim>> &states)
{
  Json part = Json::array();
  for (const auto &state : states)
    {
      const auto &contact   = solver.contact(state.load_case);
      const auto  positions = solver.surface().gather(state.positions);
      const auto  in_space  = contact.placed_surface().to_space(positions);
      const auto  rows      = contact.rows(positions);
      Json        tables    = Json::array();
      for (const auto &pair : contact.named_pairs())
        {
          tables.push_back(
            {{"load_case", load_case_name(scene, state.load_case)}, {"pair", pair.name()}});
          for (const char *column :
               {"position", "normal", "pressure", "gap", "force", "area", "status"})
            tables.back()[column] = Json::array();
        }
      for (unsigned int i = 0; i < state.contact.size(); ++i)
        {
          const auto &point = state.contact[i];
          const auto &place = contact.places()[i];
          auto       &table = tables[place.named];
          table["position"].push_back(list(in_space[place.slave]));
          table["normal"].push_back(list(rows[i].normal));
          table["pressure"].push_back(point.pressure);
          table["gap"].push_back(point.gap);
          table["force"].push_back(point.force);
          table["area"].push_back(point.area);
          table["status"].push_back(status(point));
        }
      part.insert(part.end(), tables.begin(), tables.end());
    }
  return part;
}

template <int dim>
Json variables_part(const scene::Scene &scene, const shape::Shapes<dim> &shapes)
{
  const auto  scale = shapes.first_steps();
  const auto &units = scene.units;
  Json        part  = Json::array();
  for (const auto &[name, values] : shapes.by_shape(shapes.start()))
    for (std::size_t k = 0; k < values.size(); ++k)
      {
        std::string label = name;
        // Amplitudes of formulas may have any unit.
        bool is_length = true;
        for (const auto &shape : scene.shapes)
          if (shape.name == name)
            {
              label     = name.empty() ? (shape.face.empty() ? "shape" : shape.face) : name;
              is_length = shape.modes.empty();
            }
        const std::size_t i = part.size();
        part.push_back({{"name", label + "[" + std::to_string(k) + "]"},
                        {"lower", shapes.lower_bounds()[i]},
                        {"upper", shapes.upper_bounds()[i]},
                        {"start", shapes.start()[i]},
                        {"scale", scale[i]},
                        {"unit", is_length && !units.empty() ? units.front() : ""}});
      }
  return part;
}

#define SNUG_INSTANTIATE(dim)                                                       \
  template Json load_cases_part(const scene::Scene &,                               \
                                const std::vector<state::ContactState<dim>> &);     \
  template Json contact_part(const scene::Scene &, const state::StateSolver<dim> &, \
                             const std::vector<state::ContactState<dim>> &);        \
  template Json variables_part(const scene::Scene &, const shape::Shapes<dim> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::io
