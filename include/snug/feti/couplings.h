#ifndef snug_feti_couplings_h
#define snug_feti_couplings_h

#include <mpi.h>

#include <set>
#include <utility>
#include <vector>

namespace snug::feti {
/// Row and column of an entry that a replicated matrix has.
using Coupling = std::pair<unsigned int, unsigned int>;

/// The union over ranks, sorted. Collective.
std::vector<Coupling> unite(const std::set<Coupling> &mine, MPI_Comm comm);

/// The order of the sum depends on the number of ranks, and with it the last digits. Collective.
void sum_over_ranks(std::vector<double> &values, MPI_Comm comm);
} // namespace snug::feti

#endif
