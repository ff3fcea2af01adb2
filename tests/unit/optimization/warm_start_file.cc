#include <snug/base/errors.h>
#include <snug/optimization/warm_start_file.h>

#include <gtest/gtest.h>

#include "warm_problem.h"

using namespace snug;
using namespace snug::optimization;

namespace {
std::string bytes_of(const int rank)
{
  return std::string(rank == 1 ? 0 : 100 * rank + 1, static_cast<char>(rank));
}
} // namespace

TEST(WarmStartFile, IsOneFileFromWhichEveryRankReadsItsBytes)
{
  const Folder      folder;
  const std::string path = folder.path + "/warm-start.0";
  for (const char *end : {"", "again"})
    {
      const std::string mine = bytes_of(this_rank()) + end;
      write_warm_start(MPI_COMM_WORLD, path, [&] { return mine; });
      EXPECT_EQ(read_warm_start(MPI_COMM_WORLD, path), mine);
    }
  const std::filesystem::directory_iterator files(folder.path);
  EXPECT_EQ(std::distance(begin(files), end(files)), 1);
}

TEST(WarmStartFile, IsNotReadInPartsNorOnOtherRanks)
{
  const Folder      folder;
  const std::string path = folder.path + "/warm-start.1";
  EXPECT_FALSE(read_warm_start(MPI_COMM_WORLD, path));
  write_warm_start(MPI_COMM_WORLD, path, [] { return bytes_of(this_rank()); });
  if (n_all_ranks() > 1)
    {
      EXPECT_FALSE(read_warm_start(MPI_COMM_SELF, path));
    }
  MPI_Barrier(MPI_COMM_WORLD);
  const auto size = std::filesystem::file_size(path);
  for (const auto kept : {size + 1, size - 1, std::uintmax_t(8), std::uintmax_t(0)})
    {
      MPI_Barrier(MPI_COMM_WORLD);
      if (this_rank() == 0)
        std::filesystem::resize_file(path, kept);
      EXPECT_FALSE(read_warm_start(MPI_COMM_WORLD, path)) << kept;
    }
}

TEST(WarmStartFile, EveryRankHearsOfFailure)
{
  EXPECT_THROW(write_warm_start(MPI_COMM_WORLD, "/nowhere/warm-start.0", [] { return "x"; }),
               InputError);
}
