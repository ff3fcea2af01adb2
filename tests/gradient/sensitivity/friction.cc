#include <snug/sensitivity/tangent_system.h>

#include <gradient/sensitivity/check_responses.h>

namespace {
using namespace snug;
using namespace snug::test;

/// Displacement of the punch at the factor 1.
template <int dim>
const double aside_by = dim == 2 ? 0.025 : 0.014;

/// A curved punch on a foundation with a shaped top. The top of the punch is moved down and, by
/// @p factors per load step, aside. Some contacts slip, others stick.
template <int dim>
TestScene<dim> pushed_punch(unsigned int               n_cells,
                            contact::Method            method,
                            const std::vector<double> &factors = {1.2})
{
  auto scene = two_blocks<dim>(n_cells, n_cells, 20.);
  set_design(scene, 4, 0.04);
  scene.bodies[0].supports.clear();
  scene.bodies[0].loads.clear();
  scene.bodies[1].loads[face_index(0, 1)].pressure = 0.5;
  scene.bodies[0].material                         = {1000., 0.3, 0.2};
  scene.bodies[1].material                         = {800., 0.25, 0.7, 0., 20.};
  supports::Support<dim> down{0, face_index(dim - 1, 1), dim - 1, {}, "down"}, aside = down,
                                                                               along = down;
  aside.component                                                                    = 0;
  along.component                                                                    = 1;
  for (const double factor : factors)
    {
      const auto moved = [](const double by) { return [by](const auto &) { return by; }; };
      down.values.push_back(moved(-0.015));
      aside.values.push_back(moved(aside_by<dim> * factor));
      along.values.push_back(moved(0.005 * factor));
      scene.cases.push_back({scene.bodies[0].loads, scene.bodies[1].loads});
    }
  scene.bodies[0].prescribed = {down, aside};
  if (dim == 3)
    scene.bodies[0].prescribed.push_back(along);
  scene.are_steps                 = true;
  scene.method                    = method;
  scene.friction                  = contact::Friction::Coulomb;
  scene.friction_value            = "0.3";
  scene.solver.relative_tolerance = 1e-12;
  return scene;
}

/// Contacts change between stick and slip at larger steps.
const double small_step = 2e-5;

/// Relative error of gradients against differences of the fourth order.
const double tolerance = 1e-8;

/// Errors of the states add up over the steps.
const double steps_tolerance = 5. * method_tolerance;

const std::vector<double> path = {1., 1.4, 0.4, -1.2, -0.3};

template <int dim>
void check(const TestScene<dim> &given)
{
  GradientScene<dim> scene(given, 0.05);
  const auto         state = scene.solve(scene.design);
  EXPECT_GT(state.slipping_contacts, 0u);
  EXPECT_LT(state.slipping_contacts, state.active_contacts);
  check_derivatives(scene, small_step, tolerance);
  check_responses(scene, {}, small_step, tolerance);
}

TEST(FrictionGradient, Nodal2D)
{
  check(pushed_punch<2>(12, contact::Method::nodal));
}

TEST(FrictionGradient, Mortar2D)
{
  auto scene            = pushed_punch<2>(12, contact::Method::mortar);
  scene.bodies[0].cells = {10, 10};
  check(scene);
}

TEST(FrictionGradient, Nodal3D)
{
  check(pushed_punch<3>(6, contact::Method::nodal));
}

TEST(FrictionGradient, Mortar3D)
{
  auto scene            = pushed_punch<3>(6, contact::Method::mortar);
  scene.bodies[0].cells = {5, 5, 5};
  check(scene);
}

TEST(FrictionGradient, OnClustersOfSubdomains)
{
  auto scene         = pushed_punch<2>(12, contact::Method::nodal);
  scene.subdomains   = 16;
  scene.cluster_edge = 2;
  check(scene);
}

TEST(FrictionGradient, OnSprings)
{
  auto scene                                 = pushed_punch<2>(12, contact::Method::nodal);
  scene.bodies[1].supports[face_index(1, 0)] = {0};
  scene.bodies[1].springs[face_index(1, 0)]  = {{1, 20000.}};
  check(scene);
}

/// Derivatives at fixed limits of the friction forces, as under the Tresca law, are wrong.
TEST(FrictionGradient, LimitsFollowTheNormalForces)
{
  GradientScene<2>                      scene(pushed_punch<2>(12, contact::Method::nodal), 0.05);
  const auto                            state = scene.solve(scene.design);
  const sensitivity::GradientParameters parameters;
  const auto                            problem = scene.at(state, parameters);
  const auto rows  = sensitivity::strong_rows(scene.problem.solver, state);
  auto       slips = rows.slips();
  for (auto &slip : slips)
    slip.cone.coefficient = 0.;
  const auto direction   = test_directions(scene.basis->n_variables()).front();
  const auto derivatives = [&](const qp::FreeRows &of_rows) {
    return nodal(scene.problem,
                 sensitivity::TangentSystem(scene.problem.solver.feti(state), of_rows,
                                            scene.problem.solver.model().solver,
                                            sensitivity::Solves::block, state.dual.directions)
                   .solve(sensitivity::residual_derivatives(problem)),
                 direction);
  };
  const auto following = derivatives(rows), frozen = derivatives({rows.rows(), slips});
  const auto exact = scene.differences(direction, small_step).displacement;
  EXPECT_LT(field_error(scene.problem, following, exact), tolerance);
  EXPECT_GT(field_error(scene.problem, frozen, exact), 1e-3);
}

/// The bounds change with the areas of the contacts.
template <int dim>
TestScene<dim> with_bound(TestScene<dim> scene, const std::string &bound)
{
  scene.friction       = contact::Friction::Tresca;
  scene.friction_value = bound;
  return scene;
}

TEST(FrictionGradient, Bound2D)
{
  check(with_bound(pushed_punch<2>(12, contact::Method::nodal), "2+3*x"));
}

TEST(FrictionGradient, Bound3D)
{
  auto scene            = with_bound(pushed_punch<3>(5, contact::Method::mortar), "1+2*x");
  scene.bodies[0].cells = {4, 4, 4};
  check(scene);
}

/// Values of all responses at the end of all load steps.
template <int dim>
std::vector<state::ContactState<dim>> steps(GradientScene<dim>        &scene,
                                            const std::vector<double> &design)
{
  std::vector<state::ContactState<dim>> states;
  const auto positions = shape::positions(scene.problem.mesh, *scene.basis, design);
  for (unsigned int c = 0; c < scene.problem.model.load_cases.size(); ++c)
    states.push_back(scene.problem.solver.solve(positions, qp::WarmStart(), c, states));
  return states;
}

/// Adjoint and direct gradients of all responses of the last steps, in which the slip has turned
/// round, against each other and against differences.
template <int dim>
void check_steps(const TestScene<dim> &given)
{
  GradientScene<dim> scene(given, 0.05);
  add_all_responses(scene);
  const auto                          states = steps(scene, scene.design);
  sensitivity::LoadCases<dim>         load_cases, direct_cases;
  sensitivity::MeasuredResponses<dim> measured;
  sensitivity::GradientParameters     adjoint, direct;
  adjoint.method = sensitivity::Method::adjoint;
  direct.method  = sensitivity::Method::direct;
  for (const auto &state : states)
    {
      EXPECT_GT(state.slipping_contacts, 0u);
      load_cases.push_back(scene.at(state, adjoint));
      direct_cases.push_back(scene.at(state, direct));
    }
  for (const unsigned int step : {2u, 4u})
    for (const auto &[name, response] : scene.responses)
      measured.push_back({response.get(), step});
  const auto          by_adjoint = sensitivity::gradients(load_cases, measured).of_response;
  const auto          by_direct  = sensitivity::gradients(direct_cases, measured).of_response;
  const auto          direction  = test_directions(scene.basis->n_variables()).front();
  std::vector<double> exact(measured.size(), 0.);
  const double        weight[] = {1. / 12., -8. / 12., 8. / 12., -1. / 12.};
  const int           place[]  = {-2, -1, 1, 2};
  for (unsigned int k = 0; k < 4; ++k)
    {
      auto moved = scene.design;
      for (unsigned int i = 0; i < moved.size(); ++i)
        moved[i] += place[k] * small_step * direction[i];
      const auto there = steps(scene, moved);
      for (unsigned int i = 0; i < measured.size(); ++i)
        exact[i] +=
          weight[k] / (small_step)*measured[i].response->value(scene.problem.solver,
                                                               there[measured[i].load_case]);
    }
  unsigned int i = 0;
  for (const unsigned int step : {2u, 4u})
    for (const auto &[name, response] : scene.responses)
      {
        SCOPED_TRACE(name + " of step " + std::to_string(step));
        const auto &gradient = by_adjoint[i].values;
        EXPECT_LT(relative_error(gradient, by_direct[i].values), steps_tolerance);
        EXPECT_LT(std::abs(dot(gradient, direction) - exact[i]) /
                    (norm(gradient) * norm(direction)),
                  tolerance);
        ++i;
      }
}

TEST(FrictionGradient, Steps2D)
{
  check_steps(pushed_punch<2>(11, contact::Method::nodal, path));
}

TEST(FrictionGradient, StepsOfBound)
{
  check_steps(with_bound(pushed_punch<2>(12, contact::Method::nodal, path), "2"));
}

TEST(FrictionGradient, StepsMortar3D)
{
  auto scene            = pushed_punch<3>(5, contact::Method::mortar, path);
  scene.bodies[0].cells = {4, 4, 4};
  check_steps(scene);
}
} // namespace
