#ifndef snug_accuracy_trust_h
#define snug_accuracy_trust_h

#include <snug/state/state_solver.h>

namespace snug::accuracy {
/// A pair without a force is looked at more closely where its gap is below this part of a face.
constexpr double small_gap = 0.1;

/**
 * Slave faces that are too large for estimates to mean anything: those of patches that are not
 * light and less than @p across faces wide, and the faces beside them; of a pair without a force,
 * those where it is all but closed. Indices into the surface of @p solver, ascending; empty: the
 * estimates may be trusted. Collective.
 */
template <int dim>
std::vector<unsigned int> doubtful_faces(const state::StateSolver<dim>  &solver,
                                         const state::ContactState<dim> &state,
                                         double                          across);
} // namespace snug::accuracy

#endif
