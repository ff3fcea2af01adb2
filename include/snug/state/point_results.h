#ifndef snug_state_point_results_h
#define snug_state_point_results_h

#include <snug/state/state_solver.h>

namespace snug::state {
/// Return the motions q of all reference points (ReferencePoints) in a column of @p u, on all
/// ranks. Collective.
template <int dim>
std::vector<std::vector<double>>
point_motions(const StateSolver<dim> &solver, const feti::PrimalVectors &u, unsigned int column);

/// @name Motions of all reference points, one after the other, on the rank that has their
/// subdomains; zero on other ranks
/// @{
/// Return the motions in all columns of @p u.
template <int dim>
qp::MultiVector own_point_motions(const StateSolver<dim> &solver, const feti::PrimalVectors &u);

/// Add @p motions to the motions in @p u.
template <int dim>
void add_point_motions(const StateSolver<dim> &solver,
                       const qp::MultiVector  &motions,
                       feti::PrimalVectors    &u);
/// @}

/// Set the motions of the reference points and the forces of their supports, and add these forces
/// to the reactions of @p state. Collective.
/// @throws SolveError where supports part a face from the point that it follows.
template <int dim>
void add_points(const StateSolver<dim> &solver, ContactState<dim> &state);
} // namespace snug::state

#endif
