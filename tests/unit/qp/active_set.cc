#include "active_set_checks.h"
#include "known_solution.h"
#include "membranes.h"

#include <snug/base/errors.h>
#include <snug/qp/kkt.h>
#include <snug/qp/pcpg.h>
#include <snug/qp/row_set.h>

#include <gtest/gtest.h>

using namespace snug::qp;

namespace {
/// F-mults of the linear problem on the active set, to the same tolerance.
unsigned long linear_f_mults(const DenseProblem &problem, const RowSet &active, double tolerance)
{
  MultiVector  none(problem.n_owned(), 0);
  const double scale    = equality_part(problem, problem.initial_active_set(), none).scale;
  const auto   free_set = problem.free_set(active);
  const auto   before   = problem.context().work.f_mults;
  MultiVector  lambda(problem.n_owned());
  free_set->make_feasible(lambda, problem.e());
  MultiVector residual = problem.d();
  residual.add(-1., problem.apply(lambda));
  pcpg(problem, *free_set, lambda, residual, {tolerance * scale}, 1000);
  return problem.context().work.f_mults - before;
}

Membranes::Shape partial_contact()
{
  Membranes::Shape shape;
  shape.columns = 3;
  shape.rows    = 2;
  shape.cells   = 5;
  shape.load    = 0.1;
  shape.shift   = 0.03;
  return shape;
}
} // namespace

TEST(ActiveSet, FindsKnownSolutions)
{
  for (unsigned int seed = 0; seed < 12; ++seed)
    {
      KnownShape shape;
      shape.n_active   = 1 + seed;
      const auto known = known_solution(shape, seed);
      for (const double tolerance : {1e-6, 1e-9, 1e-12})
        {
          const DenseProblem problem(known.data);
          const auto         solution = solve_cold(problem, tolerance);
          expect_certified(problem, solution, tolerance);
          EXPECT_LT(dense::distance(problem.gather(solution.lambda), known.lambda),
                    error_bound(known, tolerance));
          EXPECT_LT(dense::distance(solution.amplitudes, known.alpha),
                    error_bound(known, tolerance));
          EXPECT_EQ(solution.method, "active set");
        }
    }
}

TEST(ActiveSet, TornEqualsUntornMembranes)
{
  for (const double load : {0.001, 0.1, 10.}) // 1, 10 and all of 16 contacts
    {
      auto shape = partial_contact();
      shape.load = load;
      const Membranes membranes(shape);
      const auto      exact = membranes.untorn_forces();
      for (const double tolerance : {1e-6, 1e-9, 1e-12})
        {
          const DenseProblem problem(membranes.data());
          const auto         solution = solve_cold(problem, tolerance);
          expect_certified(problem, solution, tolerance);
          const auto forces = membranes.forces(problem.gather(solution.lambda));
          EXPECT_LT(dense::distance(forces, exact), 10. * tolerance * (0.1 + load));
          for (unsigned int c = 0; c < membranes.n_contacts(); ++c)
            EXPECT_TRUE(tolerance == 1e-6 || (forces(c) > 0.) == (exact(c) > 0.)) << c;
        }
    }
}

TEST(ActiveSet, CostsAboutTwoLinearSolvesColdAndOneWarm)
{
  auto               shape = partial_contact();
  const DenseProblem problem(Membranes(shape).data());
  const auto         cold   = solve_cold(problem, 1e-6);
  const auto         linear = linear_f_mults(problem, cold.active, 1e-6);
  // 10 against 7; with exact inner solves it would be 15
  EXPECT_LE(cold.f_mults, 1.8 * linear);
  shape.load *= 1.02;
  const DenseProblem moved(Membranes(shape).data());
  const auto warm = ActiveSet(with_tolerance(1e-6)).solve(moved, {cold.lambda, cold.active});
  expect_certified(moved, warm, 1e-6);
  EXPECT_LE(warm.f_mults, 1.2 * linear);
}

TEST(ActiveSet, StartAtTheSolutionEndsAtOnce)
{
  const auto         data = Membranes(partial_contact()).data();
  const DenseProblem problem(data);
  const auto         cold = solve_cold(problem, 1e-9);
  const DenseProblem again(data);
  const auto warm = ActiveSet(with_tolerance(1e-8)).solve(again, {cold.lambda, cold.active});
  EXPECT_EQ(warm.f_mults, 2u); // the residual and the scale
  EXPECT_EQ(warm.outer_iterations, 1u);
}

TEST(ActiveSet, AnyStartLeadsToTheSolution)
{
  const Membranes membranes(partial_contact());
  const auto      exact = membranes.untorn_forces();
  std::mt19937    generator(1);
  const auto     &data = membranes.data();
  for (unsigned int trial = 0; trial < 12; ++trial)
    {
      // no contact at all (the upper body floats), then random ones; without
      // and with a wild lambda
      RowSet active = data.bounded;
      for (unsigned int i = 0; i < active.size(); ++i)
        active[i] = !data.bounded[i] || (trial > 1 && generator() % 4 == 0);
      dense::Matrix wild = dense::random(active.size(), 1, generator);
      for (unsigned int i = 0; i < active.size(); ++i)
        wild(i) *= trial % 2 == 0 ? 0. : 100.;
      const DenseProblem problem(data);
      const auto         solution = ActiveSet(with_tolerance(1e-9))
                              .solve(problem, {problem.slice(wild), problem.slice(active)});
      expect_certified(problem, solution, 1e-9);
      EXPECT_LT(dense::distance(membranes.forces(problem.gather(solution.lambda)), exact), 1e-8);
    }
}

