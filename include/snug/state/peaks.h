#ifndef snug_state_peaks_h
#define snug_state_peaks_h

#include <snug/state/state_solver.h>

namespace snug::state {
/**
 * Return the maximum von Mises stress of each body at the Gauss points of the stiffness. Among
 * points whose stresses differ by round-off alone, such as points that mirror each other, the place
 * is the first point along a fixed direction, so that it does not depend on the ranks. Stresses are
 * compared with yield stresses at the same points. The pairs of @p state are read. Collective.
 */
template <int dim>
std::vector<StressPeak<dim>> stress_peaks(const StateSolver<dim>  &solver,
                                          const ContactState<dim> &state);

/// Return the displacement of the node that moves farthest. Among nodes whose displacements differ
/// by round-off alone, it is the first one along the direction of stress_peaks(). Collective.
template <int dim>
DisplacementPeak<dim> displacement_peak(const ContactState<dim> &state, MPI_Comm communicator);
} // namespace snug::state

#endif
