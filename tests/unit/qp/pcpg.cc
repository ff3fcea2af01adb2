#include "membranes.h"

#include <snug/qp/independent_columns.h>
#include <snug/qp/pcpg.h>

#include <gtest/gtest.h>

#include <numeric>

using namespace snug::qp;

namespace {
DenseData linear_data(unsigned int n, unsigned int n_kernel, unsigned int seed)
{
  std::mt19937 generator(seed);
  DenseData    data;
  const auto   V = dense::random(n, n, generator);
  data.F         = dense::product(V, dense::transpose(V));
  for (unsigned int i = 0; i < n; ++i)
    data.F(i, i) += 1.;
  data.G = dense::random(n_kernel, n, generator);
  data.d = dense::Matrix(n);
  data.e = dense::Matrix(n_kernel);
  data.bounded.assign(n, 0);
  return data;
}

/// P_M (b - F lambda) = 0 with G lambda = 0, lambda = 0 off M, by LU.
dense::Matrix solve_directly(const DenseData &data, const RowSet &rows, const dense::Matrix &b)
{
  const unsigned int n = data.F.n_rows(), m = data.G.n_rows();
  dense::Matrix      A(n + m, n + m), right(n + m, b.n_columns());
  for (unsigned int i = 0; i < n; ++i)
    if (!rows[i])
      A(i, i) = 1.;
    else
      {
        for (unsigned int k = 0; k < b.n_columns(); ++k)
          right(i, k) = b(i, k);
        for (unsigned int j = 0; j < n; ++j)
          A(i, j) = data.F(i, j);
        for (unsigned int j = 0; j < m; ++j)
          A(i, n + j) = A(n + j, i) = data.G(j, i);
      }
  const auto    x = dense::solve(A, right);
  dense::Matrix lambda(n, b.n_columns());
  for (unsigned int k = 0; k < b.n_columns(); ++k)
    std::copy(x.column(k), x.column(k) + n, lambda.column(k));
  return lambda;
}

RowSet every_row_but_fifths(unsigned int n)
{
  RowSet rows(n, 1);
  for (unsigned int i = 0; i < n; i += 5)
    rows[i] = 0;
  return rows;
}

struct Solved
{
  dense::Matrix lambda;
  KrylovResult  result;
  unsigned long f_mults;
};

/// From lambda = 0, tolerances relative to the right-hand sides.
Solved solve_with_pcpg(const DenseProblem  &problem,
                       const RowSet        &rows,
                       const dense::Matrix &b,
                       double               tolerance)
{
  const auto  free_set = problem.free_set(problem.slice(rows));
  MultiVector lambda(problem.n_owned(), b.n_columns());
  MultiVector residual   = problem.slice(b);
  auto        tolerances = norms(residual, MPI_COMM_WORLD);
  for (double &size : tolerances)
    size *= tolerance;
  const auto before = problem.context().work.f_mults;
  const auto result = pcpg(problem, *free_set, lambda, residual, tolerances, 500);
  const auto mults  = problem.context().work.f_mults - before;
  // the residual returned belongs to the solution returned
  MultiVector check = problem.slice(b);
  check.add(-1., problem.apply(lambda));
  EXPECT_LT(dense::distance(check, residual), 1e-11 * dense::largest(b));
  return {problem.gather(lambda), result, mults};
}
} // namespace

TEST(Pcpg, SolvesOnAFace)
{
  const DenseProblem problem(linear_data(40, 3, 1));
  const RowSet       rows = every_row_but_fifths(40);
  std::mt19937       generator(2);
  const auto         b      = dense::random(40, 1, generator);
  const auto         solved = solve_with_pcpg(problem, rows, b, 1e-13);
  EXPECT_TRUE(solved.result.converged);
  // eigenvalues of F are between 1 and 100
  EXPECT_LT(dense::distance(solved.lambda, solve_directly(problem.data, rows, b)), 1e-11);
  // conjugate gradients end after 32 - 3 steps, but for rounding
  EXPECT_LE(solved.result.iterations, 30u);
  EXPECT_EQ(solved.f_mults, solved.result.iterations);
}

