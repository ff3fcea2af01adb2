#include "known_solution.h"

#include <snug/base/errors.h>
#include <snug/qp/kkt.h>

#include <gtest/gtest.h>

#include <limits>

using namespace snug::qp;

namespace {
/// The residual at @p lambda with alpha from its positive rows.
KktResidual kkt_at(const DenseProblem &problem, const dense::Matrix &lambda)
{
  MultiVector none(problem.n_owned(), 0);
  const auto  equality = equality_part(problem, problem.initial_active_set(), none);
  RowSet      rows     = problem.data.bounded;
  for (unsigned int i = 0; i < rows.size(); ++i)
    rows[i] = !rows[i] || lambda(i) != 0.;
  auto residual = problem.data.d;
  residual.add(-1., dense::product(problem.data.F, lambda));
  const auto free_set = problem.free_set(problem.slice(rows));
  return kkt_residual(problem, free_set->amplitudes(problem.slice(residual)), problem.slice(lambda),
                      problem.slice(residual), equality.scale);
}
} // namespace

TEST(KktResidual, VanishesAtTheSolutionOnly)
{
  const auto         known = known_solution(KnownShape(), 1);
  const DenseProblem problem(known.data);
  const auto         kkt = kkt_at(problem, known.lambda);
  EXPECT_LT(kkt.relative, 1e-13);
  EXPECT_LT(dense::distance(kkt.amplitudes, known.alpha), 1e-11);
  EXPECT_LT(dense::distance(problem.gather(kkt.w), known.w), 1e-11);
  for (const unsigned int i : {0u, 1u, 29u}) // equality, active, inactive
    for (const double change : {1e-4, -1e-4})
      {
        auto other = known.lambda;
        other(i) += change;
        EXPECT_GT(kkt_at(problem, other).relative, 1e-6) << i;
      }
}

TEST(KktResidual, FollowsItsDefinition)
{
  const auto         known = known_solution(KnownShape(), 2);
  const DenseProblem problem(known.data);
  auto               lambda = known.lambda;
  lambda(3) += 0.25;
  lambda(29)      = -0.5; // pulls
  const auto  kkt = kkt_at(problem, lambda);
  const auto  w   = problem.gather(kkt.w);
  const auto  all = problem.free_set(problem.slice(RowSet(30, 1)));
  MultiVector lambda_equality(problem.n_owned());
  all->make_feasible(lambda_equality, problem.e());
  MultiVector base = problem.d();
  base.add(-1., problem.apply(lambda_equality));
  all->project(base);
  double square = 0.;
  for (unsigned int i = 0; i < 30; ++i)
    {
      const double r =
        known.data.bounded[i] ? std::min(lambda(i) * known.data.F(i, i), -w(i)) : w(i);
      square += r * r;
    }
  EXPECT_NEAR(kkt.relative - kkt.feasibility, std::sqrt(square) / norms(base, MPI_COMM_WORLD)[0],
              1e-12);
  auto missing = known.data.e;
  missing.add(-1., dense::product(known.data.G, lambda));
  double softest = 0.;
  for (unsigned int i = 0; i < 30; ++i)
    softest = std::max(softest, known.data.F(i, i));
  const double scale = norms(base, MPI_COMM_WORLD)[0];
  const double force = norms(lambda, MPI_COMM_SELF)[0] + scale / softest;
  EXPECT_NEAR(kkt.feasibility,
              norms(missing, MPI_COMM_SELF)[0] /
                (norms(known.data.e, MPI_COMM_SELF)[0] + problem.feasibility_scale(force)),
              1e-13);
}

TEST(KktResidual, DoesNotDependOnTheGeneralizedInverse)
{
  // another K^+ adds R C R' to it: G'CG to F and G'Ce to d
  const auto   known = known_solution(KnownShape(), 3);
  DenseData    other = known.data;
  std::mt19937 generator(4);
  auto         C = dense::random(4, 4, generator);
  C.add(1., dense::transpose(C));
  const auto GtC = dense::product(dense::transpose(other.G), C);
  other.F.add(1., dense::product(GtC, other.G));
  other.d.add(1., dense::product(GtC, other.e));
  const DenseProblem one(known.data), two(other);
  MultiVector        none(one.n_owned(), 0);
  EXPECT_NEAR(equality_part(one, one.initial_active_set(), none).scale,
              equality_part(two, two.initial_active_set(), none).scale, 1e-11);
}

TEST(EqualityPart, AppliesFToTheStartInTheSameBlock)
{
  const auto         known = known_solution(KnownShape(), 5);
  const DenseProblem problem(known.data);
  MultiVector        x        = problem.slice(known.lambda);
  const auto         equality = equality_part(problem, problem.initial_active_set(), x);
  EXPECT_EQ(problem.context().work.f_mults, 2u);
  auto residual = known.data.d;
  residual.add(-1., dense::product(known.data.F, known.lambda));
  EXPECT_LT(dense::distance(x, problem.slice(residual)), 1e-12);
  EXPECT_LT(dense::distance(problem.apply_G(equality.lambda), known.data.e), 1e-12);
}

TEST(EqualityPart, RejectsDataThatAreNotFinite)
{
  auto data = known_solution(KnownShape(), 7).data;
  data.d(3) = std::numeric_limits<double>::quiet_NaN();
  const DenseProblem problem(data);
  MultiVector        none(problem.n_owned(), 0);
  EXPECT_THROW(equality_part(problem, problem.initial_active_set(), none), snug::SolveError);
}
