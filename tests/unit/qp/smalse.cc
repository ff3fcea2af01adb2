#include "known_solution.h"
#include "membranes.h"

#include <snug/base/errors.h>
#include <snug/qp/smalse.h>

#include <gtest/gtest.h>

#include <algorithm>

using namespace snug::qp;

namespace {
Membranes::Shape two_by_two()
{
  Membranes::Shape shape;
  shape.rows  = 2;
  shape.load  = 0.05;
  shape.shift = 0.03;
  return shape;
}

DualSolution solve_by(const std::string  &method,
                      const DenseProblem &problem,
                      double              tolerance,
                      const WarmStart    &start = WarmStart())
{
  SolverParameters parameters;
  parameters.relative_tolerance = tolerance;
  return snug::choose(solver_table(), method).make(parameters)->solve(problem, start);
}
} // namespace

TEST(Smalse, FindsKnownSolutions)
{
  for (unsigned int seed = 0; seed < 6; ++seed)
    {
      KnownShape shape;
      shape.n_active   = 2 + 2 * seed;
      shape.n_weak     = seed % 3;
      const auto known = known_solution(shape, seed);
      for (const double tolerance : {1e-6, 1e-9})
        {
          const DenseProblem problem(known.data);
          const auto         solution = solve_by("SMALSE-M", problem, tolerance);
          EXPECT_LE(solution.kkt_residual, tolerance);
          EXPECT_EQ(solution.f_mults, problem.context().work.f_mults);
          EXPECT_EQ(solution.method, "SMALSE-M");
          EXPECT_LT(dense::distance(problem.gather(solution.lambda), known.lambda),
                    error_bound(known, tolerance));
        }
    }
}

TEST(Smalse, EqualsActiveSetOnMembranes)
{
  const Membranes membranes(two_by_two());
  const auto      exact = membranes.untorn_forces();
  for (const double tolerance : {1e-6, 1e-9, 1e-12})
    {
      const DenseProblem one(membranes.data()), two(membranes.data());
      const auto         smalse = solve_by("SMALSE-M", one, tolerance);
      const auto         active = solve_by("active set", two, tolerance);
      const auto         forces = membranes.forces(one.gather(smalse.lambda));
      EXPECT_LT(dense::distance(forces, membranes.forces(two.gather(active.lambda))), tolerance);
      EXPECT_LT(dense::distance(forces, exact), tolerance);
      EXPECT_EQ(smalse.active, active.active);
      EXPECT_LT(smalse.f_mults, 120u);
      for (unsigned int c = 0; c < forces.n_rows(); ++c)
        EXPECT_GE(forces(c), 0.);
    }
}

TEST(Smalse, WithoutPreconditioner)
{
  auto       data     = Membranes(two_by_two()).data();
  const auto exact    = Membranes(two_by_two()).untorn_forces();
  data.preconditioner = dense::Matrix(0, 0);
  const DenseProblem problem(data);
  const auto         solution = solve_by("SMALSE-M", problem, 1e-9);
  EXPECT_LT(dense::distance(Membranes(two_by_two()).forces(problem.gather(solution.lambda)), exact),
            1e-8);
}

TEST(Smalse, StartFromASolutionIsCheaper)
{
  const auto         data = Membranes(two_by_two()).data();
  const DenseProblem problem(data), again(data);
  const auto         cold = solve_by("SMALSE-M", problem, 1e-9);
  const auto         warm = solve_by("SMALSE-M", again, 1e-8, {cold.lambda, cold.active});
  // the scale, ten power steps, the start and the check of the result
  EXPECT_LE(warm.f_mults, 14u);
  EXPECT_LT(dense::distance(warm.lambda, cold.lambda), 1e-8);
}

