#include <snug/state/certificate.h>

#include <gtest/gtest.h>
#include <unit/state/test_scene.h>

namespace {
using namespace snug;
using namespace snug::test;

/// 3D, curved punch, other meshes, hanging nodes, a random design.
TestScene<3> hertz_scene(double tolerance)
{
  auto scene = two_blocks<3>(4, 3, 3.);
  set_design(scene, 3, 0.02);
  scene.bodies[1].refined_below   = 0.45;
  scene.solver.relative_tolerance = tolerance;
  return scene;
}

/// Results that must not depend on tearing, solver, preconditioner or package.
struct Answer
{
  double               energy, compliance, strain_energy;
  dealii::Tensor<1, 3> force;
  std::vector<double>  pressure;
  state::Certificate   certificate;
  double               largest_pressure;
};

Answer answer(const TestScene<3> &scene)
{
  Problem<3> problem(scene);
  const auto state = problem.solve();
  Answer     result{state.energy, state.compliance,  state.strain_energy, state.contact_force,
                    {},           state.certificate, state.max_pressure};
  // by slave position: the numbers of nodes depend on ranks
  const auto &surface = problem.solver.surface();
  const auto  x       = surface.gather(problem.mesh.reference_positions());
  std::map<std::pair<double, double>, double> sorted;
  for (unsigned int i = 0; i < state.contact.size(); ++i)
    {
      const auto &slave            = x[problem.solver.contact(0).places()[i].slave];
      sorted[{slave[0], slave[1]}] = state.contact[i].pressure;
    }
  for (const auto &entry : sorted)
    result.pressure.push_back(entry.second);
  return result;
}

void expect_same(const Answer &a, const Answer &b)
{
  const double same = 1e-7; // for states solved to 1e-9
  EXPECT_LT(relative_difference(a.energy, b.energy), same);
  EXPECT_LT(relative_difference(a.compliance, b.compliance), same);
  EXPECT_LT(relative_difference(a.strain_energy, b.strain_energy), same);
  EXPECT_LT((a.force - b.force).norm(), same * b.force.norm());
  ASSERT_EQ(a.pressure.size(), b.pressure.size());
  for (unsigned int i = 0; i < a.pressure.size(); ++i)
    EXPECT_NEAR(a.pressure[i], b.pressure[i], same * b.largest_pressure);
}

TEST(StateInvariance, SubdomainsAndSolvers)
{
  auto       scene     = hertz_scene(1e-9);
  const auto reference = answer(scene);
  EXPECT_LE(reference.certificate.worst(), 1e-9);
  for (const unsigned int subdomains : {2, 8, 20})
    for (const std::string method : {"active set", "SMALSE-M"})
      {
        SCOPED_TRACE(method + " on " + std::to_string(subdomains));
        scene.subdomains    = subdomains;
        scene.solver.method = method;
        const auto other    = answer(scene);
        expect_same(other, reference);
        EXPECT_LE(other.certificate.worst(), 1e-9);
      }
}

TEST(StateInvariance, PreconditionersAndPackages)
{
  using feti::Factorization;
  using feti::Preconditioner;
  using feti::Scaling;
  auto                                    scene     = hertz_scene(1e-9);
  const auto                              reference = answer(scene);
  const std::vector<feti::FetiParameters> choices   = {
    {Factorization::MUMPS, Preconditioner::Dirichlet, Scaling::stiffness},
    {Factorization::CHOLMOD, Preconditioner::Dirichlet, Scaling::multiplicity},
    {Factorization::CHOLMOD, Preconditioner::lumped, Scaling::stiffness},
    {Factorization::CHOLMOD, Preconditioner::none, Scaling::stiffness}};
  for (const auto &choice : choices)
    {
      SCOPED_TRACE(to_text(choice.factorization) + " " + to_text(choice.preconditioner) + " " +
                   to_text(choice.scaling));
      scene.feti = choice;
      expect_same(answer(scene), reference);
    }
}

TEST(State, CertificateMeetsDefaultTolerance)
{
  const auto state = answer(hertz_scene(1e-6));
  EXPECT_LE(state.certificate.equilibrium, 1e-6);
  EXPECT_LE(state.certificate.continuity, 1e-6);
  EXPECT_LE(state.certificate.penetration, 1e-6);
  EXPECT_LE(state.certificate.negative_pressure, 1e-6);
  EXPECT_LE(state.certificate.complementarity, 1e-6);
  EXPECT_GT(state.certificate.worst(), 0.);
}

TEST(State, CertificateOfNaNIsInfinite)
{
  Problem<3> problem(hertz_scene(1e-6));
  const auto state = problem.solve();
  auto       u     = state.u;
  for (unsigned int s = 0; s < u.size(); ++s)
    for (unsigned int i = 0; i < u[s].n_rows(); ++i)
      u[s](i) = std::numeric_limits<double>::quiet_NaN();
  const auto certificate = state::certify(problem.solver.feti(state), state.dual.lambda, u);
  for (const double error : {certificate.continuity, certificate.penetration, certificate.worst()})
    EXPECT_FALSE(error < std::numeric_limits<double>::max());
}

TEST(State, ContactCarriesTheLoad)
{
  // the punch is held vertically by contact alone: pressure 10 on area 1
  const auto state = answer(hertz_scene(1e-9));
  EXPECT_NEAR(state.force[2], 10., 1e-7);
}

TEST(State, EnergiesAreConsistent)
{
  const auto state = answer(hertz_scene(1e-9));
  EXPECT_NEAR(state.energy, state.strain_energy - state.compliance, 1e-7 * std::abs(state.energy));
}
} // namespace