TEST(ActiveSet, StartMayBeOnlyASetOrOnlyForces)
{
  const auto         known = known_solution(KnownShape(), 3);
  const DenseProblem problem(known.data);
  const auto         active = problem.slice(loaded_rows(known.data.bounded, known.lambda));
  WarmStart          set, forces;
  set.active    = active;
  forces.lambda = problem.slice(known.lambda);
  for (const WarmStart &start : {set, forces})
    {
      const auto solution = ActiveSet(with_tolerance(1e-9)).solve(problem, start);
      EXPECT_LT(dense::distance(problem.gather(solution.lambda), known.lambda),
                error_bound(known, 1e-9));
    }
}

TEST(ActiveSet, WeaklyActiveRows)
{
  for (unsigned int seed = 20; seed < 26; ++seed)
    {
      KnownShape shape;
      shape.n_weak     = 3;
      const auto known = known_solution(shape, seed);
      for (const double tolerance : {1e-6, 1e-9, 1e-12})
        {
          const DenseProblem problem(known.data);
          const auto         solution = solve_cold(problem, tolerance);
          expect_certified(problem, solution, tolerance);
          EXPECT_LT(dense::distance(problem.gather(solution.lambda), known.lambda),
                    error_bound(known, tolerance));
        }
    }
}

TEST(ActiveSet, NoLoadNoForce)
{
  auto shape = partial_contact();
  shape.load = 0.;
  const Membranes    membranes(shape);
  const DenseProblem problem(membranes.data());
  const auto         solution = solve_cold(problem, 1e-9);
  // bodies that touch at most: gaps are all that d holds
  EXPECT_LT(dense::largest(membranes.forces(problem.gather(solution.lambda))), 1e-9);
}

TEST(ActiveSet, StaticallyDeterminateProblem)
{
  // as many rows as rigid motions: lambda follows from G lambda = e alone,
  // and the projected residual is rounding
  KnownShape shape;
  shape.n = shape.n_kernel = 6;
  shape.n_active           = 3;
  const auto         known = known_solution(shape, 30);
  const DenseProblem problem(known.data);
  const auto         solution = solve_cold(problem, 1e-12);
  EXPECT_LT(dense::distance(problem.gather(solution.lambda), known.lambda), 1e-11);
}

TEST(ActiveSet, StopsAtRoundingOfTheRigidPart)
{
  // d is almost all G' alpha, 1e11 times the rest: the residual w is known to
  // 1e-5 at best, and a relative tolerance below that has no meaning
  KnownShape shape;
  shape.n        = 12;
  shape.n_kernel = 3;
  shape.n_active = 3;
  auto known     = known_solution(shape, 31);
  auto rigid     = known.alpha;
  rigid.add(1e11, known.alpha);
  known.data.d.add(-1., dense::product(dense::transpose(known.data.G), rigid));
  const DenseProblem problem(known.data);
  const auto         solution = solve_cold(problem, 1e-9);
  EXPECT_LT(dense::distance(problem.gather(solution.lambda), known.lambda), 1e-2);
}

TEST(ActiveSet, PullingLoadHasNoEquilibrium)
{
  auto shape = partial_contact();
  shape.load = -0.1;
  const DenseProblem problem(Membranes(shape).data());
  try
    {
      solve_cold(problem, 1e-6);
      ADD_FAILURE() << "no error";
    }
  catch (const snug::SolveError &error)
    {
      EXPECT_EQ(std::string(error.what()).find("no equilibrium: "), 0u);
    }
}

TEST(ActiveSet, SaysWhenTheIterationsRunOut)
{
  auto parameters           = with_tolerance(1e-9);
  parameters.max_iterations = 6;
  const DenseProblem problem(Membranes(partial_contact()).data());
  try
    {
      ActiveSet(parameters).solve(problem, WarmStart());
      ADD_FAILURE() << "no error";
    }
  catch (const snug::SolveError &error)
    {
      EXPECT_NE(std::string(error.what()).find("instead of 1e-09"), std::string::npos);
    }
  EXPECT_LE(problem.context().work.f_mults, 7u);
}

TEST(ActiveSet, ImpossibleToleranceEnds)
{
  const DenseProblem problem(Membranes(partial_contact()).data());
  EXPECT_THROW(solve_cold(problem, 1e-19), snug::SolveError);
  EXPECT_LE(problem.context().work.f_mults, 400u);
}

TEST(ActiveSet, DoesNotDependOnTheDiagonal)
{
  // of nearly incompressible bodies the estimate of F_ii is a thousandth of it
  const auto   data  = Membranes(partial_contact()).data();
  const auto   known = solve_cold(DenseProblem(data), 1e-6);
  DenseProblem problem(data);
  problem.scale_diagonal(1e-3);
  const auto solution = solve_cold(problem, 1e-6);
  EXPECT_EQ(solution.f_mults, known.f_mults);
  EXPECT_EQ(solution.method, "active set");
}

TEST(RowSet, OneChangeIsTheLastOfAllRanks)
{
  const DenseProblem problem(known_solution(KnownShape(), 1).data);
  RowSet             from(30, 0), to(30, 0), expected(30, 0);
  to[4] = to[17] = to[11] = 1;
  expected[17]            = 1;
  EXPECT_EQ(with_one_change(problem.slice(from), problem.slice(to), MPI_COMM_WORLD),
            problem.slice(expected));
  EXPECT_NE(fingerprint(problem.slice(from), MPI_COMM_WORLD),
            fingerprint(problem.slice(to), MPI_COMM_WORLD));
  EXPECT_EQ(with_one_change(problem.slice(to), problem.slice(to), MPI_COMM_WORLD),
            problem.slice(to));
}