TEST(Pcpg, BlockEqualsSingleSolves)
{
  const DenseProblem problem(linear_data(40, 3, 3));
  const RowSet       rows = every_row_but_fifths(40);
  std::mt19937       generator(4);
  auto               b = dense::random(40, 5, generator);
  for (unsigned int i = 0; i < 40; ++i)
    b(i, 2) *= 1e-6; // sizes differ
  const auto   block   = solve_with_pcpg(problem, rows, b, 1e-11);
  unsigned int singles = 0;
  EXPECT_TRUE(block.result.converged);
  for (unsigned int j = 0; j < 5; ++j)
    {
      const auto b_j    = b.columns_from(j, 1);
      const auto single = solve_with_pcpg(problem, rows, b_j, 1e-11);
      singles += single.f_mults;
      EXPECT_LT(dense::distance(block.lambda.columns_from(j, 1), single.lambda),
                1e-9 * dense::largest(b_j));
    }
  // the columns share one space of 29 dimensions
  EXPECT_LE(block.f_mults, 31u);
  EXPECT_LT(block.f_mults, singles / 2);
}

TEST(Pcpg, DependentColumnsCostNothing)
{
  const DenseProblem problem(linear_data(40, 3, 5));
  const RowSet       rows(40, 1);
  std::mt19937       generator(6);
  const auto         two = dense::random(40, 2, generator);
  dense::Matrix      b(40, 0);
  b.append(two);
  b.append(two.columns_from(0, 1)); // twice
  b.append(dense::Matrix(40));      // zero
  dense::Matrix sum(40);
  sum.add(2., two.columns_from(0, 1));
  sum.add(-1., two.columns_from(1, 1));
  b.append(sum);
  const auto all  = solve_with_pcpg(problem, rows, b, 1e-10);
  const auto some = solve_with_pcpg(problem, rows, two, 1e-10);
  EXPECT_TRUE(all.result.converged);
  EXPECT_LT(dense::distance(all.lambda, solve_directly(problem.data, rows, b)), 1e-8);
  EXPECT_EQ(dense::largest(all.lambda.columns_from(3, 1)), 0.);
  EXPECT_LE(all.f_mults, some.f_mults + 2);
}

TEST(Pcpg, ConvergedColumnsLeaveTheBlock)
{
  const DenseProblem problem(linear_data(40, 3, 7));
  const auto         free_set = problem.free_set(problem.slice(RowSet(40, 1)));
  std::mt19937       generator(8);
  MultiVector        lambda(problem.n_owned(), 3);
  MultiVector        residual = problem.slice(dense::random(40, 3, generator));
  const auto         result   = pcpg(problem, *free_set, lambda, residual, {1e3, 1e-8, 1e3}, 500);
  EXPECT_TRUE(result.converged);
  EXPECT_EQ(problem.context().work.f_mults, result.iterations);
}

TEST(Pcpg, EndsAtRoundOff)
{
  const DenseProblem problem(linear_data(40, 3, 9));
  std::mt19937       generator(10);
  const auto         b      = dense::random(40, 2, generator);
  const auto         solved = solve_with_pcpg(problem, RowSet(40, 1), b, 1e-40);
  // sizes of b are about 4, norms of F lambda not much larger
  for (const double size : solved.result.residual_norms)
    EXPECT_LT(size, 1e-13);
  EXPECT_LE(solved.result.iterations, 100u);
}

TEST(Pcpg, EndsAfterTheIterationsAllowed)
{
  const DenseProblem problem(linear_data(40, 3, 11));
  const auto         free_set = problem.free_set(problem.slice(RowSet(40, 1)));
  std::mt19937       generator(12);
  MultiVector        lambda(problem.n_owned(), 1);
  MultiVector        residual = problem.slice(dense::random(40, 1, generator));
  const auto         result   = pcpg(problem, *free_set, lambda, residual, {1e-8}, 3);
  EXPECT_FALSE(result.converged);
  EXPECT_EQ(result.iterations, 3u);
  EXPECT_EQ(problem.context().work.f_mults, 3u);
}

TEST(Pcpg, ContinuesWithTheSameDirections)
{
  const DenseProblem problem(linear_data(40, 3, 13));
  const auto         free_set = problem.free_set(problem.slice(RowSet(40, 1)));
  std::mt19937       generator(14);
  const auto         b = problem.slice(dense::random(40, 1, generator));
  MultiVector        lambda(problem.n_owned(), 1), residual = b;
  const auto         whole = pcpg(problem, *free_set, lambda, residual, {1e-10}, 100);
  MultiVector        again(problem.n_owned(), 1);
  Pcpg               solver(problem, *free_set);
  unsigned int       iterations = 0;
  residual                      = b;
  for (const double tolerance : {1e-1, 1e-4, 1e-7, 1e-10})
    iterations += solver.solve(again, residual, {tolerance}, 100).iterations;
  EXPECT_EQ(iterations, whole.iterations);
  EXPECT_LT(dense::distance(lambda, again), 1e-11);
}

