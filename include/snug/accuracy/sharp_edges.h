#ifndef snug_accuracy_sharp_edges_h
#define snug_accuracy_sharp_edges_h

#include <snug/state/state_solver.h>

namespace snug::accuracy {
/// A sharp edge of one side of a pair under pressure.
struct SharpEdge
{
  unsigned int              pair; ///< index in Contact::joined_pairs()
  std::vector<unsigned int> rows; ///< contact rows at sharp edges of this side, ascending
  std::string text; ///< message that names the edge and states that its pressure has no limit
};

/**
 * Return the sharp edges of contact sides where the pressure is above half the mean of its pair.
 * The exact pressure is unbounded there. Beside an edge of interior angle alpha it is p ~ r^-s
 * with s > 0 in two cases: the other body is elastic and extends beyond the edge (s = 0.226 for
 * alpha = 90 degrees and equal materials), or the other side is an obstacle and alpha > 90
 * degrees, because an obstacle acts as a plane of symmetry. If both sides end in an edge, they act
 * as one body and no edge is reported. An edge lies between faces whose normals differ by
 * more than 37 degrees. One of these faces is not on the side and is not held as a plane of
 * symmetry. The function returns at most one edge per joined pair. Collective.
 */
template <int dim>
std::vector<SharpEdge> sharp_edges(const state::StateSolver<dim>  &solver,
                                   const state::ContactState<dim> &state);
} // namespace snug::accuracy

#endif
