#include <snug/app/shape_problem.h>
#include <snug/scene/read_scene.h>
#include <snug/sensitivity/methods.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <sstream>
#include <tuple>

/// Every scene of the gallery that has a design, with few cells, nodal and
/// mortar: gradients of its objective and responses at a design without
/// symmetry, against differences of states.
namespace {
using namespace snug;

/// Between the methods, which solve the same system or its transpose. Gradients of slender beams of
/// degree 2 have round-off of 6e-10.
const double method_tolerance = 1e-9;
/// Tolerance of differences of fourth order between states.
const double difference_tolerance = 1e-7;
const double energy_tolerance     = 1e-8;
/// of differences and of designs from the first one, relative to the width
/// of the bounds
const double difference_step = 1e-4;
const double design_step     = 0.05;

/// of a scene that are checked. Ten or more take most of the time of the test.
const std::size_t most_load_cases = 4;

struct Case
{
  std::string     file;
  contact::Method method; ///< of the pairs
};

std::string contents(const std::string &file)
{
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

std::vector<Case> cases()
{
  std::vector<Case> result;
  for (const std::string folder : {"/prm", "/tests/scenes"})
    for (const auto &entry : std::filesystem::directory_iterator(SNUG_ROOT + folder))
      if (entry.path().extension() == ".prm" &&
          contents(entry.path()).find("set Basis") != std::string::npos)
        for (const auto method : {contact::Method::nodal, contact::Method::mortar})
          result.push_back({entry.path(), method});
  std::sort(result.begin(), result.end(), [](const Case &a, const Case &b) {
    return std::tie(a.file, a.method) < std::tie(b.file, b.method);
  });
  return result;
}

void coarsen(scene::Scene &scene)
{
  for (auto &body : scene.bodies)
    {
      if (scene.dimension == 3)
        {
          for (unsigned int &n : body.mesh.cells)
            n = std::min(n, 4u);
          body.mesh.warp.clear(); // the grading of finer meshes
        }
      for (unsigned int &n : body.mesh.round_cells)
        n = std::max(n / 4, 1u);
      body.mesh.local_refinements -= std::min(body.mesh.local_refinements, 3u);
    }
  if (scene.load_cases.size() > most_load_cases)
    scene.load_cases.resize(most_load_cases);
}

/// Larger elements of CAD files, which are meshed when the scene is read.
const std::map<std::string, std::vector<std::string>> coarse_elements = {
  {"step-roller", {"Body rim/Element size=12", "Body rim/Face sizes=tread: 6"}}};

scene::Scene coarse_scene(const Case &given)
{
  const auto name  = std::filesystem::path(given.file).stem().string();
  const auto sizes = coarse_elements.find(name);
  const auto ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD),
             rank  = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  std::ostringstream log;
  RunContext         self(MPI_COMM_SELF, log);
  auto               scene = scene::read_scene(
    {given.file, contents(given.file),
     sizes == coarse_elements.end() ? std::vector<std::string>() : sizes->second,
                   // Each rank reads CAD files by itself, and gmsh writes files of its own.
                   "gradient.app.np" + std::to_string(ranks) + "/" + std::to_string(rank) + "/" + name, contents,
                   &self});
  coarsen(scene);
  // those of degree 2 are slender: round-off does not let them reach 1e-11
  scene.state_tolerance = scene.degree == 1 ? 1e-11 : 1e-10;
  for (auto &pair : scene.contact.pairs)
    pair.parameters.method = given.method;
  return scene;
}

double norm(const std::vector<double> &a)
{
  double sum = 0.;
  for (const double x : a)
    sum += x * x;
  return std::sqrt(sum);
}

template <int dim>
class SceneGradients
{
public:
  using States = std::vector<state::ContactState<dim>>;

  SceneGradients(const scene::Scene &scene)
    : context(MPI_COMM_WORLD, log)
    , problem(context, scene, app::build_mesh<dim>(scene, context.communicator()))
    , generator(7)
    , design(problem.shapes->start())
  {
    const auto step = random_step();
    for (unsigned int i = 0; i < design.size(); ++i)
      design[i] += design_step * step[i];
    volume = problem.make_response("volume");
    measured.push_back({volume.get(), 0});
    for (unsigned int c = 0; c < problem.n_load_cases(); ++c)
      for (const auto &response : problem.responses)
        measured.push_back({response.get(), c});
  }

  void check(const contact::Method contact_method)
  {
    ASSERT_GT(design.size(), 0u);
    for (const auto &pair : problem.solver->contact(0).pairs())
      ASSERT_EQ(pair.parameters.method, contact_method);
    const auto states = problem.solve(design);
    for (const auto &state : states)
      {
        // a body that may move freely need not touch another
        ASSERT_TRUE(state.active_contacts > 0 || state.contact.empty() ||
                    !state.free_bodies.empty());
        ASSERT_EQ(state.weak_contacts, 0u);
      }
    const auto adjoint  = gradients(states, sensitivity::Method::adjoint);
    const auto direct   = gradients(states, sensitivity::Method::direct);
    const auto step     = random_step();
    const auto expected = differences(states, step);
    // A response may be constant in a load case, as the tension of a bolt under its preload.
    std::vector<bool> changes(problem.responses.size(), false);
    for (unsigned int i = 0; i < expected.size(); ++i)
      {
        SCOPED_TRACE("response " + std::to_string(i));
        if (i > 1 && norm(adjoint[i]) > 0.)
          changes[(i - 2) % changes.size()] = true;
        check_same(adjoint[i], direct[i], difference_step * expected[i].round_off);
        check_slope(adjoint[i], step, expected[i], difference_tolerance);
      }
    ASSERT_GT(norm(adjoint[0]), 0.); // the objective
    ASSERT_GT(norm(adjoint[1]), 0.); // the volume
    ASSERT_EQ(std::count(changes.begin(), changes.end(), false), 0);
    if (!sensitivity::needs_solve(*problem.objective, problem.solver->has_potential()))
      check_slope(gradients(states, sensitivity::Method::energy, false)[0], step, expected[0],
                  energy_tolerance);
  }

private:
  /// Random numbers times the widths of the bounds.
  std::vector<double> random_step()
  {
    std::uniform_real_distribution<double> uniform(-1., 1.);
    std::vector<double>                    step;
    for (unsigned int i = 0; i < design.size(); ++i)
      step.push_back(uniform(generator) * width(i));
    return step;
  }

