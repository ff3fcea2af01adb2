#ifndef snug_base_shared_work_h
#define snug_base_shared_work_h

#include <mpi.h>

#include <functional>
#include <vector>

namespace snug {
/**
 * Compute work whose results all ranks need. Item i, compute(i), is computed by one rank only, and
 * its numbers are sent to all ranks. Ranks take neighboring items with about equal sums of
 * @p costs. The results do not depend on the number of ranks. If one rank throws, all ranks throw,
 * see throw_collectively(). Collective on @p communicator; compute() must not be collective.
 */
std::vector<std::vector<double>>
shared_work(MPI_Comm                                                communicator,
            const std::vector<double>                              &costs,
            const std::function<std::vector<double>(unsigned int)> &compute);
} // namespace snug

#endif
