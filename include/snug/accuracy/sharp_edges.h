#ifndef snug_accuracy_sharp_edges_h
#define snug_accuracy_sharp_edges_h

#include <snug/state/state_solver.h>

namespace snug::accuracy {
/// A sharp edge of one side of a pair under pressure.
struct SharpEdge
{
  unsigned int              pair; ///< of Contact::joined_pairs()
  std::vector<unsigned int> rows; ///< contact rows at sharp edges of this side, ascending
  std::string               text; ///< which edge, and that its pressure has no limit
};

/**
 * Sharp edges of contact sides where the pressure is above half the mean of its pair. The pressure
 * of the true bodies is unbounded there: beside an edge of interior angle alpha it is
 * p ~ r^-s, s > 0, if the other body is elastic and goes on (s = 0.226 for alpha = 90 degrees and
 * equal materials), or if it is an obstacle and alpha > 90 degrees; an obstacle acts as a plane of
 * symmetry. Where both sides end in an edge they are as one body. An edge is one of faces whose
 * normals differ by more than 37 degrees, of which one is not of the side and is not held as a
 * plane of symmetry. At most one per joined pair. Collective.
 */
template <int dim>
std::vector<SharpEdge> sharp_edges(const state::StateSolver<dim>  &solver,
                                   const state::ContactState<dim> &state);
} // namespace snug::accuracy

#endif
