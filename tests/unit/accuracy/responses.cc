#include <snug/accuracy/estimate.h>

#include <gtest/gtest.h>
#include <unit/accuracy/guided_blocks.h>

namespace snug::test {
namespace {
response::ResponseParameters named(const std::string &quantity, const std::string &face = "")
{
  response::ResponseParameters parameters;
  parameters.name = parameters.quantity = quantity;
  parameters.face                       = face;
  return parameters;
}

template <int dim>
struct Found
{
  std::vector<double>                     values;
  std::vector<accuracy::ResponseEstimate> estimates;
};

template <int dim>
Found<dim> found(const TestScene<dim>                            &scene,
                 const std::vector<response::ResponseParameters> &parameters,
                 const bool                                       estimate = true,
                 MPI_Comm                                         comm     = MPI_COMM_WORLD)
{
  Problem<dim>                                          problem(scene, comm);
  const auto                                            state = problem.solve();
  std::vector<std::unique_ptr<response::Response<dim>>> owned;
  std::vector<const response::Response<dim> *>          responses;
  std::optional<state::ContactState<dim>>               solved_on;
  Found<dim>                                            result;
  for (const auto &one : parameters)
    {
      owned.push_back(response::make_response<dim>(one));
      responses.push_back(owned.back().get());
      result.values.push_back(owned.back()->value(problem.solver, state));
    }
  if (estimate)
    result.estimates =
      accuracy::estimate(problem.solver, state, responses, sensitivity::Solves::block, solved_on)
        .responses;
  return result;
}

/// E over |J - J_h| of each, J on cells @p finer times finer.
template <int dim>
std::vector<double> effectivities(const TestScene<dim>                            &scene,
                                  const unsigned int                               finer,
                                  const std::vector<response::ResponseParameters> &parameters)
{
  auto fine = scene;
  for (auto &body : fine.bodies)
    for (auto &n : body.cells)
      n *= finer;
  const auto          here = found(scene, parameters), there = found(fine, parameters, false);
  std::vector<double> result;
  for (unsigned int j = 0; j < parameters.size(); ++j)
    result.push_back(here.estimates[j].error() / std::abs(there.values[j] - here.values[j]));
  return result;
}

/// A cylinder or sphere pushed down by a given way, in contact in the middle.
template <int dim>
TestScene<dim> pushed(unsigned int n)
{
  auto  scene = two_blocks<dim>(n, n, 4.);
  auto &punch = scene.bodies[0];
  punch.loads.clear();
  punch.sampled = true;
  punch.prescribed.push_back({0,
                              face_index(dim - 1, 1),
                              dim - 1,
                              {[](const dealii::Point<dim> &) { return -0.03; }},
                              "push"});
  return scene;
}

const std::vector<response::ResponseParameters> of_smooth_states = {
  named("potential energy"), named("strain energy"), named("compliance"),
  named("peak pressure"),    named("contact area"),  named("pressure norm"),
  named("pressure variance")};
} // namespace

TEST(ResponseEstimate, IsTheErrorOfSmoothStates)
{
  if (!is_alone())
    GTEST_SKIP();
  const auto expect_effective = [](const auto &scene, const std::string &what,
                                   const double most = 1.25) {
    const auto found = effectivities(scene, 4, of_smooth_states);
    for (unsigned int j = 0; j < found.size(); ++j)
      {
        // The reading's part has the size of the error it stands for, not always its sign.
        EXPECT_GT(found[j], 0.85) << what << ", " << of_smooth_states[j].name;
        EXPECT_LT(found[j], most) << what << ", " << of_smooth_states[j].name;
      }
  };
  for (const unsigned int degree : {1, 2})
    {
      auto nodal = guided_blocks<2>(8, 8), mortar = guided_blocks<2>(8, 9);
      nodal.degree = mortar.degree = degree;
      mortar.method                = contact::Method::mortar;
      expect_effective(nodal, "nodal");
      expect_effective(mortar, "mortar");
      nodal.idealization = {mesh::Idealization::Kind::plane_stress, 0.3};
      expect_effective(nodal, "plane stress");
      nodal.idealization = {mesh::Idealization::Kind::axisymmetric};
      expect_effective(nodal, "axisymmetric", 1.5);
    }
}

/// Near Poisson's ratio one half the errors of pressures count as much as those of displacements,
/// and jumps that a loose solve leaves are worth much more than both.
TEST(ResponseEstimate, SeesNearlyIncompressibleCells)
{
  if (!is_alone())
    GTEST_SKIP();
  const std::vector<response::ResponseParameters> responses = {named("potential energy"),
                                                               named("strain energy"),
                                                               named("peak pressure")};
  for (const double nu : {0.49, 0.499, 0.4999})
    {
      const auto there = found(nearly_incompressible<2>(32, nu, 2, 1e-9), responses, false);
      for (const unsigned int degree : {1, 2})
        {
          const auto scene                = nearly_incompressible<2>(8, nu, degree, 1e-9);
          auto       loose                = scene;
          loose.solver.relative_tolerance = 1e-2;
          const auto here = found(scene, responses), loosely = found(loose, responses);
          for (unsigned int j = 0; j < responses.size(); ++j)
            {
              const auto what = responses[j].name + ", nu " + std::to_string(nu);
              for (const auto *one : {&here, &loosely})
                {
                  const double ratio =
                    one->estimates[j].error() / std::abs(there.values[j] - here.values[j]);
                  EXPECT_GT(ratio, 0.8) << what << ", degree " << degree;
                  EXPECT_LT(ratio, 3.) << what << ", degree " << degree;
                }
            }
        }
    }
}

/// Where energy and gap residual nearly cancel, E is up to several times the error.
TEST(ResponseEstimate, IsNotBelowTheErrorOfContactThatEnds)
{
  if (!is_alone())
    GTEST_SKIP();
  const std::vector<response::ResponseParameters> responses = {named("potential energy"),
                                                               named("contact force"),
                                                               named("peak pressure")};
  for (const unsigned int n : {16, 24})
    for (const double found : effectivities(pushed<2>(n), 4, responses))
      EXPECT_GT(found, 0.8) << n;
  for (const double found : effectivities(pushed<3>(6), 2, responses))
    EXPECT_GT(found, 0.8) << "3D";
}

/// The second order of von Mises norms is left out: sigma_h is of first order.
TEST(ResponseEstimate, SeesTheFirstOrderOfStressNorms)
{
  if (!is_alone())
    GTEST_SKIP();
  auto scene = guided_blocks<2>(16, 16);
  for (auto &body : scene.bodies)
    body.material.yield_stress = 25.;
  const auto found = effectivities(scene, 4, {named("von Mises norm"), named("yield utilization")});
  EXPECT_GT(found[0], 0.6);
  EXPECT_LT(found[0], 1.2);
  // The utilization is the norm over the yield stress.
  EXPECT_NEAR(found[1], found[0], 1e-8);
}

TEST(ResponseEstimate, SeesFacesAndTheirMeanDisplacement)
{
  if (!is_alone())
    GTEST_SKIP();
  auto scene                                     = two_blocks<2>(8, 8, 0.);
  scene.bodies[0].loads[face_index(1, 1)].factor = [](const dealii::Point<2> &x) {
    return std::cos(dealii::numbers::PI * x[0]) + 1.;
  };
  // On this face the estimate without the field derivative is four times the error.
  const auto found = effectivities(scene, 4, {named("displacement", "foundation.right")});
  EXPECT_GT(found[0], 0.7);
  EXPECT_LT(found[0], 1.4);
}

/// Moments on rollers at the sides, which statics do not determine. Without the field derivative
/// the estimates are 5.8 and 11 times the errors.
TEST(ResponseEstimate, SeesReactions)
{
  if (!is_alone())
    GTEST_SKIP();
  for (const char *face : {"foundation.left", "punch.left"})
    {
      auto moment      = named("reaction moment", face);
      moment.component = response::Component::z;
      const auto found = effectivities(guided_blocks<2>(8, 8), 4, {moment});
      EXPECT_GT(found[0], 0.8) << face;
      EXPECT_LT(found[0], 1.3) << face;
    }
}

/// Volumes know no state; forces that statics determine have no error.
TEST(ResponseEstimate, IsNoneOfWhatTheMeshDoesNotChange)
{
  const auto result = found(guided_blocks<2>(6, 6), {named("volume"), named("contact force")});
  EXPECT_EQ(result.estimates[0].error(), 0.);
  EXPECT_LT(result.estimates[1].error(), 1e-8 * result.values[1]);
}

TEST(ResponseEstimate, IsThatOfOneRank)
{
  const std::vector<response::ResponseParameters> responses = {named("potential energy"),
                                                               named("contact force"),
                                                               named("peak pressure"),
                                                               named("von Mises norm")};
  const auto                                      here      = found(pushed<2>(12), responses);
  const auto alone = found(pushed<2>(12), responses, true, MPI_COMM_SELF);
  for (unsigned int j = 0; j < responses.size(); ++j)
    EXPECT_NEAR(here.estimates[j].error() / alone.estimates[j].error(), 1., 1e-6);
}
} // namespace snug::test
