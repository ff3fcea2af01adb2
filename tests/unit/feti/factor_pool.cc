#include <snug/base/errors.h>
#include <snug/base/petsc_handle.h>
#include <snug/feti/factor_pool.h>

#include <gtest/gtest.h>

namespace {
using namespace snug;

/// Tridiagonal, n x n.
feti::CsrMatrix chain(const unsigned int n, const double diagonal)
{
  std::vector<std::vector<PetscInt>> rows(n);
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = i > 0 ? i - 1 : 0; j < std::min(i + 2, n); ++j)
      rows[i].push_back(j);
  auto A = feti::CsrMatrix::from_rows(rows, n);
  for (unsigned int i = 0; i < n; ++i)
    for (const PetscInt j : rows[i])
      A.values[A.position(i, j)] = PetscInt(i) == j ? diagonal : -1.;
  return A;
}

/// A^-1 of ones, its first entry.
double first_entry(const feti::SparseFactor &factor, const unsigned int n)
{
  qp::MultiVector b(n), x(n);
  for (unsigned int i = 0; i < n; ++i)
    b(i) = 1.;
  factor.solve(b, x);
  return x(0);
}

class FactorPool : public ::testing::Test
{
protected:
  FactorPool() { petsc::return_errors(); }
  ~FactorPool() override { PetscPopErrorHandler(); }

  Work             work;
  feti::FactorPool pool{feti::MatrixKind::coarse, feti::Factorization::CHOLMOD, nullptr, &work};
};

TEST_F(FactorPool, EqualMatricesShareAFactor)
{
  const auto first = pool.factorize(chain(5, 3.), "A"), second = pool.factorize(chain(5, 3.), "A"),
             third = pool.factorize(chain(5, 4.), "A"), other = pool.factorize(chain(6, 3.), "A");
  EXPECT_EQ(first, second);
  EXPECT_NE(first, third);
  EXPECT_NE(first, other);
  EXPECT_EQ(work.numeric_factorizations, 3u);
  EXPECT_EQ(work.symbolic_factorizations, 3u);
  EXPECT_NE(first_entry(*first, 5), first_entry(*third, 5));
}

TEST_F(FactorPool, WhatIsNotUsedServesTheNextOfItsPattern)
{
  auto       first = pool.factorize(chain(5, 3.), "A");
  const auto held  = pool.factorize(chain(5, 4.), "A");
  const auto value = first_entry(*first, 5), of_held = first_entry(*held, 5);
  first.reset();
  first = pool.factorize(chain(5, 5.), "A");
  EXPECT_EQ(work.symbolic_factorizations, 2u);
  EXPECT_EQ(first_entry(*held, 5), of_held);
  // that of 3 is gone, that of 5 is not
  first.reset();
  first = pool.factorize(chain(5, 5.), "A");
  EXPECT_EQ(work.numeric_factorizations, 3u);
  first.reset();
  first = pool.factorize(chain(5, 3.), "A");
  EXPECT_EQ(work.numeric_factorizations, 4u);
  EXPECT_EQ(work.symbolic_factorizations, 2u);
  EXPECT_EQ(first_entry(*first, 5), value);
}

TEST_F(FactorPool, AFailureIsNoFactor)
{
  for (unsigned int attempt = 0; attempt < 2; ++attempt)
    EXPECT_THROW(pool.factorize(chain(5, -3.), "A"), SolveError);
  EXPECT_NO_THROW(pool.factorize(chain(5, 3.), "A"));
  EXPECT_EQ(work.symbolic_factorizations, 1u);
}

TEST_F(FactorPool, FactorsOutliveThePool)
{
  std::shared_ptr<const feti::SparseFactor> factor;
  {
    const feti::FactorPool brief(feti::MatrixKind::coarse);
    factor = brief.factorize(chain(5, 3.), "A");
  }
  EXPECT_EQ(first_entry(*factor, 5), first_entry(*pool.factorize(chain(5, 3.), "A"), 5));
}

TEST(SharedPatterns, AreOneForEqualMatrices)
{
  feti::SharedPatterns patterns;
  const auto           A = patterns.of(chain(5, 3.)), B = patterns.of(chain(5, 4.)),
             C = patterns.of(chain(6, 3.));
  EXPECT_EQ(A.pattern(), B.pattern());
  EXPECT_NE(A.pattern(), C.pattern());
  EXPECT_EQ(B.values, chain(5, 4.).values);
}
} // namespace
