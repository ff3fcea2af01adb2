#include <snug/sensitivity/combined_gradients.h>

namespace snug::sensitivity {
namespace {
void add(const double factor, const std::vector<double> &values, std::vector<double> &sum)
{
  sum.resize(values.size(), 0.);
  for (unsigned int j = 0; j < values.size(); ++j)
    sum[j] += factor * values[j];
}

/// Compute sum += factor * gradient. The sum is empty at the first call.
template <int dim>
void add(const double factor, const Gradient<dim> &gradient, Gradient<dim> &sum)
{
  sum.method = gradient.method;
  sum.reason = gradient.reason;
  sum.differentiable &= gradient.differentiable;
  add(factor, gradient.values, sum.values);
  if (!gradient.shape)
    return;
  if (!sum.shape)
    sum.shape.emplace(gradient.shape->size());
  for (unsigned int node = 0; node < gradient.shape->size(); ++node)
    (*sum.shape)[node] += factor * (*gradient.shape)[node];
}
} // namespace

template <int dim>
Gradient<dim> weighted_sum(const std::vector<double>        &factors,
                           const std::vector<Gradient<dim>> &gradients,
                           const std::size_t                 first)
{
  Gradient<dim> sum;
  for (std::size_t c = 0; c < factors.size(); ++c)
    add(factors[c], gradients[first + c], sum);
  return sum;
}

template <int dim>
Gradients<dim> combined_gradients(const LoadCases<dim>          &load_cases,
                                  const response::Response<dim> &objective,
                                  const std::vector<double>     &factors,
                                  const MeasuredResponses<dim>  &others)
{
  MeasuredResponses<dim> measured;
  for (unsigned int c = 0; c < load_cases.size(); ++c)
    measured.push_back({&objective, c});
  measured.insert(measured.end(), others.begin(), others.end());
  auto result   = gradients(load_cases, measured);
  auto combined = weighted_sum(factors, result.of_response, 0);
  result.of_response.erase(result.of_response.begin(),
                           result.of_response.begin() + load_cases.size());
  result.of_response.insert(result.of_response.begin(), std::move(combined));
  return result;
}

template <int dim>
OneSided combined_one_sided_gradients(const LoadCases<dim>          &load_cases,
                                      const response::Response<dim> &objective,
                                      const std::vector<double>     &factors)
{
  const RunContext::Timer timer(load_cases.front().solver.context(), "gradient");
  OneSided                result;
  for (unsigned int c = 0; c < load_cases.size(); ++c)
    {
      const auto of_case = one_sided_gradients(load_cases[c], {&objective}).front();
      add(factors[c], of_case.increasing, result.increasing);
      add(factors[c], of_case.decreasing, result.decreasing);
    }
  return result;
}

#define SNUG_INSTANTIATE(dim)                                                            \
  template Gradient<dim>  weighted_sum(const std::vector<double> &,                      \
                                       const std::vector<Gradient<dim>> &, std::size_t); \
  template Gradients<dim> combined_gradients(const LoadCases<dim> &,                     \
                                             const response::Response<dim> &,            \
                                             const std::vector<double> &,                \
                                             const MeasuredResponses<dim> &);            \
  template OneSided       combined_one_sided_gradients(const LoadCases<dim> &,           \
                                                       const response::Response<dim> &,  \
                                                       const std::vector<double> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::sensitivity
