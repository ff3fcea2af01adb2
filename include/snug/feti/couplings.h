#ifndef snug_feti_couplings_h
#define snug_feti_couplings_h

#include <mpi.h>

#include <set>
#include <utility>
#include <vector>

namespace snug::feti {
/// Row and column of an entry in the pattern of a replicated matrix.
using Coupling = std::pair<unsigned int, unsigned int>;

/// Return the union of the couplings of all ranks, sorted. Collective.
std::vector<Coupling> unite(const std::set<Coupling> &mine, MPI_Comm comm);

/// Sum @p values over ranks. The order of the summation depends on the number of ranks, and with it
/// the last digits of the result. Collective.
void sum_over_ranks(std::vector<double> &values, MPI_Comm comm);
} // namespace snug::feti

#endif
