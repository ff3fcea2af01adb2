#ifndef snug_sensitivity_load_steps_h
#define snug_sensitivity_load_steps_h

#include <snug/sensitivity/gradient_problem.h>

namespace snug::sensitivity {
/// Return the place among @p load_cases of the load step that load case @p k continues.
template <int dim>
std::optional<unsigned int> step_before(const LoadCases<dim> &load_cases, unsigned int k);

/// Return whether responses need each of @p load_cases: their own, and the load steps before them.
template <int dim>
std::vector<bool> needed_cases(const LoadCases<dim>         &load_cases,
                               const MeasuredResponses<dim> &measured);

/// Return the places in @p measured of the responses of load case @p k, and the responses.
template <int dim>
std::pair<std::vector<unsigned int>, Responses<dim>>
responses_of(const MeasuredResponses<dim> &measured, unsigned int k);

/// Set the rows of x to zero that are not tangential rows of contact.
void keep_tangents(const feti::LoadedProblem &feti, qp::MultiVector &x);

/// Return dJ/d(slip) of the tangential rows in the units of the dual rows, one column per response.
template <int dim>
qp::MultiVector slip_partials(const state::StateSolver<dim>              &solver,
                              const state::ContactState<dim>             &state,
                              const std::vector<response::Partials<dim>> &partials);

/// Return the first @p n rows of x, with zeros for rows that x does not have. The rows of held
/// motions, which differ between the load steps of a sequence, are the last ones.
qp::MultiVector with_rows(const qp::MultiVector &x, unsigned int n);
} // namespace snug::sensitivity

#endif
