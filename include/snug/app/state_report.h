#ifndef snug_app_state_report_h
#define snug_app_state_report_h

#include <snug/accuracy/sharp_edges.h>
#include <snug/app/shape_problem.h>

namespace snug::app {
/**
 * Print what an engineer needs of a state: forces, pressures, displacements and whether the
 * solution passed its check; with Verbosity::debug also moments, the work of the solver and the
 * errors of the check one by one. Components of forces and moments that are round-off are 0.
 * Collective.
 */
template <int dim>
void print_state(const ShapeProblem<dim> &problem, const state::ContactState<dim> &state);

/// Print the forces of the pairs and supports of a state, with the largest pressures of the pairs
/// and their places. Collective.
template <int dim>
void print_forces(const ShapeProblem<dim> &problem, const state::ContactState<dim> &state);

/// Return ", at a sharp edge, where the exact pressure has no limit" if the largest pressure of
/// @p pair of @p state is at one of the @p edges of accuracy::sharp_edges(), else an empty text.
template <int dim>
std::string edge_remark(const std::vector<accuracy::SharpEdge> &edges,
                        const state::ContactState<dim>         &state,
                        const state::PairState<dim>            &pair);

/// Return a vector as "(1 0 -2)", where components below 1e-6 of @p scale are round-off.
template <int n>
std::string vector_text(const dealii::Tensor<1, n> &vector, double scale);
} // namespace snug::app

#endif
