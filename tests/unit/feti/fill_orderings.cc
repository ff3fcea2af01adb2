#include <snug/base/blocked_signals.h>
#include <snug/feti/fill_orderings.h>
#include <snug/feti/sparse_factor.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <memory>
#include <thread>

#include <unistd.h>

using namespace snug;

namespace {
/// The five-point Laplacian of n x n points, whose rows are numbered backwards if asked for.
feti::CsrMatrix laplacian(const unsigned int n, const bool backwards = false)
{
  const unsigned int                 N = n * n;
  std::vector<std::vector<PetscInt>> rows(N);
  const auto                         number = [&](unsigned int i, unsigned int j) {
    return backwards ? N - 1 - (i * n + j) : i * n + j;
  };
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n; ++j)
      {
        auto &row = rows[number(i, j)];
        row.push_back(number(i, j));
        if (i > 0)
          row.push_back(number(i - 1, j));
        if (i + 1 < n)
          row.push_back(number(i + 1, j));
        if (j > 0)
          row.push_back(number(i, j - 1));
        if (j + 1 < n)
          row.push_back(number(i, j + 1));
        std::sort(row.begin(), row.end());
      }
  auto A = feti::CsrMatrix::from_rows(rows, N);
  for (unsigned int i = 0; i < N; ++i)
    for (PetscInt p = A.row_start()[i]; p < A.row_start()[i + 1]; ++p)
      A.values[p] = A.columns()[p] == PetscInt(i) ? 4.5 : -1.;
  return A;
}

volatile std::sig_atomic_t n_signals = 0;

void count_signal(int)
{
  n_signals = n_signals + 1;
}
} // namespace

TEST(FillOrderings, AreOnesOfAllRows)
{
  feti::FillOrderings orderings;
  for (const unsigned int n : {1, 2, 13})
    {
      auto rows = orderings.of(*laplacian(n).pattern());
      std::sort(rows.begin(), rows.end());
      ASSERT_EQ(rows.size(), n * n);
      for (unsigned int i = 0; i < rows.size(); ++i)
        EXPECT_EQ(rows[i], PetscInt(i));
    }
  EXPECT_TRUE(orderings.of(feti::CsrPattern()).empty());
}

// Groups of rows that are coupled with each other alone fill in nowhere, whatever the order.
TEST(FillOrderings, LeaveFullBlocksInPlace)
{
  feti::FillOrderings         orderings;
  const std::vector<PetscInt> as_they_are{0, 1, 2, 3, 4};
  const auto blocks = feti::CsrMatrix::from_rows({{0, 2, 4}, {1}, {0, 2, 4}, {3}, {0, 2, 4}}, 5);
  EXPECT_EQ(orderings.of(*blocks.pattern()), as_they_are);
  // a star: its middle has to come after its ends
  const auto star =
    feti::CsrMatrix::from_rows({{0, 1, 2, 3, 4}, {0, 1}, {0, 2}, {0, 3}, {0, 4}}, 5);
  EXPECT_NE(orderings.of(*star.pattern()).front(), 0);
}

TEST(FillOrderings, ArePatternsNotMatrices)
{
  feti::FillOrderings orderings, others;
  auto                A     = laplacian(9);
  const auto         *first = &orderings.of(*A.pattern());
  A.values[0]               = 7.;
  EXPECT_EQ(&orderings.of(*A.pattern()), first);
  EXPECT_NE(&orderings.of(*laplacian(8).pattern()), first);
  // what was asked for before does not matter
  others.of(*laplacian(8).pattern());
  EXPECT_EQ(others.of(*A.pattern()), *first);
}

TEST(FillOrderings, LeaveTheInverseAsItIs)
{
  const auto          A = laplacian(20, true);
  feti::FillOrderings orderings;
  feti::SparseFactor  ordered(A, feti::MatrixKind::kplus, feti::Factorization::CHOLMOD, &orderings),
    other(A, feti::MatrixKind::coarse, feti::Factorization::CHOLMOD);
  qp::MultiVector b(A.n_rows()), x(A.n_rows()), y(A.n_rows());
  for (unsigned int i = 0; i < A.n_rows(); ++i)
    b(i) = 1. + i % 5;
  for (auto *factor : {&ordered, &other})
    factor->factorize(A, "the Laplacian");
  ordered.solve(b, x);
  other.solve(b, y);
  for (unsigned int i = 0; i < A.n_rows(); ++i)
    EXPECT_NEAR(x(i), y(i), 1e-13 * std::abs(y(i)));
}

/// METIS catches SIGTERM: the signal comes as soon as it does, and takes effect when it is done.
TEST(FillOrderings, ASignalWhileMetisWorksIsNotLost)
{
  n_signals         = 0;
  const auto before = std::signal(SIGTERM, count_signal);
  const auto A      = laplacian(200);

  std::atomic<bool> is_over{false}, is_sent{false};
  auto              blocked = std::make_unique<BlockedSignals>(); // for the other thread
  std::thread       sender([&]() {
    struct sigaction now;
    while (!is_over && !is_sent)
      if (sigaction(SIGTERM, nullptr, &now) == 0 && now.sa_handler != count_signal)
        {
          is_sent = true;
          kill(getpid(), SIGTERM);
        }
  });
  blocked.reset();
  feti::FillOrderings orderings;
  EXPECT_NO_THROW(orderings.of(*A.pattern()));
  is_over = true;
  sender.join();
  EXPECT_TRUE(is_sent);
  EXPECT_EQ(n_signals, is_sent ? 1 : 0);
  std::signal(SIGTERM, before);
}
