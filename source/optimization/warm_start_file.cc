#include <snug/base/errors.h>
#include <snug/base/rank_order.h>
#include <snug/base/run_context.h>
#include <snug/optimization/warm_start_file.h>

#include <filesystem>
#include <fstream>
#include <numeric>
#include <vector>

namespace snug::optimization {
namespace {
using Number = unsigned long long;

void write(std::ofstream &file, const std::vector<Number> &numbers)
{
  file.write(reinterpret_cast<const char *>(numbers.data()),
             static_cast<std::streamsize>(numbers.size() * sizeof(Number)));
}

void read(std::ifstream &file, std::vector<Number> &numbers)
{
  file.read(reinterpret_cast<char *>(numbers.data()),
            static_cast<std::streamsize>(numbers.size() * sizeof(Number)));
}

/// Read the numbers of bytes of all ranks. Return whether the file is complete and of so many
/// ranks.
bool read_sizes(std::ifstream &file, const std::string &path, std::vector<Number> &sizes)
{
  std::vector<Number> n_ranks(1, 0);
  read(file, n_ranks);
  read(file, sizes);
  std::error_code error;
  const Number    size = std::filesystem::file_size(path, error);
  const Number    head = (1 + sizes.size()) * sizeof(Number);
  return file && !error && n_ranks[0] == sizes.size() &&
         size == std::accumulate(sizes.begin(), sizes.end(), head);
}
} // namespace

void write_warm_start(MPI_Comm                            communicator,
                      const std::string                  &path,
                      const std::function<std::string()> &of_this_rank)
{
  int rank, n_ranks;
  MPI_Comm_rank(communicator, &rank);
  MPI_Comm_size(communicator, &n_ranks);
  const std::string   temporary = path + ".new";
  std::string         bytes;
  std::vector<Number> numbers;
  std::ofstream       file;
  throw_collectively(communicator, [&] {
    bytes = of_this_rank();
    if (rank != 0)
      return;
    numbers.resize(1 + n_ranks, n_ranks);
    file.open(temporary, std::ios::binary);
  });
  const Number mine = bytes.size();
  MPI_Gather(&mine, 1, MPI_UNSIGNED_LONG_LONG, numbers.data() + (rank == 0), 1,
             MPI_UNSIGNED_LONG_LONG, 0, communicator);
  write(file, numbers);
  collect_in_order(communicator, bytes, [&](const std::string &of_rank) { file << of_rank; });
  throw_collectively(communicator, [&] {
    if (rank != 0)
      return;
    file.close();
    std::error_code error;
    std::filesystem::rename(temporary, path, error);
    if (!file || error)
      throw InputError("cannot write " + path);
  });
}

std::optional<std::string> read_warm_start(MPI_Comm communicator, const std::string &path)
{
  int rank, n_ranks;
  MPI_Comm_rank(communicator, &rank);
  MPI_Comm_size(communicator, &n_ranks);
  std::vector<Number> sizes(rank == 0 ? n_ranks : 0);
  std::ifstream       file;
  int                 good = 1;
  if (rank == 0)
    {
      file.open(path, std::ios::binary);
      good = read_sizes(file, path, sizes);
    }
  MPI_Bcast(&good, 1, MPI_INT, 0, communicator);
  if (!good)
    return {};
  Number mine = 0;
  MPI_Scatter(sizes.data(), 1, MPI_UNSIGNED_LONG_LONG, &mine, 1, MPI_UNSIGNED_LONG_LONG, 0,
              communicator);
  auto bytes = distribute_in_order(communicator, mine, [&](std::string &of_rank) {
    file.read(of_rank.data(), static_cast<std::streamsize>(of_rank.size()));
  });
  good       = rank != 0 || file;
  MPI_Bcast(&good, 1, MPI_INT, 0, communicator);
  return good ? std::optional(bytes) : std::nullopt;
}
} // namespace snug::optimization
