#ifndef snug_state_reactions_h
#define snug_state_reactions_h

#include <snug/state/state_solver.h>

namespace snug::state {
/// Compute the forces of supports on the bodies and the places where each pair presses. Set the
/// reactions and the load of @p state, moment, centre and peak of its pairs, and the forces and
/// moments of its tied pairs. Each component of the tractions at tied nodes follows from force /
/// area by nodal_pressures(). The reactions are in equilibrium with all forces on bodies.
/// Collective.
template <int dim>
void add_reactions(const StateSolver<dim>     &solver,
                   const RowCoefficients<dim> &rows,
                   ContactState<dim>          &state);
} // namespace snug::state

#endif
