#include <snug/base/gather.h>
#include <snug/base/narrow.h>
#include <snug/feti/couplings.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace snug::feti {
namespace {
void make_unique(std::vector<Coupling> &pairs)
{
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}
} // namespace

void Couplings::insert(const Coupling &pair)
{
  if (pairs.size() == pairs.capacity())
    {
      make_unique(pairs);
      if (pairs.size() >= pairs.capacity() / 2) // do not sort again soon
        pairs.reserve(2 * pairs.size() + 64);
    }
  pairs.push_back(pair);
}

CsrPattern Couplings::unite(const unsigned int n, MPI_Comm comm)
{
  make_unique(pairs);
  std::vector<Coupling> all;
  for (const auto &of_rank : all_gather(comm, pairs))
    all.insert(all.end(), of_rank.begin(), of_rank.end());
  make_unique(all);
  CsrPattern pattern;
  pattern.n_rows = pattern.n_columns = n;
  pattern.row_start.assign(n + 1, 0);
  pattern.columns.reserve(all.size());
  for (const Coupling &pair : all)
    {
      pattern.columns.push_back(narrow<PetscInt>(pair.column));
      pattern.row_start[pair.row + 1] = narrow<PetscInt>(pattern.columns.size());
    }
  // a row without couplings ends where the row before it ends
  for (unsigned int i = 0; i < n; ++i)
    pattern.row_start[i + 1] = std::max(pattern.row_start[i], pattern.row_start[i + 1]);
  return pattern;
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
