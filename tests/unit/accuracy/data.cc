#include <snug/accuracy/surface_residual.h>

#include <gtest/gtest.h>
#include <unit/accuracy/guided_blocks.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include <numeric>

namespace snug::test {
namespace {
using accuracy::Sampling;

double sum(const std::vector<double> &of_cells)
{
  return dealii::Utilities::MPI::sum(std::accumulate(of_cells.begin(), of_cells.end(), 0.),
                                     MPI_COMM_WORLD);
}

/// The work of what is missed on a unit motion downwards: the force.
template <int dim>
double missed_force(const TestScene<dim> &scene, const Sampling sampling)
{
  Problem<dim> problem(scene);
  const auto  &x = problem.mesh.reference_positions();
  auto         v = x;
  for (auto &of_node : v)
    of_node = -1. * dealii::Point<dim>::unit_vector(dim - 1);
  return sum(
    accuracy::LoadResidual<dim>(problem.mesh, problem.model.load_cases[0], x, sampling).works(v));
}

template <int dim>
TestScene<dim> loaded(const std::function<double(const dealii::Point<dim> &)> &factor)
{
  auto scene                                           = two_blocks<dim>(4, 4, 0.);
  scene.bodies[0].loads[face_index(dim - 1, 1)].factor = factor;
  return scene;
}

template <int dim>
void expect_force_of_step()
{
  // the Gauss points of the face from 0.25 to 0.5 are at 0.303 and 0.447: half of it is loaded
  const auto   step  = loaded<dim>([](const auto &x) { return x[0] < 0.32 ? 1. : 0.; });
  const double right = 10. * (0.32 - 0.375);
  EXPECT_NEAR(missed_force(step, Sampling::search), right, 0.02);
  EXPECT_NEAR(missed_force(step, Sampling::measure), right, 0.2);
}
} // namespace

TEST(LoadResidual, IsTheForceThatGaussPointsMiss)
{
  expect_force_of_step<2>();
  expect_force_of_step<3>();
}

TEST(LoadResidual, IsNothingOfSmoothLoads)
{
  EXPECT_NEAR(missed_force<2>(loaded<2>({}), Sampling::search), 0., 1e-12);
  EXPECT_NEAR(missed_force<3>(loaded<3>([](const auto &x) { return x[0] * x[1] * x[1] * x[1]; }),
                              Sampling::search),
              0., 1e-12);
}

TEST(Unresolved, AreTheCellsUnderAStep)
{
  Problem<2> problem(loaded<2>([](const auto &x) { return x[0] < 0.32 ? 1. : 0.; }));
  const auto unresolved = [&](const double share) {
    return accuracy::unresolved_data(problem.mesh, problem.model, share);
  };
  EXPECT_EQ(unresolved(0.05).cells.size(), 1u);
  ASSERT_EQ(unresolved(0.05).lines.size(), 1u);
  EXPECT_NE(unresolved(0.05).lines[0].find("the loads on punch.top"), std::string::npos);
  EXPECT_TRUE(unresolved(0.5).cells.empty());
}

TEST(Unresolved, AreTheCellsUnderAllFormulas)
{
  Problem<2> problem(loaded<2>({}));
  const auto step  = [](const auto &x) { return x[0] < 0.32 ? 1. : 0.; };
  const auto found = [&](const state::Model<2> &model) {
    const auto lines = accuracy::unresolved_data(problem.mesh, model, 0.05).lines;
    return lines.empty() ? "" : lines[0].substr(0, lines[0].find(':'));
  };
  const std::string missed = "the mesh does not resolve the ";
  EXPECT_EQ(found(problem.model), "");
  auto model = problem.model;
  model.supports.push_back({0, face_index(1, 1), 0, {step}, ""});
  EXPECT_EQ(found(model), missed + "prescribed displacement on punch.top");
  model = problem.model;
  model.springs.push_back({1, face_index(1, 0), 0, step, {}, {}, ""});
  EXPECT_EQ(found(model), missed + "stiffness of the spring on foundation.bottom");
  model                                     = problem.model;
  model.load_cases[0].bodies[1].temperature = step;
  EXPECT_EQ(found(model), missed + "temperature in foundation");
  model                                    = problem.model;
  model.pairs[0].parameters.friction       = contact::Friction::Tresca;
  model.pairs[0].parameters.friction_bound = "if(x < 0.32, 1, 0)";
  EXPECT_EQ(found(model), missed + "friction on punch.bottom");
}

namespace {
/// Return the rough pressure of blocks with 4 cells per edge under a uniform pressure of 10.
template <int dim>
accuracy::RoughPressure rough(const std::string &gap)
{
  auto          scene = guided_blocks<dim>(4, 4);
  contact::Pair pair{{0, face_index(dim - 1, 0)}, {1, face_index(dim - 1, 1)}};
  pair.parameters.gap                                  = gap;
  pair.parameters.method                               = contact::Method::nodal;
  scene.pairs                                          = {pair};
  scene.bodies[0].loads[face_index(dim - 1, 1)].factor = {};
  Problem<dim> problem(scene);
  return accuracy::rough_pressures(problem.solver, problem.solve())[0];
}
} // namespace

TEST(RoughPressure, IsThatOfAWaveInFullContact)
{
  // pi E* d/l of a wave of 1/10 of the blocks, 1/100 of the pressure
  const double modulus = 1000. / (2. * (1. - 0.3 * 0.3));
  const double d       = 0.01 * 10. * 0.1 / (dealii::numbers::PI * modulus);
  const auto   wave    = std::to_string(1e9 * d) + "e-9*sin(62.83185307*x+0.3)";
  EXPECT_NEAR(rough<2>(wave).missed, 0.01, 0.003);
  EXPECT_NEAR(rough<3>(wave).missed, 0.01, 0.003);
}

TEST(RoughPressure, IsNothingOfGapsThatElementsFollow)
{
  EXPECT_NEAR(rough<2>("1e-4*x^2").missed, 0., 1e-9);
  EXPECT_NEAR(rough<3>("1e-4*x*y").missed, 0., 1e-9);
}

TEST(UnseenVolume, IsOfSurfacesBetweenTheirSamples)
{
  geometry::BodyMeshParameters body;
  body.corner       = {0., 0.};
  body.size         = {1., 1.};
  body.cells        = {2, 2};
  const double w    = 0.01;
  body.curved_faces = {{"top", "0.05*exp(-((x-0.2)/0.01)^2)"}};
  const mesh::BodyMesh<2> mesh(MPI_COMM_WORLD, {body}, 1);
  const auto              found = accuracy::unseen_volumes(mesh);
  const double            bump  = 0.05 * w * std::sqrt(dealii::numbers::PI);
  EXPECT_NEAR(found[0].missed / bump, 1., 0.05);
  EXPECT_NEAR(sum(found[0].of_cells), found[0].missed, 1e-12);
}
} // namespace snug::test
