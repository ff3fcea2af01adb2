#ifndef snug_state_reactions_h
#define snug_state_reactions_h

#include <snug/state/state_solver.h>

namespace snug::state {
/// Sum up what supports do to the bodies and where each pair presses: the
/// reactions and the load of @p state, and of its pairs moment, centre and
/// peak. With all forces on bodies the reactions are in equilibrium.
/// Collective.
template <int dim>
void add_reactions(const StateSolver<dim>     &solver,
                   const RowCoefficients<dim> &rows,
                   ContactState<dim>          &state);
} // namespace snug::state

#endif