/// A body under the force 1 at @p load on contacts at @p places of flexibility 0.1, with right-hand
/// sides @p d.
DenseData
body_on_contacts(const std::vector<double> &places, const std::vector<double> &d, const double load)
{
  const unsigned int n = places.size();
  DenseData          data;
  data.F = dense::Matrix(n, n);
  data.G = dense::Matrix(2, n);
  data.d = dense::Matrix(n);
  data.e = dense::Matrix(2);
  for (unsigned int i = 0; i < n; ++i)
    {
      data.F(i, i) = 0.1;
      data.G(0, i) = 1.;
      data.G(1, i) = places[i];
      data.d(i)    = d[i];
    }
  data.e(0) = 1.;
  data.e(1) = load;
  data.bounded.assign(n, 1);
  return data;
}

/// The load of a body goes through the middle one of three contacts. That leaves it free to turn:
/// only by an angle that the force does not tell do the other contacts stay open.
TEST(Smalse, TurnsAFreeBodyUntilItsContactsAreOpen)
{
  const DenseData data = body_on_contacts({-1., 0., 1.}, {-1., 0., 0.5}, 0.);
  for (const char *method : {"active set", "SMALSE-M"})
    {
      const DenseProblem problem(data);
      const auto         solution = solve_by(method, problem, 1e-9);
      const auto         lambda   = problem.gather(solution.lambda);
      EXPECT_NEAR(lambda(1), 1., 1e-9) << method;
      EXPECT_NEAR(lambda(0) + lambda(2), 0., 1e-9) << method;
      auto w = solution.residual;
      w.add(1., problem.apply_Gt(solution.amplitudes));
      w = problem.gather(w);
      EXPECT_LT(std::max(w(0), w(2)), 1e-9) << method;
    }
}

/// Two contacts next to each other carry a body with more of them far away: with the first penalty
/// 5,000 steps would be needed for a tolerance of 1e-9.
TEST(Smalse, RaisesThePenaltyForShortLevers)
{
  const DenseData    data = body_on_contacts({0., 0.02, 1., 2., 3.}, {0., 0., -1., -1., -1.}, 0.01);
  const DenseProblem problem(data);
  const auto         solution = solve_by("SMALSE-M", problem, 1e-9);
  const auto         lambda   = problem.gather(solution.lambda);
  for (unsigned int i = 0; i < 5; ++i)
    EXPECT_NEAR(lambda(i), i < 2 ? 0.5 : 0., 1e-7);
}

TEST(Smalse, PullingLoadEndsWithAnError)
{
  auto shape      = two_by_two();
  shape.load      = -0.1;
  const auto data = Membranes(shape).data();
  const auto run  = [&]() {
    const DenseProblem problem(data);
    SolverParameters   parameters;
    parameters.max_iterations = 150;
    Smalse(parameters).solve(problem, WarmStart());
  };
  EXPECT_THROW(run(), snug::SolveError); // iterations run out
}

/// Rough solutions show the way there, exact ones hide it.
TEST(Smalse, DoesNotDependOnWhoOwnsTheRows)
{
  const auto         data = Membranes(two_by_two()).data();
  const DenseProblem spread(data), on_one_rank(data, 1);
  const auto         a = solve_by("SMALSE-M", spread, 1e-3);
  const auto         b = solve_by("SMALSE-M", on_one_rank, 1e-3);
  EXPECT_EQ(a.f_mults, b.f_mults);
  EXPECT_LT(dense::distance(spread.gather(a.lambda), on_one_rank.gather(b.lambda)), 1e-10);
}

TEST(SolverTable, SolversWithoutFMultsLeftSayWhatTheyReached)
{
  for (const char *method : {"active set", "SMALSE-M"})
    {
      const DenseProblem problem(Membranes(two_by_two()).data());
      SolverParameters   parameters;
      parameters.max_iterations = 1;
      try
        {
          snug::choose(solver_table(), method).make(parameters)->solve(problem, WarmStart());
          ADD_FAILURE() << method << ": no error";
        }
      catch (const snug::SolveError &error)
        {
          EXPECT_EQ(std::string(error.what()).find("residual of 0 "), std::string::npos)
            << error.what();
        }
    }
}

TEST(SolverTable, ListsBothSolvers)
{
  ASSERT_EQ(solver_table().size(), 2u);
  EXPECT_EQ(solver_table()[0].name, "active set");
  EXPECT_EQ(solver_table()[1].name, "SMALSE-M");
}
