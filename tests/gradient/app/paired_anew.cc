#include <snug/app/shape_problem.h>
#include <snug/scene/read_scene.h>
#include <snug/sensitivity/methods.h>

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>
#include <sstream>

/// Test the effect of the contact search at the start of an optimization on objectives at later
/// designs: nodal rows of non-matching faces, whose foot points follow the design.
namespace {
using namespace snug;

template <int dim>
class Pairings
{
public:
  explicit Pairings(const scene::Scene &scene)
    : context(MPI_COMM_WORLD, log)
    , problem(context, scene, app::build_mesh<dim>(scene, context.communicator()))
  {}

  /// At the start and at random designs.
  void check()
  {
    std::mt19937                           generator(5);
    std::uniform_real_distribution<double> uniform(-1., 1.);
    const auto                             start = problem.shapes->start();
    check(start);
    for (unsigned int trial = 0; trial < 2; ++trial)
      {
        auto design = start;
        for (unsigned int i = 0; i < design.size(); ++i)
          design[i] += way * uniform(generator) *
                       (problem.shapes->upper_bounds()[i] - problem.shapes->lower_bounds()[i]);
        check(design);
      }
  }

private:
  /// Between a pairing at the start and one at the design, where no foot point has left its face:
  /// of the objective, and of its slopes, as far as differences of second order tell.
  static constexpr double tolerance = 1e-9, slope_tolerance = 1e-4;
  /// Distances of designs from the first one, relative to the width of the bounds.
  static constexpr double way  = 0.25;
  static constexpr double step = 1e-4;

  void check(const std::vector<double> &design)
  {
    problem.solver->pair(problem.positions(problem.shapes->start()));
    const auto   states  = problem.solve(design);
    const auto   factors = problem.combined_objective(states).factors;
    const double found   = problem.combined_objective(states).value;
    const auto   slopes  = sensitivity::combined_gradients(problem.load_cases(states, design, {}),
                                                           *problem.objective, factors, {})
                          .of_response[0]
                          .values;
    EXPECT_NEAR(found, anew(design), tolerance * std::abs(found));
    double error = 0., size = 0.;
    for (unsigned int i = 0; i < design.size(); ++i)
      {
        auto before = design, after = design;
        before[i] -= step;
        after[i] += step;
        const double expected = (anew(after) - anew(before)) / (2. * step);
        error += std::pow(slopes[i] - expected, 2);
        size += std::pow(expected, 2);
      }
    EXPECT_LT(std::sqrt(error / size), slope_tolerance);
  }

  double anew(const std::vector<double> &design)
  {
    problem.solver->pair(problem.positions(design));
    return problem.combined_objective(problem.solve(design)).value;
  }

  std::ostringstream     log;
  RunContext             context;
  app::ShapeProblem<dim> problem;
};

scene::Scene read(const std::string &text, std::vector<std::string> sets)
{
  sets.insert(sets.end(), {"Contact/Method=nodal", "Solver/Relative tolerance=1e-11"});
  return scene::read_scene({"scene.prm", text, sets, "gradient.app.paired-anew"});
}

std::string text_of(const std::string &scene)
{
  std::ostringstream text;
  text << std::ifstream(SNUG_ROOT "/tests/scenes/" + scene).rdbuf();
  return text.str();
}
} // namespace

TEST(PairedAnew, BlocksThatDoNotMatch)
{
  for (const std::string degree : {"1", "2"})
    {
      SCOPED_TRACE("degree " + degree);
      Pairings<2>(read(text_of("two-blocks-2d.prm"),
                       {"Element degree=" + degree, "Body lower/Box cells=11, 6"}))
        .check();
    }
}

TEST(PairedAnew, BlocksThatDoNotMatchIn3D)
{
  Pairings<3>(read(text_of("two-blocks-3d.prm"), {"Body lower/Box cells=5, 7, 3"})).check();
}

/// Two load cases, one of them one-sided, and a peak, which is what one node carries.
TEST(PairedAnew, PeakOfTwoLoadCases)
{
  Pairings<2>(read(R"(
set Dimension = 2
set Bodies = up, lo
set Responses = peak
set Load cases = a, b
subsection Body up
  set Box corner = 0, 1
  set Box cells = 8, 6
  set Curved faces = bottom: -(x^2)/8
  set Young's modulus = 1000
  set Supports = left: x
end
subsection Body lo
  set Box size = 1.2, 1
  set Box cells = 11, 7
  set Young's modulus = 1500
  set Poisson's ratio = 0.25
  set Supports = left: x, bottom: y
end
subsection Contact
  set Pairs = up.bottom: lo.top
end
subsection Shape
  set Basis = B-spline patch
  set Face = lo.top
  set Control points = 5
  set Direction = 0, 1
  set Bounds = -0.1, 0.1
  set Initial = 0.0003, 0.0117, 0.0057, 0.0170, 0.0005
end
subsection Response peak
  set Quantity = peak pressure
end
subsection Optimization
  set Objective = peak
  set Combine = sum
end
subsection Load case a
  set Pressure = up.top: 10
end
subsection Load case b
  set Traction = up.top: 2 -5*(1+x)
  set Weight = 2
end
)",
                   {}))
    .check();
}