  double width(const unsigned int i) const
  {
    return problem.shapes->upper_bounds()[i] - problem.shapes->lower_bounds()[i];
  }

  /// By variables that are relative to the widths of their bounds.
  std::vector<std::vector<double>>
  gradients(const States &states, const sensitivity::Method method, bool all = true)
  {
    sensitivity::GradientParameters parameters;
    parameters.method = method;
    using Measured    = sensitivity::Measured<dim>;
    const auto found =
      sensitivity::combined_gradients(problem.load_cases(states, design, parameters),
                                      *problem.objective,
                                      problem.combined_objective(states).factors,
                                      all ? measured : std::vector<Measured>());
    std::vector<std::vector<double>> result;
    for (const auto &gradient : found.of_response)
      {
        result.push_back(gradient.values);
        for (unsigned int i = 0; i < design.size(); ++i)
          result.back()[i] *= width(i);
      }
    return result;
  }

  std::vector<double> values(const States &states)
  {
    std::vector<double> result = {problem.combined_objective(states).value};
    for (const auto &[response, load_case] : measured)
      result.push_back(response->value(*problem.solver, states[load_case]));
    return result;
  }

  static std::vector<bool> strong(const States &states)
  {
    std::vector<bool> result;
    for (const auto &state : states)
      for (const auto &point : state.contact)
        result.push_back(point.strong);
    return result;
  }

  struct Slope
  {
    double value     = 0.;
    double round_off = 0.; ///< of the values it is a difference of
  };

  /// d values(design + t step) / dt at t = 0; contacts must stay.
  std::vector<Slope> differences(const States &states, const std::vector<double> &step)
  {
    const double       weight[] = {1. / 12., -8. / 12., 8. / 12., -1. / 12.};
    const int          place[]  = {-2, -1, 1, 2};
    std::vector<Slope> slopes(1 + measured.size());
    for (unsigned int k = 0; k < 4; ++k)
      {
        auto moved = design;
        for (unsigned int i = 0; i < moved.size(); ++i)
          moved[i] += place[k] * difference_step * step[i];
        const auto there = problem.solve(moved);
        EXPECT_EQ(strong(there), strong(states));
        const auto found = values(there);
        for (unsigned int i = 0; i < found.size(); ++i)
          {
            slopes[i].value += weight[k] / difference_step * found[i];
            slopes[i].round_off = 1e-15 / difference_step * std::abs(found[i]);
          }
      }
    return slopes;
  }

  /// @p round_off: of the value, above which a derivative is more than nothing.
  static void
  check_same(const std::vector<double> &a, const std::vector<double> &b, const double round_off)
  {
    std::vector<double> difference;
    for (unsigned int i = 0; i < a.size(); ++i)
      difference.push_back(a[i] - b[i]);
    EXPECT_LE(norm(difference), method_tolerance * norm(b) + round_off);
  }

  void check_slope(const std::vector<double> &gradient,
                   const std::vector<double> &step,
                   const Slope               &expected,
                   const double               tolerance) const
  {
    double              slope = 0.;
    std::vector<double> direction;
    for (unsigned int i = 0; i < step.size(); ++i)
      {
        direction.push_back(step[i] / width(i));
        slope += gradient[i] * direction[i];
      }
    EXPECT_NEAR(slope, expected.value,
                tolerance * norm(gradient) * norm(direction) + expected.round_off);
  }

  std::ostringstream                       log;
  RunContext                               context;
  app::ShapeProblem<dim>                   problem;
  std::mt19937                             generator;
  std::vector<double>                      design;
  std::unique_ptr<response::Response<dim>> volume;
  std::vector<sensitivity::Measured<dim>>  measured;
};

class EveryScene : public testing::TestWithParam<Case>
{
};

TEST_P(EveryScene, WithADesign)
{
  const auto scene = coarse_scene(GetParam());
  if (scene.dimension == 2)
    SceneGradients<2>(scene).check(GetParam().method);
  else
    SceneGradients<3>(scene).check(GetParam().method);
}

std::ostream &operator<<(std::ostream &out, const Case &given)
{
  return out << given.file << ", " << to_text(given.method);
}

/// "hertz-3d-9" as a name of tests, which have letters and digits only.
std::string name_of(const testing::TestParamInfo<Case> &info)
{
  std::string name;
  for (const char c : std::filesystem::path(info.param.file).stem().string() + "_")
    name += std::isalnum(c) ? c : '_';
  return name + to_text(info.param.method);
}

INSTANTIATE_TEST_SUITE_P(Gradient, EveryScene, testing::ValuesIn(cases()), name_of);
} // namespace
