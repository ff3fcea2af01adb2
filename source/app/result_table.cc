#include <snug/app/result_table.h>
#include <snug/app/state_report.h>

#include <algorithm>
#include <iomanip>
#include <map>
#include <sstream>

namespace snug::app {
namespace {
/// Names and units of values of every state in the table.
const std::map<std::string, std::pair<std::string, std::string>> maxima = {
  {"max_pressure", {"largest nodal pressure", "force/length^2"}},
  {"max_von_mises", {"largest von Mises stress", "force/length^2"}},
  {"max_displacement", {"largest displacement", "length"}}};

/// Forces of at most so many load cases are printed; `load_cases.csv` has those of all.
const unsigned int most_forces = 3;

/// A row of the table.
struct Row
{
  std::string name, first, last, remark;
};

/// Return a number with 6 digits. Numbers below 1e-6 of @p scale are round-off.
std::string text_of(const double number, const double scale)
{
  std::ostringstream text;
  text << std::setprecision(6) << (std::abs(number) <= 1e-6 * scale ? 0. : number);
  return text.str();
}

Row make_row(const std::string &name,
             const double       first,
             const double       last,
             const std::string &unit,
             const std::string &remark    = "",
             const double       of_others = 0.)
{
  const double scale = std::max({std::abs(first), std::abs(last), of_others});
  return {name, text_of(first, scale), text_of(last, scale) + unit, remark};
}

template <int dim>
std::string remark_of(const typename Objective<dim>::ConstraintValue &constraint)
{
  std::string remark = "limit " + text_of(constraint.limit, 0.);
  if (constraint.violation > 0. && text_of(constraint.violation, 1.) != "0")
    remark += ", violated by " + text_of(100. * constraint.violation, 0.) + " %";
  else
    remark += constraint.is_active ? ", active" : ", not active";
  return remark;
}

/// Return the change of the objective, such as "5.2 % lower".
std::string change_of(const double first, const double last)
{
  if (first == 0. || first == last)
    return "not changed";
  std::ostringstream text;
  text << std::setprecision(3) << 100. * std::abs((last - first) / first) << " % "
       << (last < first ? "lower" : "higher");
  return text.str();
}

/// Return the quantity of a response, or nothing if this is its name.
std::string quantity_of(const scene::Scene &scene, const std::string &response)
{
  const auto quantity = scene::response_called(scene, response)->quantity;
  return quantity == response ? "" : quantity;
}

/// Return where a state has the value that is called as in `maxima`.
template <int dim>
std::string place_of(const ShapeProblem<dim>        &problem,
                     const state::ContactState<dim> &state,
                     const std::string              &name)
{
  const double extent = state.displacement_peak.extent;
  if (name == "max_von_mises")
    return "at " + vector_text(state.stress_peak().place, extent);
  if (name == "max_displacement")
    return "at " + vector_text(state.displacement_peak.position, extent);
  for (const auto &pair : state.pairs)
    if (pair.max_pressure == state.max_pressure)
      return "at " + vector_text(pair.peak, extent) +
             edge_remark(accuracy::sharp_edges(*problem.solver, state), state, pair);
  return "";
}

void print(std::ostream &out, const std::vector<Row> &rows)
{
  std::size_t name = 0, first = 0, last = 0;
  for (const auto &row : rows)
    {
      name  = std::max(name, row.name.size());
      first = std::max(first, row.first.size());
      last  = std::max(last, row.last.size());
    }
  for (const auto &row : rows)
    {
      std::ostringstream line;
      line << "  " << std::left << std::setw(int(name)) << row.name << "  " << std::setw(int(first))
           << row.first << "  " << std::setw(int(last)) << row.last;
      if (!row.remark.empty())
        line << "  " << row.remark;
      const auto text = line.str();
      out << text.substr(0, text.find_last_not_of(' ') + 1) << '\n';
    }
  out << std::flush;
}
} // namespace

template <int dim>
void print_result_table(const Search<dim>                        &search,
                        const optimization::Evaluation           &first,
                        const optimization::Evaluation           &last,
                        const typename ShapeProblem<dim>::States &states)
{
  const auto       &scene     = search.problem.scene;
  const auto       &objective = scene.optimization.objective;
  std::vector<Row>  rows      = {{"", "first design", "last design", ""}};
  const std::string combined  = to_text(scene.optimization.combine);
  const bool        is_one    = search.problem.n_load_cases() == 1;
  const std::string quantity  = quantity_of(scene, objective);
  rows.push_back(make_row(is_one ? objective : combined + " of " + objective, first.objective,
                          last.objective, scene::unit_after_number(scene, objective),
                          "objective" + (quantity.empty() ? "" : " (" + quantity + ')') +
                            ", minimized: " + change_of(first.objective, last.objective)));
  const auto constraints = search.objective.constraint_values(first.reported, last.reported);
  for (const auto &constraint : constraints)
    rows.push_back(make_row(constraint.name, constraint.initial, constraint.value, constraint.unit,
                            remark_of<dim>(constraint)));
  const auto        names = search.problem.value_names();
  const Units       units(scene.units);
  const std::size_t n_values = names.size() / search.problem.n_load_cases();
  for (std::size_t i = 0; i < names.size(); ++i)
    {
      const auto start  = is_one ? 0 : names[i].find('.') + 1;
      const auto prefix = names[i].substr(0, start), response = names[i].substr(start);
      const auto maximum = maxima.find(response);
      const auto add     = [&](const std::string &name, const std::string &unit) {
        double largest = 0.; // of the response in all load cases
        for (std::size_t k = i % n_values; k < names.size(); k += n_values)
          largest = std::max({largest, std::abs(first.reported[k]), std::abs(last.reported[k])});
        rows.push_back(make_row(name, first.reported[i], last.reported[i], unit, "", largest));
      };
      const auto &state = states[i * states.size() / names.size()];
      if (maximum != maxima.end() && first.reported[i] == 0. && last.reported[i] == 0.)
        continue; // a model without contact
      if (maximum != maxima.end())
        {
          add(prefix + maximum->second.first, units.after_number(maximum->second.second));
          rows.back().remark = place_of(search.problem, state, response);
        }
      else if ((!is_one || response != objective) &&
               std::none_of(constraints.begin(), constraints.end(), [&](const auto &constraint) {
                 return constraint.name.rfind(names[i] + ' ', 0) == 0;
               }))
        {
          add(names[i], scene::unit_after_number(scene, response));
          rows.back().remark = quantity_of(scene, response);
        }
    }
  for (const auto &error : search.results.errors())
    rows.push_back(
      {(is_one ? "" : scene.load_cases[error.load_case].name + '.') + "discretization error", "",
       text_of(100. * error.energy.relative, 0.) + " %", "estimated, in the energy norm"});
  print(search.problem.context.out(Verbosity::quiet), rows);
  auto &out = search.problem.context.out();
  for (const auto &state : states)
    if (states.size() <= most_forces)
      {
        out << "forces of the last design"
            << (is_one ? "" : " in load case " + scene.load_cases[state.load_case].name) << ":\n";
        print_forces(search.problem, state);
      }
}

#define SNUG_INSTANTIATE(dim)                                                             \
  template void print_result_table(const Search<dim> &, const optimization::Evaluation &, \
                                   const optimization::Evaluation &,                      \
                                   const ShapeProblem<dim>::States &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::app
