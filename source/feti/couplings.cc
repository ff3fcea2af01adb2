#include <snug/base/gather.h>
#include <snug/base/narrow.h>
#include <snug/feti/couplings.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace snug::feti {
std::vector<Coupling> unite(const std::set<Coupling> &mine, MPI_Comm comm)
{
  const std::vector<Coupling> of_this_rank(mine.begin(), mine.end());
  std::vector<Coupling>       pairs;
  for (const auto &of_rank : all_gather(comm, of_this_rank))
    pairs.insert(pairs.end(), of_rank.begin(), of_rank.end());
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

void sum_over_ranks(std::vector<double> &values, MPI_Comm comm)
{
  MPI_Allreduce(MPI_IN_PLACE, values.data(), narrow<int>(values.size()), MPI_DOUBLE, MPI_SUM, comm);
}

void sum_over_ranks(qp::MultiVector &values, MPI_Comm comm)
{
  MPI_Allreduce(MPI_IN_PLACE, values.column(0), narrow<int>(values.n_rows() * values.n_columns()),
                MPI_DOUBLE, MPI_SUM, comm);
}
} // namespace snug::feti
