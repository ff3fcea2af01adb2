#include <snug/app/analyses.h>

namespace snug::app {
template <int dim>
Analyses<dim>::Analyses(ShapeProblem<dim> &problem)
  : problem(problem), starts(problem.shapes->first_steps())
{}

template <int dim>
Analysis<dim> &Analyses<dim>::solve(const Design &design, const bool is_cold)
{
  current = Analysis<dim>{design, problem.solve(design, is_cold ? std::vector<qp::WarmStart>()
                                                                : starts.at(design))};
  std::vector<qp::MultiVector> forces;
  for (const auto &state : current->states)
    forces.push_back(state.dual.lambda);
  starts.add(design, std::move(forces));
  return *current;
}

template <int dim>
Analysis<dim> &Analyses<dim>::at(const Design &design)
{
  if (!last(design))
    current = Analysis<dim>{design, problem.solve(design, starts.at(design))};
  return *current;
}

template <int dim>
const sensitivity::Gradients<dim> &
Analyses<dim>::gradients(const Design                              &design,
                         const sensitivity::MeasuredResponses<dim> &measured,
                         const sensitivity::GradientParameters     &parameters)
{
  auto &analysis = at(design);
  if (analysis.gradients.of_response.empty() || !(analysis.measured == measured))
    {
      analysis.gradients =
        sensitivity::gradients(problem.load_cases(analysis.states, design, parameters), measured);
      analysis.measured = measured;
    }
  // The solver may have been at another design since, for example at the first one.
  for (const auto &state : analysis.states)
    problem.solver->restore(state);
  return analysis.gradients;
}

template <int dim>
const typename Analyses<dim>::States &Analyses<dim>::first_states()
{
  if (of_first.empty())
    of_first = problem.solve(problem.shapes->start());
  return of_first;
}

template <int dim>
void Analyses<dim>::pair(const Design &design)
{
  problem.solver->pair(problem.positions(design));
  current.reset();
  of_first.clear();
  starts.clear();
}

template <int dim>
bool Analyses<dim>::remember(const std::string &bytes)
{
  std::vector<unsigned int> n_owned; // per load case
  for (unsigned int c = 0; c < problem.n_load_cases(); ++c)
    n_owned.push_back(problem.solver->gluing(c).layout().n_owned());
  return starts.read(bytes, n_owned);
}

template class Analyses<2>;
template class Analyses<3>;
} // namespace snug::app
