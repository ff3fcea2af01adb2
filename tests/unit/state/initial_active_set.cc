#include "test_scene.h"

#include <snug/feti/initial_active_set.h>
#include <snug/qp/active_set.h>

#include <gtest/gtest.h>

namespace snug {
namespace {
/// Contact rows of all ranks that are in the set.
unsigned int n_contacts(const qp::DualProblem &problem, const qp::RowSet &rows)
{
  unsigned int n = 0;
  for (unsigned int i = 0; i < rows.size(); ++i)
    n += problem.bounded()[i] && rows[i];
  return dealii::Utilities::MPI::sum(n, problem.context().communicator());
}

template <int dim>
test::TestScene<dim> pressed(const double pressure, const double stiffness = 1000.)
{
  auto scene = test::two_blocks<dim>(dim == 2 ? 32 : 12, dim == 2 ? 32 : 12, 4.);
  for (auto &body : scene.bodies)
    body.material = {stiffness, 0.3};
  scene.bodies[0].loads[test::face_index(dim - 1, 1)].pressure = pressure;
  return scene;
}

/// The problem with a guess of its own.
class Guessed : public qp::DualProblem
{
public:
  Guessed(const qp::DualProblem &the_problem, qp::RowSet the_rows)
    : problem(the_problem), rows(std::move(the_rows))
  {}
  RunContext                &context() const override { return problem.context(); }
  unsigned int               n_owned() const override { return problem.n_owned(); }
  const qp::RowSet          &bounded() const override { return problem.bounded(); }
  const qp::MultiVector     &d() const override { return problem.d(); }
  const qp::MultiVector     &e() const override { return problem.e(); }
  const std::vector<double> &diagonal() const override { return problem.diagonal(); }
  qp::MultiVector apply(const qp::MultiVector &x) const override { return problem.apply(x); }
  qp::MultiVector apply_G(const qp::MultiVector &x) const override { return problem.apply_G(x); }
  qp::MultiVector apply_Gt(const qp::MultiVector &a) const override { return problem.apply_Gt(a); }
  double feasibility_scale(double f) const override { return problem.feasibility_scale(f); }
  std::unique_ptr<qp::FreeSet> free_set(const qp::FreeRows &free) const override
  {
    return problem.free_set(free);
  }
  qp::RowSet initial_active_set() const override { return rows; }

private:
  const qp::DualProblem &problem;
  const qp::RowSet       rows;
};

template <int dim>
void expect_near_contacts()
{
  // From a few rows in contact to half of them.
  for (const double pressure :
       dim == 2 ? std::vector<double>{0.3, 3., 30.} : std::vector<double>{0.3, 30.})
    {
      test::Problem<dim> problem(pressed<dim>(pressure));
      const auto         state    = problem.solve();
      const auto        &feti     = problem.solver.feti(state);
      const unsigned int expected = n_contacts(feti, feti.initial_active_set());
      EXPECT_GE(expected, state.active_contacts) << dim << "D, pressure " << pressure;
      EXPECT_LE(expected, 4 * state.active_contacts + 4) << dim << "D, pressure " << pressure;
    }
}
} // namespace

// The number of expected contacts is at least that of active contacts for any load.
TEST(ExpectedContacts, AreThoseOfHertz)
{
  expect_near_contacts<2>();
  expect_near_contacts<3>();
}

// Bodies 8 times as stiff under 8 times the load: the same displacements, the same guess.
TEST(ExpectedContacts, DoNotDependOnTheUnitOfForce)
{
  test::Problem<2> soft(pressed<2>(3.)), hard(pressed<2>(24., 8000.));
  const auto       of_soft = soft.solve(), of_hard = hard.solve();
  EXPECT_EQ(soft.solver.feti(of_soft).initial_active_set(),
            hard.solver.feti(of_hard).initial_active_set());
}

// It is a start: the solution is that of the problem, whatever was expected.
TEST(ExpectedContacts, DoNotChangeTheSolution)
{
  test::Problem<2> problem(pressed<2>(3.));
  const auto       state  = problem.solve();
  const auto      &feti   = problem.solver.feti(state);
  const auto       solved = qp::ActiveSet({"active set", 1e-10, 5000});
  std::mt19937     random(7);
  for (unsigned int trial = 0; trial < 5; ++trial)
    {
      qp::RowSet rows(feti.n_owned(), 1);
      for (unsigned int i = 0; i < rows.size(); ++i)
        rows[i] = !feti.bounded()[i] || (trial > 0 && random() % trial == 0);
      auto difference = solved.solve(Guessed(feti, rows), qp::WarmStart()).lambda;
      difference.add(-1., state.dual.lambda);
      const MPI_Comm comm = problem.context.communicator();
      EXPECT_LE(norms(difference, comm)[0], 1e-7 * norms(state.dual.lambda, comm)[0]);
    }
}
} // namespace snug
