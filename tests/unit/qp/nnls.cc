#include "dense.h"

#include <snug/base/errors.h>
#include <snug/qp/nnls.h>

#include <gtest/gtest.h>

#include <limits>

using snug::qp::MultiVector;
using snug::qp::nnls;

namespace {
double norm(const MultiVector &x)
{
  return snug::qp::norms(x, MPI_COMM_SELF)[0];
}

/// The smallest ||A x - b|| over all subsets of columns whose least squares
/// solution is not negative.
double smallest_by_enumeration(const MultiVector &A, const MultiVector &b)
{
  double best = norm(b);
  for (unsigned int set = 1; set < 1u << A.n_columns(); ++set)
    {
      MultiVector part(A.n_rows(), 0);
      for (unsigned int j = 0; j < A.n_columns(); ++j)
        if (set >> j & 1)
          part.append(A.columns_from(j, 1));
      const auto T = dense::transpose(part);
      const auto y =
        dense::product(dense::pseudo_inverse(dense::product(T, part)), dense::product(T, b));
      bool allowed = true;
      for (unsigned int j = 0; j < y.n_rows(); ++j)
        allowed = allowed && y(j) >= -1e-12;
      MultiVector residual = b;
      residual.add_product(-1., part, y);
      if (allowed)
        best = std::min(best, norm(residual));
    }
  return best;
}

void expect_optimal(const MultiVector &A, const MultiVector &b)
{
  const auto  solution = nnls(A, b);
  MultiVector residual = b;
  residual.add_product(-1., A, solution.x);
  EXPECT_LT(dense::distance(residual, solution.residual), 1e-13);
  const auto slopes = dense::product(dense::transpose(A), residual);
  for (unsigned int j = 0; j < A.n_columns(); ++j)
    {
      EXPECT_GE(solution.x(j), 0.);
      EXPECT_LT(slopes(j), 1e-11);
      EXPECT_NEAR(slopes(j) * solution.x(j), 0., 1e-11);
    }
}
} // namespace

TEST(Nnls, EqualsEnumeration)
{
  std::mt19937 generator(1);
  for (unsigned int trial = 0; trial < 40; ++trial)
    {
      const auto A = dense::random(3 + trial % 3, 7, generator);
      const auto b = dense::random(3 + trial % 3, 1, generator);
      expect_optimal(A, b);
      EXPECT_NEAR(norm(nnls(A, b).residual), smallest_by_enumeration(A, b), 1e-12);
    }
}

TEST(Nnls, ManyColumnsOfDifferentLengths)
{
  std::mt19937 generator(2);
  auto         A = dense::random(60, 1500, generator);
  for (unsigned int j = 0; j < A.n_columns(); ++j)
    for (unsigned int i = 0; i < A.n_rows(); ++i)
      A(i, j) = (A(i, j) + (i == 0 ? 8. : 0.)) * std::pow(10., -double(j % 4));
  MultiVector b(60);
  b(0) = 1.; // inside the cone
  EXPECT_LT(norm(nnls(A, b).residual), 1e-12);
  b(0)            = -1.; // opposite to every column
  const auto away = nnls(A, b);
  EXPECT_EQ(dense::largest(away.x), 0.);
  b(0) = 0.; // near the cone's boundary
  b(1) = 1.;
  expect_optimal(A, b);
}

TEST(Nnls, DependentAndZeroColumns)
{
  std::mt19937 generator(3);
  const auto   one = dense::random(5, 3, generator);
  MultiVector  A(5, 0);
  A.append(one);
  A.append(one);
  A.append(MultiVector(5, 2));
  MultiVector opposite(5, 3); // a free variable is a pair of columns
  opposite.add(-1., one);
  A.append(opposite);
  const auto b = dense::random(5, 1, generator);
  expect_optimal(A, b);
  // least squares without signs
  const auto  T        = dense::transpose(one);
  MultiVector residual = b;
  residual.add_product(-1., one, dense::solve(dense::product(T, one), dense::product(T, b)));
  EXPECT_NEAR(norm(nnls(A, b).residual), norm(residual), 1e-12);
}

TEST(Nnls, TippingLoad)
{
  // supports at x = 0 and 1 push up; forces and moments (1, x)
  MultiVector A(2, 2), b(2);
  A(0, 0) = A(0, 1) = A(1, 1) = 1.;
  b(0)                        = 1.;
  b(1)                        = 0.3;
  EXPECT_LT(norm(nnls(A, b).residual), 1e-14);
  b(1)            = 1.2; // beyond the right support: turns about it
  const auto tips = nnls(A, b).residual;
  EXPECT_GT(norm(tips), 0.1);
  EXPECT_NEAR(tips(0) + tips(1), 0., 1e-14); // no motion at x = 1
}

TEST(Nnls, EmptyAndNotFinite)
{
  MultiVector b(3);
  b(1) = 2.;
  EXPECT_EQ(norm(nnls(MultiVector(3, 0), b).residual), 2.);
  EXPECT_EQ(norm(nnls(MultiVector(3, 4), MultiVector(3)).residual), 0.);
  b(0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(nnls(MultiVector(3, 4), b), snug::SolveError);
}

TEST(Shortest, MeetsItsConditionsWithTheLeastLength)
{
  // y_1 >= 2, y_1 + y_2 >= 3, y_2 >= -1 and their multiples: (2, 1)
  for (const double unit : {1e-9, 1., 1e6})
    {
      MultiVector  A(2, 3), b(3);
      const double rows[3][3] = {{1., 0., 2.}, {5., 5., 15.}, {0., 0.1, -0.1}};
      for (unsigned int j = 0; j < 3; ++j)
        {
          A(0, j) = rows[j][0];
          A(1, j) = rows[j][1];
          b(j)    = unit * rows[j][2];
        }
      const auto y = snug::qp::shortest(A, b);
      EXPECT_NEAR(y(0), 2. * unit, 1e-12 * unit);
      EXPECT_NEAR(y(1), 1. * unit, 1e-12 * unit);
    }
}

TEST(Shortest, IsZeroWhereThatMeetsAllConditions)
{
  MultiVector A(3, 2), b(2);
  A(0, 0) = A(2, 1) = 1.;
  b(0)              = -0.5;
  EXPECT_EQ(norm(snug::qp::shortest(A, b)), 0.);
  EXPECT_EQ(norm(snug::qp::shortest(MultiVector(3, 0), MultiVector(0))), 0.);
}
