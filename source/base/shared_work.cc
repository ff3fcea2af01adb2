#include <snug/base/narrow.h>
#include <snug/base/run_context.h>
#include <snug/base/shared_work.h>

#include <algorithm>
#include <numeric>

namespace snug {
namespace {
/// Return the first items of the ranks, and the end. An item belongs to the rank whose part of
/// the sum of costs contains the middle of the item's costs.
std::vector<unsigned int> shares(const std::vector<double> &costs, const int n_ranks)
{
  const double              total = std::accumulate(costs.begin(), costs.end(), 0.);
  std::vector<unsigned int> first(1, 0);
  double                    done = 0.;
  for (unsigned int i = 0; i < costs.size(); ++i)
    {
      while (narrow<int>(first.size()) < n_ranks &&
             (done + 0.5 * costs[i]) * n_ranks >= total * double(first.size()))
        first.push_back(i);
      done += costs[i];
    }
  first.resize(std::size_t(n_ranks) + 1, narrow<unsigned int>(costs.size()));
  return first;
}

/// Return the blocks of all ranks, one after the other.
template <typename T>
std::vector<T> gathered(MPI_Comm comm, const std::vector<T> &mine, const MPI_Datatype type)
{
  int n_ranks;
  MPI_Comm_size(comm, &n_ranks);
  const int        n_mine = narrow<int>(mine.size());
  std::vector<int> counts(n_ranks), starts(n_ranks + 1, 0);
  MPI_Allgather(&n_mine, 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
  std::partial_sum(counts.begin(), counts.end(), starts.begin() + 1);
  std::vector<T> all(starts.back());
  MPI_Allgatherv(mine.data(), n_mine, type, all.data(), counts.data(), starts.data(), type, comm);
  return all;
}
} // namespace

std::vector<std::vector<double>>
shared_work(MPI_Comm                                                communicator,
            const std::vector<double>                              &costs,
            const std::function<std::vector<double>(unsigned int)> &compute)
{
  int rank, n_ranks;
  MPI_Comm_rank(communicator, &rank);
  MPI_Comm_size(communicator, &n_ranks);
  const auto                       first = shares(costs, n_ranks);
  std::vector<std::vector<double>> results(costs.size());
  throw_collectively(communicator, [&]() {
    for (unsigned int i = first[rank]; i < first[rank + 1]; ++i)
      results[i] = compute(i);
  });
  if (n_ranks == 1)
    return results;
  std::vector<int>    sizes;
  std::vector<double> numbers;
  for (unsigned int i = first[rank]; i < first[rank + 1]; ++i)
    {
      sizes.push_back(narrow<int>(results[i].size()));
      numbers.insert(numbers.end(), results[i].begin(), results[i].end());
    }
  sizes      = gathered(communicator, sizes, MPI_INT);
  numbers    = gathered(communicator, numbers, MPI_DOUBLE);
  auto place = numbers.cbegin();
  for (unsigned int i = 0; i < results.size(); place += sizes[i], ++i)
    results[i].assign(place, place + sizes[i]);
  return results;
}
} // namespace snug
