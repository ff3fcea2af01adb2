#include "dense.h"

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

using snug::qp::MultiVector;

namespace {
/// x * C by the definition.
MultiVector product_by_loops(const MultiVector &x, const MultiVector &C)
{
  MultiVector y(x.n_rows(), C.n_columns());
  for (unsigned int i = 0; i < x.n_rows(); ++i)
    for (unsigned int j = 0; j < C.n_columns(); ++j)
      for (unsigned int k = 0; k < x.n_columns(); ++k)
        y(i, j) += x(i, k) * C(k, j);
  return y;
}
} // namespace

TEST(MultiVector, AddsProductsLikeLoops)
{
  std::mt19937 generator(1);
  for (const unsigned int n_columns : {1u, 3u})
    {
      const auto  x = dense::random(7, 4, generator);
      const auto  C = dense::random(4, n_columns, generator);
      MultiVector y = dense::random(7, n_columns, generator);
      MultiVector z = y;
      y.add_product(-2., x, C);
      z.add(-2., product_by_loops(x, C));
      EXPECT_LT(dense::distance(y, z), 1e-14);
    }
}

TEST(MultiVector, AppendsAndTakesColumns)
{
  std::mt19937 generator(2);
  const auto   x = dense::random(5, 2, generator);
  const auto   y = dense::random(5, 3, generator);
  MultiVector  both(5, 0);
  both.append(x);
  both.append(y);
  ASSERT_EQ(both.n_columns(), 5u);
  EXPECT_EQ(dense::distance(both.columns_from(0, 2), x), 0.);
  EXPECT_EQ(dense::distance(both.columns_from(2, 3), y), 0.);
  EXPECT_EQ(both.columns_from(5, 0).n_columns(), 0u);
}

TEST(MultiVector, EmptySizesDoNothing)
{
  MultiVector none(0, 2), no_columns(3, 0), y(3, 2);
  none.add_product(1., MultiVector(0, 4), MultiVector(4, 2));
  y.add_product(1., no_columns, MultiVector(0, 2));
  EXPECT_EQ(dense::largest(y), 0.);
  EXPECT_EQ(inner_products(no_columns, y, MPI_COMM_WORLD).n_rows(), 0u);
}

TEST(MultiVector, ReducesOverRanksOfWhichSomeAreEmpty)
{
  // rank r owns r rows, all ones: sums are 0 + 1 + ... = R (R - 1) / 2
  const unsigned int rank    = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  const double       n_rows  = n_ranks * (n_ranks - 1) / 2;
  for (const unsigned int n_columns : {1u, 2u})
    {
      MultiVector X(rank, 2), Y(rank, n_columns);
      for (unsigned int i = 0; i < rank; ++i)
        {
          X(i, 0) = 1.;
          X(i, 1) = 2.;
          for (unsigned int j = 0; j < n_columns; ++j)
            Y(i, j) = 3. + j;
        }
      const auto products = inner_products(X, Y, MPI_COMM_WORLD);
      ASSERT_EQ(products.n_rows(), 2u);
      ASSERT_EQ(products.n_columns(), n_columns);
      for (unsigned int j = 0; j < n_columns; ++j)
        {
          EXPECT_EQ(products(0, j), n_rows * (3. + j));
          EXPECT_EQ(products(1, j), n_rows * 2. * (3. + j));
        }
      EXPECT_DOUBLE_EQ(norms(X, MPI_COMM_WORLD)[1], 2. * std::sqrt(n_rows));
    }
}
