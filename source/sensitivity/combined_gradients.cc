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
Gradients<dim> gradients_of_cases(const LoadCases<dim>             &load_cases,
                                  const std::vector<Measured<dim>> &measured)
{
  Gradients<dim> result;
  result.of_response.resize(measured.size());
  for (unsigned int c = 0; c < load_cases.size(); ++c)
    {
      Responses<dim>            responses;
      std::vector<unsigned int> places;
      for (unsigned int i = 0; i < measured.size(); ++i)
        if (measured[i].load_case == c)
          {
            responses.push_back(measured[i].response);
            places.push_back(i);
          }
      auto of_case = gradients(load_cases[c], responses);
      for (unsigned int i = 0; i < places.size(); ++i)
        result.of_response[places[i]] = of_case.of_response[i];
      for (auto &field : of_case.displacement)
        result.displacement.push_back(std::move(field));
      for (auto &forces : of_case.forces)
        result.forces.push_back(std::move(forces));
      result.f_mults += of_case.f_mults;
      result.numeric_factorizations += of_case.numeric_factorizations;
      result.seconds += of_case.seconds;
    }
  return result;
}

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
Gradients<dim> combined_gradients(const LoadCases<dim>             &load_cases,
                                  const response::Response<dim>    &objective,
                                  const std::vector<double>        &factors,
                                  const std::vector<Measured<dim>> &others)
{
  std::vector<Measured<dim>> measured;
  for (unsigned int c = 0; c < load_cases.size(); ++c)
    measured.push_back({&objective, c});
  measured.insert(measured.end(), others.begin(), others.end());
  auto result   = gradients_of_cases(load_cases, measured);
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
  template Gradients<dim> gradients_of_cases(const LoadCases<dim> &,                     \
                                             const std::vector<Measured<dim>> &);        \
  template Gradient<dim>  weighted_sum(const std::vector<double> &,                      \
                                       const std::vector<Gradient<dim>> &, std::size_t); \
  template Gradients<dim> combined_gradients(const LoadCases<dim> &,                     \
                                             const response::Response<dim> &,            \
                                             const std::vector<double> &,                \
                                             const std::vector<Measured<dim>> &);        \
  template OneSided       combined_one_sided_gradients(const LoadCases<dim> &,           \
                                                       const response::Response<dim> &,  \
                                                       const std::vector<double> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::sensitivity
