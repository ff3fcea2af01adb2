#include <snug/base/rank_order.h>

#include <gtest/gtest.h>

namespace {
using namespace snug;

/// Rank 1 has no bytes; zero bytes are bytes.
std::string bytes_of(const int rank)
{
  return rank == 1 ? "" : std::string(3 + 50000 * (rank % 2), static_cast<char>('a' + rank)) + '\0';
}

class RankOrder : public testing::Test
{
protected:
  RankOrder()
  {
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
    for (int r = 0; r < n_ranks; ++r)
      {
        all += bytes_of(r);
        n_with_bytes += bytes_of(r).empty() ? 0 : 1;
      }
  }

  int         rank, n_ranks, n_with_bytes = 0;
  std::string all;
};

TEST_F(RankOrder, TheFirstRankTakesTheBytesOfAllRanks)
{
  std::string taken;
  int         n_calls = 0;
  collect_in_order(MPI_COMM_WORLD, bytes_of(rank), [&](const std::string &bytes) {
    taken += bytes;
    ++n_calls;
  });
  EXPECT_EQ(taken, rank == 0 ? all : "");
  EXPECT_EQ(n_calls, rank == 0 ? n_with_bytes : 0);
}

TEST_F(RankOrder, EveryRankGetsItsBytesBack)
{
  std::size_t place = 0;
  const auto  mine =
    distribute_in_order(MPI_COMM_WORLD, bytes_of(rank).size(), [&](std::string &bytes) {
      bytes = all.substr(place, bytes.size());
      place += bytes.size();
    });
  EXPECT_EQ(mine, bytes_of(rank));
  EXPECT_EQ(place, rank == 0 ? all.size() : 0);
}
} // namespace
