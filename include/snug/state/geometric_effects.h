#ifndef snug_state_geometric_effects_h
#define snug_state_geometric_effects_h

#include <snug/state/state_solver.h>

namespace snug::state {
/**
 * Return for each body how the geometric nonlinearity that the linear model leaves out would change
 * its energy. With the Green strain, the energy of a displacement with the gradient G is
 *   W = 1/2 int sigma : eps dV + 1/2 int sigma : G'G dV + ...
 * with the strain eps beyond the thermal one. The energy of GeometricEffect is the ratio of the
 * second integral to the first one, where G is taken without the mean rotation of the body, as far
 * as its supports leave this rotation free. A force that is proportional to a displacement u gets
 * the factor 1 + 3/2 energy, up to terms of order u^2. The first integral counts as at least 1e-3
 * of that of all bodies, because bodies without strain do not matter. Collective.
 */
template <int dim>
std::vector<GeometricEffect> geometric_effects(const StateSolver<dim>  &solver,
                                               const ContactState<dim> &state);
} // namespace snug::state

#endif