TEST(Pcpg, DirectionsOffLeavingRowsServeTheSmallerFace)
{
  const DenseProblem problem(linear_data(40, 3, 18));
  std::mt19937       generator(19);
  const auto         b = dense::random(40, 1, generator);
  RowSet             leaving(40, 0), staying(40, 1);
  for (const unsigned int row : {1, 17, 34})
    {
      leaving[row] = 1;
      staying[row] = 0;
    }
  const auto  whole = problem.free_set(problem.slice(RowSet(40, 1)));
  const auto  part  = problem.free_set(problem.slice(staying));
  MultiVector lambda(problem.n_owned(), 1), residual = problem.slice(b);
  Pcpg        on_all_rows(problem, *whole);
  const auto  first = on_all_rows.solve(lambda, residual, {1e-3}, 100);
  const auto  known = on_all_rows.directions().off(problem.slice(leaving), MPI_COMM_WORLD);
  // a direction is lost per row
  EXPECT_EQ(known.P.n_columns(), first.iterations - 3);
  const auto P = problem.gather(known.P), FP = problem.gather(known.FP);
  EXPECT_LT(dense::distance(FP, dense::product(problem.data.F, P)), 1e-12);
  dense::Matrix identity(P.n_columns(), P.n_columns());
  for (unsigned int j = 0; j < P.n_columns(); ++j)
    {
      identity(j, j) = known.unit;
      for (unsigned int i = 0; i < 40; ++i)
        if (leaving[i])
          {
            EXPECT_EQ(P(i, j), 0.);
          }
    }
  EXPECT_LT(dense::distance(dense::product(dense::transpose(P), FP), identity), 1e-12);

  MultiVector again(problem.n_owned(), 1);
  residual         = problem.slice(b);
  const auto next  = Pcpg(problem, *part, known).solve(again, residual, {1e-11}, 100);
  const auto alone = solve_with_pcpg(problem, staying, b, 1e-12);
  EXPECT_LT(dense::distance(problem.gather(again), solve_directly(problem.data, staying, b)),
            1e-10);
  EXPECT_LE(next.iterations + known.P.n_columns(), alone.f_mults + 3);
}

TEST(Pcpg, BlocksBeginInKnownDirections)
{
  const DenseProblem problem(linear_data(40, 3, 21));
  const RowSet       all(40, 1);
  std::mt19937       generator(22);
  const auto         b        = dense::random(40, 2, generator);
  const auto         free_set = problem.free_set(problem.slice(all));
  // the first column is solved, the second is new
  MultiVector lambda(problem.n_owned(), 1);
  MultiVector residual = problem.slice(b).columns_from(0, 1);
  Pcpg        first(problem, *free_set);
  first.solve(lambda, residual, {1e-11}, 100);
  MultiVector both(problem.n_owned(), 2);
  residual = problem.slice(b);
  Pcpg next(problem, *free_set, first.directions());
  EXPECT_TRUE(next.solve(both, residual, {1e-10, 1e-10}, 100).converged);
  EXPECT_LT(dense::distance(problem.gather(both), solve_directly(problem.data, all, b)), 1e-9);
  EXPECT_LE(next.directions().P.n_columns(), 40u);
}

