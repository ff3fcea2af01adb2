#ifndef snug_accuracy_jumps_h
#define snug_accuracy_jumps_h

#include <snug/state/state_solver.h>

namespace snug::accuracy {
/// Return the jump at each node between its copies in column @p j [length]: the square root of the
/// sum of the squares of the changes from @p torn to @p continuous. The jump does not depend on
/// the number of ranks. Collective.
template <int dim>
mesh::Field<dim> jump(const state::StateSolver<dim> &solver,
                      const feti::PrimalVectors     &torn,
                      const feti::PrimalVectors     &continuous,
                      unsigned int                   j);
} // namespace snug::accuracy

#endif
