#include <snug/base/errors.h>
#include <snug/base/shared_work.h>

#include <gtest/gtest.h>

#include <numeric>

namespace {
using namespace snug;

/// Item i has i % 3 numbers.
std::vector<double> item(const unsigned int i)
{
  std::vector<double> numbers(i % 3);
  std::iota(numbers.begin(), numbers.end(), 0.1 * i);
  return numbers;
}

TEST(SharedWork, IsKnownToAllRanksWhateverItCosts)
{
  for (const unsigned int n : {0, 1, 2, 17})
    for (const double slope : {0., 1., -1., 100.})
      {
        std::vector<double> costs;
        for (unsigned int i = 0; i < n; ++i)
          costs.push_back(slope < 0. ? 0. : 1. + slope * i);
        unsigned int done    = 0;
        const auto   results = shared_work(MPI_COMM_WORLD, costs, [&](const unsigned int i) {
          ++done;
          return item(i);
        });
        ASSERT_EQ(results.size(), n);
        for (unsigned int i = 0; i < n; ++i)
          EXPECT_EQ(results[i], item(i));
        // each by one rank
        MPI_Allreduce(MPI_IN_PLACE, &done, 1, MPI_UNSIGNED, MPI_SUM, MPI_COMM_WORLD);
        EXPECT_EQ(done, n);
      }
}

TEST(SharedWork, OfEqualItemsIsSharedEvenly)
{
  int n_ranks;
  MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
  unsigned int done = 0;
  shared_work(MPI_COMM_WORLD, std::vector<double>(12, 2.), [&](const unsigned int i) {
    ++done;
    return item(i);
  });
  EXPECT_EQ(done, 12 / n_ranks);
}

TEST(SharedWork, FailsOnAllRanks)
{
  const auto work = [](const unsigned int i) {
    if (i == 3)
      throw SolveError("item 3");
    return item(i);
  };
  EXPECT_THROW(shared_work(MPI_COMM_WORLD, std::vector<double>(9, 1.), work), SolveError);
}
} // namespace
