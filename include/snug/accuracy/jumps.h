#ifndef snug_accuracy_jumps_h
#define snug_accuracy_jumps_h

#include <snug/state/state_solver.h>

namespace snug::accuracy {
/// Return how far the copies of each node are apart in column @p j [length]: the square root of the
/// sum of the squares of the changes that make them @p continuous, which is the same on any ranks.
/// Collective.
template <int dim>
typename mesh::BodyMesh<dim>::Field jump(const state::StateSolver<dim> &solver,
                                         const feti::PrimalVectors     &torn,
                                         const feti::PrimalVectors     &continuous,
                                         unsigned int                   j);
} // namespace snug::accuracy

#endif
