#ifndef snug_app_state_report_h
#define snug_app_state_report_h

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
} // namespace snug::app

#endif
