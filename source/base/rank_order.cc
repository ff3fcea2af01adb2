#include <snug/base/rank_order.h>
#include <snug/base/run_context.h>

#include <algorithm>
#include <vector>

namespace snug {
namespace {
/// MPI counts bytes by an int.
const std::size_t largest_message = 1 << 30;

/// Call @p transfer(first byte, number of bytes) for each message.
template <typename Transfer>
void in_messages(const std::size_t size, const Transfer &transfer)
{
  for (std::size_t done = 0; done < size; done += largest_message)
    transfer(done, static_cast<int>(std::min(largest_message, size - done)));
}

void send(MPI_Comm comm, const std::string &bytes, const int to)
{
  in_messages(bytes.size(), [&](const std::size_t first, const int n) {
    MPI_Send(&bytes[first], n, MPI_CHAR, to, 0, comm);
  });
}

void receive(MPI_Comm comm, std::string &bytes, const int from)
{
  in_messages(bytes.size(), [&](const std::size_t first, const int n) {
    MPI_Recv(&bytes[first], n, MPI_CHAR, from, 0, comm, MPI_STATUS_IGNORE);
  });
}

/// Return the sizes of all ranks on rank 0, and nothing on other ranks.
std::vector<unsigned long long> sizes_of_ranks(MPI_Comm comm, const unsigned long long mine)
{
  int rank, n_ranks;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &n_ranks);
  std::vector<unsigned long long> sizes(rank == 0 ? n_ranks : 0);
  MPI_Gather(&mine, 1, MPI_UNSIGNED_LONG_LONG, sizes.data(), 1, MPI_UNSIGNED_LONG_LONG, 0, comm);
  return sizes;
}

/// Return a string on rank 0 that has room for the bytes of any rank.
std::string reserved(const std::vector<unsigned long long> &sizes)
{
  std::string bytes;
  if (sizes.size() > 1)
    bytes.reserve(*std::max_element(sizes.begin() + 1, sizes.end()));
  return bytes;
}
} // namespace

void collect_in_order(MPI_Comm                                        communicator,
                      const std::string                              &mine,
                      const std::function<void(const std::string &)> &take)
{
  int rank;
  MPI_Comm_rank(communicator, &rank);
  const auto  sizes = sizes_of_ranks(communicator, mine.size());
  std::string bytes;
  // Nothing may fail below, because the other ranks wait until their bytes are received.
  throw_collectively(communicator, [&] { bytes = reserved(sizes); });
  if (rank != 0)
    {
      send(communicator, mine, 0);
      return;
    }
  for (std::size_t from = 0; from < sizes.size(); ++from)
    {
      if (sizes[from] == 0)
        continue;
      bytes.resize(from == 0 ? 0 : sizes[from]);
      receive(communicator, bytes, static_cast<int>(from));
      take(from == 0 ? mine : bytes);
    }
}

std::string distribute_in_order(MPI_Comm                                  communicator,
                                const unsigned long long                  size,
                                const std::function<void(std::string &)> &read)
{
  int rank;
  MPI_Comm_rank(communicator, &rank);
  const auto  sizes = sizes_of_ranks(communicator, size);
  std::string mine, bytes;
  throw_collectively(communicator, [&] {
    mine.resize(size);
    bytes = reserved(sizes);
  });
  if (rank == 0)
    read(mine);
  else
    receive(communicator, mine, 0);
  for (std::size_t to = 1; to < sizes.size(); ++to)
    {
      bytes.resize(sizes[to]);
      read(bytes);
      send(communicator, bytes, static_cast<int>(to));
    }
  return mine;
}
} // namespace snug
