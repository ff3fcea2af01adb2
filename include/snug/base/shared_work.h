#ifndef snug_base_shared_work_h
#define snug_base_shared_work_h

#include <mpi.h>

#include <functional>
#include <vector>

namespace snug {
/**
 * Work that all ranks need the results of: item i, compute(i), is done by one rank only, and its
 * numbers are known to all. Ranks take neighbouring items of about equal sums of @p costs. The
 * results do not depend on the number of ranks. What one rank throws all throw, see everywhere().
 * Collective on @p communicator; compute() must not be.
 */
std::vector<std::vector<double>>
shared_work(MPI_Comm                                                communicator,
            const std::vector<double>                              &costs,
            const std::function<std::vector<double>(unsigned int)> &compute);
} // namespace snug

#endif
