#include <snug/app/sensitivity.h>
#include <snug/io/shape_export.h>
#include <snug/sensitivity/bound_derivatives.h>
#include <snug/sensitivity/methods.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <ostream>

namespace snug::app {
using sensitivity::Derivatives;
using By = sensitivity::Method;

namespace {
void print_table(std::ostream &out, const std::vector<io::Summary::GradientRow> &rows)
{
  const int name_width = 20, width = 17;
  out << std::left << std::setw(name_width) << "method" << std::right;
  for (const auto &row : rows)
    out << std::setw(width + 2) << row.method;
  const auto line = [&](const std::string &name, const auto &value) {
    out << '\n' << std::left << std::setw(name_width) << name << std::right;
    for (const auto &row : rows)
      if (const auto number = value(row); std::isnan(1. * number))
        out << "  " << std::setw(width) << "";
      else
        out << "  " << std::setw(width) << number;
  };
  const auto precision = out.precision(9);
  for (unsigned int j = 0; j < rows.front().values.size(); ++j)
    line("dJ/dalpha_" + std::to_string(j), [&](const auto &row) { return row.values[j]; });
  out.precision(3);
  line("u' against direct", [](const auto &row) { return row.displacement_difference; });
  line("relative step", [](const auto &row) { return row.step; });
  line("F-mults", [](const auto &row) { return row.f_mults; });
  line("factorizations", [](const auto &row) { return row.numeric_factorizations; });
  line("seconds", [](const auto &row) { return row.seconds; });
  out << std::endl;
  out.precision(precision);
}
} // namespace

template <int dim>
Sensitivity<dim>::Sensitivity(ShapeProblem<dim> &problem,
                              Results<dim>      &results,
                              const States      &states)
  : problem(problem), results(results), states(states)
{
  choose_method();
  const bool  has_potential = problem.solver->has_potential();
  const auto &load_cases    = problem.solver->model().load_cases;
  const bool  with_steps    = std::any_of(load_cases.begin(), load_cases.end(),
                                          [](const auto &of) { return of.after.has_value(); });
  bool        one_sided     = sensitivity::needs_solve(*problem.objective, has_potential) &&
                   std::any_of(states.begin(), states.end(),
                               [](const auto &state) { return state.weak_contacts > 0; });
  if (one_sided)
    results.warn_of_weak_contacts(states);
  // Increments over load steps and of Tresca's bounds are not known.
  one_sided = one_sided && !with_steps && !sensitivity::has_bounds(*problem.solver, states.front());
  for (const Method &method : methods())
    {
      // before differences, which leave the solver at another design
      if (one_sided && method.parameters.method == By::finite_differences)
        {
          add_one_sided();
          one_sided = false;
        }
      add(method);
    }
  if (one_sided)
    add_one_sided();
  for (const auto &row : gradient.methods)
    if (row.method == to_text(chosen))
      static_cast<io::Summary::GradientRow &>(gradient) = row;
  print_table(problem.context.out(Verbosity::quiet), gradient.methods);
}

template <int dim>
void Sensitivity<dim>::choose_method()
{
  const auto &given = problem.scene.gradient.method;
  // adjoint and direct solve nothing for what depends on the geometry alone
  const bool needs_no_solve =
    !problem.objective->needs_solution() && (given == By::adjoint || given == By::direct);
  if (given && !needs_no_solve)
    {
      chosen = *given;
      return;
    }
  const auto choice =
    sensitivity::cheapest_methods<dim>({problem.objective.get()}, problem.shapes->n_variables(),
                                       problem.solver->has_potential())
      .front();
  chosen          = choice.method;
  gradient.reason = choice.reason;
  problem.context.out() << "gradient method: " << to_text(chosen) << " (" << to_text(given) << "; "
                        << choice.reason << ")" << std::endl;
}

template <int dim>
std::vector<typename Sensitivity<dim>::Method> Sensitivity<dim>::methods() const
{
  const auto &given = problem.scene.gradient;
  const auto  by    = [&](const By method, const Derivatives derivatives) {
    Method result{to_text(method), given};
    result.parameters.method      = method;
    result.parameters.derivatives = derivatives;
    return result;
  };
  if (!given.compare)
    return {by(chosen, given.derivatives)};
  const auto         &response = *problem.objective;
  std::vector<Method> list;
  if (!sensitivity::needs_solve(response, problem.solver->has_potential()))
    list.push_back(by(By::energy, Derivatives::exact));
  if (response.needs_solution())
    {
      list.push_back(by(By::adjoint, Derivatives::exact));
      list.push_back(by(By::direct, Derivatives::exact));
      list.push_back(by(By::direct, given.derivatives == Derivatives::exact ? Derivatives::central
                                                                            : given.derivatives));
      list.back().name = "semi-analytic";
    }
  list.push_back(by(By::finite_differences, Derivatives::exact));
  return list;
}

template <int dim>
void Sensitivity<dim>::add(const Method &method)
{
  problem.context.progress("gradient by " + method.name + " ...");
  const auto result = sensitivity::combined_gradients(
    problem.load_cases(states, problem.shapes->start(), method.parameters), *problem.objective,
    problem.combined_objective(states).factors, {});
  const auto              &of_objective = result.of_response.front();
  io::Summary::GradientRow row;
  row.method                 = method.name;
  row.f_mults                = result.f_mults;
  row.numeric_factorizations = result.numeric_factorizations;
  row.seconds                = result.seconds;
  row.values                 = of_objective.values;
  row.differentiable         = of_objective.differentiable;
  if (method.parameters.method == By::finite_differences)
    row.step = method.parameters.step;
  else if (method.parameters.derivatives != Derivatives::exact)
    row.step = method.parameters.semi_analytic_step;
  if (method.parameters.method == By::direct && reference.empty())
    reference = result.displacement;
  else if (!result.displacement.empty() && !reference.empty())
    row.displacement_difference = displacement_difference(result.displacement);
  if (method.name == to_text(chosen))
    shape_gradient = of_objective.shape;
  gradient.methods.push_back(row);
}

template <int dim>
void Sensitivity<dim>::add_one_sided()
{
  const double        start  = problem.context.seconds();
  const unsigned long before = problem.context.work.f_mults;
  const auto          found  = sensitivity::combined_one_sided_gradients(
    problem.load_cases(states, problem.shapes->start(), problem.scene.gradient), *problem.objective,
    problem.combined_objective(states).factors);
  io::Summary::GradientRow row; // each is half of the work
  row.f_mults = (problem.context.work.f_mults - before) / 2;
  row.seconds = (problem.context.seconds() - start) / 2;
  row.method  = "one-sided, up";
  row.values  = found.increasing;
  gradient.methods.push_back(row);
  row.method = "one-sided, down";
  row.values = found.decreasing;
  gradient.methods.push_back(row);
}

template <int dim>
double Sensitivity<dim>::displacement_difference(const std::vector<Field> &derivatives) const
{
  const auto        &mesh    = *problem.mesh;
  const unsigned int rank    = problem.context.rank();
  double             sums[2] = {0., 0.};
  for (unsigned int j = 0; j < reference.size(); ++j)
    for (unsigned int node = 0; node < reference[j].size(); ++node)
      if (mesh.owner(node) == rank)
        {
          const auto &expected = reference[j][node];
          sums[0] += (derivatives[j][node] - expected).norm_square();
          sums[1] += expected.norm_square();
        }
  MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, problem.context.communicator());
  return std::sqrt(sums[0] / sums[1]);
}

