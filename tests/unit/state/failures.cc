#include <snug/base/errors.h>

#include <gtest/gtest.h>
#include <unit/state/test_scene.h>

namespace {
using namespace snug;
using namespace snug::test;

/// The message of the SolveError that solving @p scene ends with, or "".
template <int dim>
std::string failure(const TestScene<dim> &scene)
{
  Problem<dim> problem(scene);
  try
    {
      problem.solve();
    }
  catch (const SolveError &error)
    {
      return error.what();
    }
  return "";
}

struct Dimension2
{
  static const int dim = 2;
};
struct Dimension3
{
  static const int dim = 3;
};

template <typename Dimension>
class NoEquilibrium : public ::testing::Test
{
protected:
  static const int dim   = Dimension::dim;
  TestScene<dim>   scene = two_blocks<dim>(2, 3, 0.);

  NoEquilibrium()
  {
    narrow_punch(scene);
    scene.bodies[0].supports.clear();
  }

  dealii::Tensor<1, dim> up(double value) const
  {
    dealii::Tensor<1, dim> vector;
    vector[dim - 1] = value;
    return vector;
  }

  void expect_escape_of(const std::string &body)
  {
    for (const std::string method : {"active set", "SMALSE-M"})
      {
        scene.solver.method = method;
        const auto message  = failure(scene);
        EXPECT_NE(message.find("body " + body), std::string::npos) << method << ": " << message;
        EXPECT_EQ(message.find('\n'), std::string::npos);
      }
  }
};
using Dimensions = ::testing::Types<Dimension2, Dimension3>;
TYPED_TEST_SUITE(NoEquilibrium, Dimensions);

TYPED_TEST(NoEquilibrium, PullOff)
{
  const unsigned int top                    = face_index(this->dim - 1, 1);
  this->scene.bodies[0].loads[top].pressure = -10.;
  this->expect_escape_of("punch");
}

TYPED_TEST(NoEquilibrium, Tipping)
{
  // 1 up at the left, 2 down at the right: 1 down beyond the right edge.
  // Contact forces of any sign could carry that, non-negative ones cannot.
  this->scene.bodies[0].loads.clear();
  this->scene.bodies[0].loads[face_index(0, 0)].traction = this->up(1.);
  this->scene.bodies[0].loads[face_index(0, 1)].traction = this->up(-2.);
  this->expect_escape_of("punch");
}

TYPED_TEST(NoEquilibrium, PushedSideways)
{
  this->scene.bodies[0].loads[face_index(0, 0)].pressure = 1.;
  this->expect_escape_of("punch");
}

TYPED_TEST(NoEquilibrium, NothingHoldsALoadedBody)
{
  auto block = this->scene.bodies[1];
  block.corner[0] += 3.;
  block.supports.clear();
  block.body_force = this->up(-1.);
  this->scene.bodies.push_back(block);
  this->expect_escape_of("block");
}

TYPED_TEST(NoEquilibrium, NothingHoldsABodyThatNothingLoads)
{
  // it is where it was, and named
  auto block = this->scene.bodies[1];
  block.corner[0] += 3.;
  block.supports.clear();
  this->scene.bodies.push_back(block);
  for (const std::string method : {"active set", "SMALSE-M"})
    {
      this->scene.solver.method = method;
      Problem<TestFixture::dim> problem(this->scene);
      const auto                lines = problem.solve().free_bodies;
      ASSERT_FALSE(lines.empty()) << method;
      EXPECT_EQ(lines.back().find("body block is free to move: "), 0u) << lines.back();
      EXPECT_EQ(std::count(lines.back().begin(), lines.back().end(), ';'),
                TestFixture::dim == 2 ? 2 : 5)
        << lines.back();
    }
}

TYPED_TEST(NoEquilibrium, BodiesInOnePieceThatNothingTouches)
{
  // squeezed and apart: no row is left, neither of gluing nor of supports or contact
  for (auto &body : this->scene.bodies)
    {
      body.supports.clear();
      body.loads.clear();
      for (const unsigned int side : {0, 1})
        body.loads[face_index(0, side)].pressure = 10.;
    }
  const int up = TestFixture::dim - 1;
  this->scene.bodies[0].corner[up] += 0.2;
  this->scene.subdomains = 2;
  for (const std::string method : {"active set", "SMALSE-M"})
    {
      this->scene.solver.method = method;
      Problem<TestFixture::dim> problem(this->scene);
      const auto                state = problem.solve();
      EXPECT_EQ(state.active_contacts, 0u) << method;
      EXPECT_EQ(state.free_bodies.size(), 2u) << method;
      EXPECT_GT(state.strain_energy, 0.) << method;
      EXPECT_NEAR(state.compliance, 2. * state.strain_energy, 1e-8 * state.compliance) << method;
    }
}

TYPED_TEST(NoEquilibrium, LoadWithinTheContactIsCarried)
{
  // the counterpart of Tipping: the resultant inside the contact
  this->scene.bodies[0].loads.clear();
  this->scene.bodies[0].loads[face_index(0, 0)].traction = this->up(-0.2);
  this->scene.bodies[0].loads[face_index(0, 1)].traction = this->up(-1.);
  EXPECT_EQ(failure(this->scene), "");
}

TEST(TangledMesh, IsFoundAndForgotten)
{
  auto scene                    = two_blocks<2>(3, 4, 3.);
  scene.control_points          = {3, 1};
  const std::vector<double> bad = {0., -4., 0.}, good = {0.01, 0.02, 0.};
  Problem<2>                problem(scene);
  const auto                before = problem.solve(good);
  try
    {
      problem.solve(bad);
      FAIL() << "solved a tangled mesh";
    }
  catch (const TangledMesh &error)
    {
      EXPECT_NE(std::string(error.what()).find("foundation"), std::string::npos);
    }
  const auto after = problem.solve(good);
  EXPECT_EQ(before.energy, after.energy);
}

TEST(TangledMesh, NotANumberIsFound)
{
  auto       scene = two_blocks<2>(3, 4, 3.);
  Problem<2> problem(scene);
  auto       x = problem.mesh.reference_positions();
  for (auto &node : x)
    node[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(problem.solver.solve(x, qp::WarmStart()), SolveError);
}
} // namespace
