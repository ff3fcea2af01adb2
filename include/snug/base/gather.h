#ifndef snug_base_gather_h
#define snug_base_gather_h

#include <snug/base/narrow.h>
#include <snug/base/run_context.h>

#include <deal.II/base/mpi.h>

#include <functional>
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

/// Send the object of rank 0 to all ranks and return it. The packed object has less than 2 GB.
/// Collective.
template <typename T>
T broadcast(MPI_Comm communicator, const T &object)
{
  const bool        is_first = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
  std::vector<char> bytes;
  if (is_first)
    bytes = dealii::Utilities::pack(object, false);
  int size = narrow<int>(bytes.size());
  MPI_Bcast(&size, 1, MPI_INT, 0, communicator);
  bytes.resize(size);
  MPI_Bcast(bytes.data(), size, MPI_CHAR, 0, communicator);
  return is_first ? object : dealii::Utilities::unpack<T>(bytes, false);
}

/// Return the object that @p work makes on rank 0 on every rank. Errors are thrown on every rank.
/// Collective; @p work must not be collective.
template <typename Work>
auto made_on_first_rank(MPI_Comm communicator, const Work &work)
{
  decltype(work()) result;
  throw_collectively(communicator, [&]() {
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      result = work();
  });
  return broadcast(communicator, result);
}

/// Return the object that rank 0 makes for this rank. Rank 0 makes one object after the other, so
/// that it never holds all of them. A packed object has less than 2 GB. Collective.
template <typename T>
T scatter(MPI_Comm communicator, const std::function<T(unsigned int rank)> &make)
{
  const int tag = 0;
  if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
    {
      for (unsigned int rank = 1; rank < dealii::Utilities::MPI::n_mpi_processes(communicator);
           ++rank)
        {
          const auto packed = dealii::Utilities::pack(make(rank), false);
          MPI_Send(packed.data(), narrow<int>(packed.size()), MPI_CHAR, static_cast<int>(rank), tag,
                   communicator);
        }
      return make(0);
    }
  MPI_Status status;
  MPI_Probe(0, tag, communicator, &status);
  int size;
  MPI_Get_count(&status, MPI_CHAR, &size);
  std::vector<char> bytes(size);
  MPI_Recv(bytes.data(), size, MPI_CHAR, 0, tag, communicator, MPI_STATUS_IGNORE);
  return dealii::Utilities::unpack<T>(bytes, false);
}
} // namespace snug

#endif