TEST(LeadingColumns, AreNearToAllOthers)
{
  std::mt19937 generator(23);
  auto         A = dense::random(9, 3, generator);
  auto         x = dense::product(A, dense::random(3, 7, generator));
  x.add(1e-6, dense::random(9, 7, generator));
  const auto S = dense::product(dense::transpose(x), x);
  EXPECT_EQ(leading_columns(S, 1e-4, 0.).size(), 3u);
  EXPECT_EQ(leading_columns(S, 0., 1e-4).size(), 3u);
  EXPECT_EQ(leading_columns(S, 1e-9, 0.).size(), 7u);
  // farther than any column: the longest one alone
  const auto one = leading_columns(S, 1e9, 0.);
  ASSERT_EQ(one.size(), 1u);
  for (unsigned int j = 0; j < 7; ++j)
    EXPECT_LE(S(j, j), S(one[0], one[0]));
  // distances from the span, by projection on an orthonormal basis
  const auto    taken = leading_columns(S, 0., 0.2);
  dense::Matrix Q(9, 0);
  for (const unsigned int j : taken)
    {
      auto q = x.columns_from(j, 1);
      for (unsigned int repeat = 0; repeat < 2; ++repeat)
        q.add_product(-1., Q, dense::product(dense::transpose(Q), q));
      dense::Matrix unit(9);
      unit.add(1. / norms(q, MPI_COMM_SELF)[0], q);
      Q.append(unit);
    }
  auto rest = x;
  rest.add_product(-1., Q, dense::product(dense::transpose(Q), x));
  for (const double distance : norms(rest, MPI_COMM_SELF))
    EXPECT_LE(distance, 0.2 * std::sqrt(S(one[0], one[0])));
}

TEST(NullSpace, OfDependentRows)
{
  std::mt19937 generator(20);
  const auto   A = dense::product(dense::random(6, 3, generator), dense::random(3, 8, generator));
  const auto   N = null_space(A, 1e-12);
  ASSERT_EQ(N.n_columns(), 5u);
  EXPECT_LT(dense::largest(dense::product(A, N)), 1e-14);
  dense::Matrix identity(5, 5);
  for (unsigned int i = 0; i < 5; ++i)
    identity(i, i) = 1.;
  EXPECT_LT(dense::distance(dense::product(dense::transpose(N), N), identity), 1e-14);
  EXPECT_EQ(null_space(dense::random(3, 3, generator), 1e-12).n_columns(), 0u);
  EXPECT_EQ(null_space(dense::Matrix(0, 4), 1e-12).n_columns(), 4u);
}

TEST(Pcpg, SemidefiniteOperator)
{
  // dependent rows: F = B B' of rank 20 < 30, right-hand sides in its range
  std::mt19937 generator(15);
  DenseData    data = linear_data(30, 2, 16);
  const auto   B    = dense::random(30, 20, generator);
  data.F            = dense::product(B, dense::transpose(B));
  // G lambda = 0 hides nothing of the kernel's effect on B' lambda
  data.G = dense::product(dense::random(2, 20, generator), dense::transpose(B));
  const DenseProblem problem(data);
  const auto         b      = dense::product(B, dense::random(20, 2, generator));
  const auto         solved = solve_with_pcpg(problem, RowSet(30, 1), b, 1e-10);
  EXPECT_TRUE(solved.result.converged);
  EXPECT_LE(solved.f_mults, 22u);
}

TEST(Pcpg, PreconditionerSavesIterations)
{
  Membranes::Shape shape;
  shape.columns           = 3;
  shape.cells             = 8;
  DenseData          data = Membranes(shape).data();
  const DenseProblem with(data);
  data.preconditioner = dense::Matrix(0, 0);
  const DenseProblem without(data);
  const RowSet       all(data.F.n_rows(), 1);
  const auto         fast = solve_with_pcpg(with, all, data.d, 1e-8);
  const auto         slow = solve_with_pcpg(without, all, data.d, 1e-8);
  EXPECT_LT(2 * fast.f_mults, slow.f_mults);
  EXPECT_LT(dense::distance(fast.lambda, slow.lambda), 1e-6);
}

TEST(OrthonormalCombinations, FindTheRank)
{
  std::mt19937 generator(17);
  const auto   A = dense::random(6, 3, generator);
  auto         S = dense::product(A, dense::transpose(A));
  for (unsigned int i = 0; i < 6; ++i) // of very different sizes
    for (unsigned int j = 0; j < 6; ++j)
      S(i, j) *= std::pow(10., double(i) + j);
  const auto C = orthonormal_combinations(S, std::vector<double>(6, 0.), 1e-12);
  ASSERT_EQ(C.n_columns(), 3u);
  dense::Matrix identity(3, 3);
  for (unsigned int i = 0; i < 3; ++i)
    identity(i, i) = 1.;
  EXPECT_LT(dense::distance(dense::product(dense::transpose(C), dense::product(S, C)), identity),
            1e-10);
  EXPECT_EQ(orthonormal_combinations(dense::Matrix(2, 2), {0., 0.}, 1e-12).n_columns(), 0u);
}
