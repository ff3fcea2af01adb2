#ifndef snug_accuracy_underresolved_contact_h
#define snug_accuracy_underresolved_contact_h

#include <snug/state/state_solver.h>

namespace snug::accuracy {
/// Gap relative to the face size below which a pair without a force is checked for contact.
constexpr double small_gap = 0.1;

/**
 * Return the slave faces that are too large for the estimates to be meaningful. These are the
 * faces of patches that are not light and are less than @p across faces wide, and the faces beside
 * them. For a pair without a force, they are the faces at which the gap is almost closed. The
 * result contains indices into the surface of @p solver, ascending. If it is empty, the estimates
 * may be trusted. Collective.
 */
template <int dim>
std::vector<unsigned int> underresolved_contact(const state::StateSolver<dim>  &solver,
                                                const state::ContactState<dim> &state,
                                                double                          across);
} // namespace snug::accuracy

#endif
