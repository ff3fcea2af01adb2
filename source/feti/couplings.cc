#include <snug/base/narrow.h>
#include <snug/feti/couplings.h>

#include <algorithm>

namespace snug::feti {
std::vector<Coupling> unite(const std::set<Coupling> &mine, MPI_Comm comm)
{
  std::vector<unsigned int> flat;
  for (const Coupling &pair : mine)
    {
      flat.push_back(pair.first);
      flat.push_back(pair.second);
    }
  int n_ranks, count = narrow<int>(flat.size());
  MPI_Comm_size(comm, &n_ranks);
  std::vector<int> counts(n_ranks), starts(n_ranks + 1, 0);
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
  for (int r = 0; r < n_ranks; ++r)
    starts[r + 1] = starts[r] + counts[r];
  std::vector<unsigned int> all(starts.back());
  MPI_Allgatherv(flat.data(), count, MPI_UNSIGNED, all.data(), counts.data(), starts.data(),
                 MPI_UNSIGNED, comm);
  std::vector<Coupling> pairs;
  for (std::size_t i = 0; i < all.size(); i += 2)
    pairs.emplace_back(all[i], all[i + 1]);
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

void sum_over_ranks(std::vector<double> &values, MPI_Comm comm)
{
  MPI_Allreduce(MPI_IN_PLACE, values.data(), narrow<int>(values.size()), MPI_DOUBLE, MPI_SUM, comm);
}
} // namespace snug::feti
