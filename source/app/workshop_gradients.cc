#include <snug/app/workshop.h>

#include <algorithm>
#include <cmath>

namespace snug::app {
namespace {
/// sum += factor * gradient, begun with an empty sum.
template <int dim>
void add(const double                      factor,
         const sensitivity::Gradient<dim> &gradient,
         sensitivity::Gradient<dim>       &sum)
{
  const bool begins = sum.method.empty();
  sum.method        = gradient.method;
  sum.reason        = gradient.reason;
  sum.differentiable &= gradient.differentiable;
  sum.values.resize(gradient.values.size(), 0.);
  for (unsigned int j = 0; j < sum.values.size(); ++j)
    sum.values[j] += factor * gradient.values[j];
  if (!gradient.shape)
    return;
  if (begins)
    sum.shape.emplace(gradient.shape->size());
  for (unsigned int node = 0; node < gradient.shape->size(); ++node)
    (*sum.shape)[node] += factor * (*gradient.shape)[node];
}
} // namespace

template <int dim>
optimization::Combined
Workshop<dim>::combined_objective(const std::vector<state::ContactState<dim>> &states)
{
  std::vector<double> values, weights;
  double              largest = 0.;
  for (const auto &state : states)
    {
      values.push_back(objective->value(*solver, state));
      weights.push_back(scene.load_cases.empty() ? 1. : scene.load_cases[state.load_case].weight);
      largest = std::max(largest, std::abs(weights.back() * values.back()));
    }
  if (objective_scale == 0.)
    objective_scale = largest;
  return choose(optimization::combination_table(), scene.optimization.combine)
    .make(values, weights, objective_scale);
}

template <int dim>
std::vector<double> Workshop<dim>::bound_widths() const
{
  std::vector<double> widths;
  for (unsigned int i = 0; i < basis->n_variables(); ++i)
    widths.push_back(basis->upper_bounds()[i] - basis->lower_bounds()[i]);
  return widths;
}

template <int dim>
sensitivity::Gradients<dim>
Workshop<dim>::gradients(const std::vector<state::ContactState<dim>> &states,
                         const std::vector<Measured>                 &others,
                         const std::vector<double>                   &design,
                         const sensitivity::GradientParameters       &parameters)
{
  const auto                  widths  = bound_widths();
  const auto                  factors = combined_objective(states).factors;
  sensitivity::Gradients<dim> result;
  result.of_response.resize(1 + others.size());
  for (unsigned int c = 0; c < states.size(); ++c)
    {
      sensitivity::Responses<dim> responses = {objective.get()};
      std::vector<unsigned int>   places;
      for (unsigned int i = 0; i < others.size(); ++i)
        if (others[i].load_case == c)
          {
            responses.push_back(others[i].response);
            places.push_back(1 + i);
          }
      auto of_case =
        sensitivity::gradients<dim>({*solver, *basis, states[c], design, widths, parameters},
                                    responses);
      add(factors[c], of_case.of_response[0], result.of_response[0]);
      for (unsigned int i = 0; i < places.size(); ++i)
        result.of_response[places[i]] = of_case.of_response[1 + i];
      for (auto &field : of_case.displacement)
        result.displacement.push_back(std::move(field));
      result.f_mults += of_case.f_mults;
      result.numeric_factorizations += of_case.numeric_factorizations;
      result.seconds += of_case.seconds;
    }
  return result;
}

template <int dim>
sensitivity::OneSided
Workshop<dim>::one_sided_gradients(const std::vector<state::ContactState<dim>> &states,
                                   const std::vector<double>                   &design)
{
  const RunContext::Timer   timer(context, "gradient");
  const auto                widths  = bound_widths();
  const auto                factors = combined_objective(states).factors;
  const std::vector<double> zero(design.size(), 0.);
  sensitivity::OneSided     result{zero, zero};
  for (unsigned int c = 0; c < states.size(); ++c)
    {
      const auto of_case = sensitivity::one_sided_gradients<dim>({*solver, *basis, states[c],
                                                                  design, widths, scene.gradient},
                                                                 {objective.get()})
                             .front();
      for (unsigned int j = 0; j < design.size(); ++j)
        {
          result.increasing[j] += factors[c] * of_case.increasing[j];
          result.decreasing[j] += factors[c] * of_case.decreasing[j];
        }
    }
  return result;
}

#define SNUG_INSTANTIATE(dim)                                                     \
  template optimization::Combined Workshop<dim>::combined_objective(              \
    const std::vector<state::ContactState<dim>> &);                               \
  template std::vector<double>         Workshop<dim>::bound_widths() const;       \
  template sensitivity::Gradients<dim> Workshop<dim>::gradients(                  \
    const std::vector<state::ContactState<dim>> &, const std::vector<Measured> &, \
    const std::vector<double> &, const sensitivity::GradientParameters &);        \
  template sensitivity::OneSided Workshop<dim>::one_sided_gradients(              \
    const std::vector<state::ContactState<dim>> &, const std::vector<double> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::app
