#ifndef snug_base_gather_h
#define snug_base_gather_h

#include <deal.II/base/mpi.h>

#include <numeric>
#include <vector>

namespace snug {
/// Return the objects of all ranks on every rank, or on rank @p root alone, and nothing on other
/// ranks. The functions of deal.II compress objects, which takes longer than sending them. The
/// packed objects of all ranks have less than 2 GB. Collective.
template <typename T>
std::vector<T> gather(MPI_Comm communicator, const T &mine, const unsigned int root, const bool all)
{
  const unsigned int n = dealii::Utilities::MPI::n_mpi_processes(communicator);
  if (n == 1)
    return std::vector<T>(1, mine);
  const auto       packed = dealii::Utilities::pack(mine, false);
  const int        size   = static_cast<int>(packed.size());
  std::vector<int> sizes(n), starts(n + 1, 0);
  MPI_Allgather(&size, 1, MPI_INT, sizes.data(), 1, MPI_INT, communicator);
  std::partial_sum(sizes.begin(), sizes.end(), starts.begin() + 1);
  const bool receives = all || dealii::Utilities::MPI::this_mpi_process(communicator) == root;
  std::vector<char> bytes(receives ? starts[n] : 0);
  if (all)
    MPI_Allgatherv(packed.data(), size, MPI_CHAR, bytes.data(), sizes.data(), starts.data(),
                   MPI_CHAR, communicator);
  else
    MPI_Gatherv(packed.data(), size, MPI_CHAR, bytes.data(), sizes.data(), starts.data(), MPI_CHAR,
                static_cast<int>(root), communicator);
  std::vector<T> result;
  for (unsigned int rank = 0; receives && rank < n; ++rank)
    result.push_back(dealii::Utilities::unpack<T>(bytes.cbegin() + starts[rank],
                                                  bytes.cbegin() + starts[rank + 1], false));
  return result;
}

/// Return the objects of all ranks on every rank. Collective.
template <typename T>
std::vector<T> all_gather(MPI_Comm communicator, const T &mine)
{
  return gather(communicator, mine, 0, true);
}

/// Return the objects of all ranks on rank @p root, and nothing on other ranks. Collective.
template <typename T>
std::vector<T> gather(MPI_Comm communicator, const T &mine, const unsigned int root = 0)
{
  return gather(communicator, mine, root, false);
}
} // namespace snug

#endif