template <int dim>
void Sensitivity<dim>::write_all(const std::string &path) const
{
  // The gradient of the objective is known. Each other response is differentiated by the method
  // that is cheapest for it, unless the scene names a method for all.
  const auto                         &scene = problem.scene;
  std::vector<std::string>            names = {scene.optimization.objective};
  std::vector<std::vector<double>>    all   = {gradient.values};
  sensitivity::MeasuredResponses<dim> measured;
  for (unsigned int c = 0; c < problem.n_load_cases(); ++c)
    for (unsigned int i = 0; i < problem.responses.size(); ++i)
      if (const auto &name = scene.responses[i].name; name != scene.optimization.objective)
        {
          names.push_back((problem.n_load_cases() == 1 ? "" : scene.load_cases[c].name + ".") +
                          name);
          measured.push_back({problem.responses[i].get(), c});
        }
  if (!measured.empty())
    {
      for (const auto &state : states)
        problem.solver->restore(state);
      auto parameters           = scene.gradient;
      parameters.shape_gradient = false;
      if (parameters.method == By::energy)
        parameters.method.reset();
      const auto found =
        sensitivity::gradients(problem.load_cases(states, problem.shapes->start(), parameters),
                               measured);
      for (const auto &of_response : found.of_response)
        all.push_back(of_response.values);
    }
  const auto points = problem.shapes->control_points(problem.shapes->start());
  throw_collectively(problem.context.communicator(), [&]() {
    if (problem.context.rank() == 0)
      io::write_gradients(path, points, names, all);
  });
}

template class Sensitivity<2>;
template class Sensitivity<3>;
} // namespace snug::app
