#include <snug/base/assertions.h>
#include <snug/base/narrow.h>
#include <snug/sensitivity/load_steps.h>

#include <algorithm>

namespace snug::sensitivity {
template <int dim>
std::optional<unsigned int> step_before(const LoadCases<dim> &load_cases, const unsigned int k)
{
  const auto &problem = load_cases[k];
  const auto &after   = problem.solver.model().load_cases[problem.state.load_case].after;
  if (!after)
    return {};
  for (unsigned int other = 0; other < k; ++other)
    if (load_cases[other].state.load_case == *after)
      return other;
  SNUG_ASSERT(false, "the step before a load step is missing");
  return {};
}

template <int dim>
std::vector<bool> needed_cases(const LoadCases<dim>         &load_cases,
                               const MeasuredResponses<dim> &measured)
{
  std::vector<bool> needed(load_cases.size(), false);
  for (const auto &[response, load_case] : measured)
    needed[load_case] = true;
  for (unsigned int k = narrow<unsigned int>(load_cases.size()); k-- > 0;)
    if (const auto before = step_before(load_cases, k); needed[k] && before)
      needed[*before] = true;
  return needed;
}

/// Set the rows of x to zero that are not tangential rows of contact.
void keep_tangents(const feti::LoadedProblem &feti, qp::MultiVector &x)
{
  for (unsigned int j = 0; j < x.n_columns(); ++j)
    for (unsigned int i = 0; i < x.n_rows(); ++i)
      if (!feti.linearization().contact_rows()[i] || feti.bounded()[i])
        x(i, j) = 0.;
}

/// Return the places in @p measured of the responses of load case @p k, and the responses.
template <int dim>
std::pair<std::vector<unsigned int>, Responses<dim>>
responses_of(const MeasuredResponses<dim> &measured, const unsigned int k)
{
  std::pair<std::vector<unsigned int>, Responses<dim>> result;
  for (unsigned int i = 0; i < measured.size(); ++i)
    if (measured[i].load_case == k)
      {
        result.first.push_back(i);
        result.second.push_back(measured[i].response);
      }
  return result;
}

/// Return dJ/d(slips) of the tangential rows in the units of the dual rows, one column per
/// response.
template <int dim>
qp::MultiVector slip_partials(const state::StateSolver<dim>              &solver,
                              const state::ContactState<dim>             &state,
                              const std::vector<response::Partials<dim>> &partials)
{
  const auto        &gluing     = solver.gluing(state.load_case);
  const auto        &of_contact = gluing.contact_of_row();
  const unsigned int n = gluing.n_contact_rows(), k = narrow<unsigned int>(partials.size());
  qp::MultiVector    result(narrow<unsigned int>(of_contact.size()), k);
  for (unsigned int j = 0; j < k; ++j)
    for (unsigned int i = 0; !partials[j].slips.empty() && i < of_contact.size(); ++i)
      if (of_contact[i] >= n && of_contact[i] < n + partials[j].slips.size())
        // The row of B is divided by its scale.
        result(i, j) =
          partials[j].slips[of_contact[i] - n] * gluing.contact_scales()[of_contact[i]];
  return result;
}

qp::MultiVector with_rows(const qp::MultiVector &x, const unsigned int n)
{
  qp::MultiVector result(n, x.n_columns());
  for (unsigned int j = 0; j < x.n_columns(); ++j)
    std::copy_n(x.column(j), std::min(n, x.n_rows()), result.column(j));
  return result;
}

#define SNUG_INSTANTIATE(dim)                                                                      \
  template std::optional<unsigned int> step_before(const LoadCases<dim> &, unsigned int);          \
  template std::vector<bool> needed_cases(const LoadCases<dim> &, const MeasuredResponses<dim> &); \
  template std::pair<std::vector<unsigned int>, Responses<dim>> responses_of(                      \
    const MeasuredResponses<dim> &, unsigned int);                                                 \
  template qp::MultiVector slip_partials(const state::StateSolver<dim> &,                          \
                                         const state::ContactState<dim> &,                         \
                                         const std::vector<response::Partials<dim>> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::sensitivity
