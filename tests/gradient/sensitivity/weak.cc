#include <snug/sensitivity/data_derivatives.h>
#include <snug/sensitivity/one_sided.h>
#include <snug/sensitivity/tangent_system.h>
#include <snug/state/contact_results.h>

#include <gradient/sensitivity/differences.h>

namespace {
using namespace snug;
using namespace snug::test;

TestScene<2> curved_scene(double pressure)
{
  auto scene = two_blocks<2>(8, 8, 3.);
  set_design(scene, 4, 0.04);
  scene.bodies[0].loads[face_index(1, 1)].pressure = pressure;
  scene.solver.relative_tolerance                  = 1e-13;
  return scene;
}

std::vector<state::ContactPoint> contacts_under(double pressure)
{
  return Problem<2>(curved_scene(pressure)).solve().contact;
}

/**
 * The load below @p pressure at which the first contact opens. As long as
 * contacts stay what they are, forces are linear in the load: two loads
 * give the force that vanishes first.
 */
double weakening_pressure(double pressure)
{
  const double below    = 0.999 * pressure;
  const auto   contacts = contacts_under(pressure), less = contacts_under(below);
  double       largest = 0.;
  for (unsigned int i = 0; i < contacts.size(); ++i)
    {
      EXPECT_EQ(contacts[i].strong, less[i].strong);
      const double slope = (contacts[i].force - less[i].force) / (pressure - below);
      if (contacts[i].strong && slope > 0.)
        largest = std::max(largest, pressure - contacts[i].force / slope);
    }
  return largest;
}

/// A scene with one weakly active contact.
class Weak : public ::testing::Test
{
protected:
  const double                          pressure = weakening_pressure(10.);
  GradientScene<2>                      scene{curved_scene(pressure), 0.05};
  state::ContactState<2>                state = scene.solve(scene.design);
  const sensitivity::GradientParameters parameters;

  std::vector<std::vector<double>> directions() const
  {
    auto list = test_directions(scene.basis->n_variables());
    for (unsigned int j = 0; j < scene.basis->n_variables(); ++j)
      {
        list.emplace_back(scene.basis->n_variables());
        list.back()[j] = 1.;
      }
    for (auto direction : std::vector<std::vector<double>>(list))
      {
        for (double &component : direction)
          component *= -1.;
        list.push_back(direction);
      }
    return list;
  }

  /// ft and ct along directions of the design, a column each.
  sensitivity::KktVectors data(const std::vector<std::vector<double>> &directions) const
  {
    std::vector<mesh::BodyMesh<2>::Field> V;
    for (const auto &direction : directions)
      V.push_back(scene.basis->apply(direction));
    return sensitivity::data_derivatives(scene.problem.solver, state, V, parameters);
  }

  mesh::BodyMesh<2>::Field displacement(const sensitivity::KktVectors &derivatives,
                                        unsigned int                   j) const
  {
    return state::nodal_values(scene.problem.solver, derivatives.primal, j);
  }

  /// lim (u(a + t b) - u(a)) / t by the one-sided formula of second order.
  mesh::BodyMesh<2>::Field one_sided_difference(const std::vector<double> &direction, double t)
  {
    mesh::BodyMesh<2>::Field result(state.displacement.size());
    const double             weight[] = {-1.5, 2., -0.5};
    for (unsigned int k = 0; k < 3; ++k)
      {
        auto design = scene.design;
        for (unsigned int i = 0; i < design.size(); ++i)
          design[i] += k * t * direction[i];
        const auto there = k == 0 ? state : scene.solve(design);
        for (unsigned int node = 0; node < result.size(); ++node)
          result[node] += weight[k] / t * there.displacement[node];
      }
    return result;
  }

  /// Largest |a - b| over largest |b| at the nodes of all ranks.
  static double error(const mesh::BodyMesh<2>        &mesh,
                      const mesh::BodyMesh<2>::Field &a,
                      const mesh::BodyMesh<2>::Field &b)
  {
    double difference = 0., size = 0.;
    for (const auto &cell : mesh.cells())
      for (const unsigned int node : cell.nodes)
        {
          difference = std::max(difference, (a[node] - b[node]).norm());
          size       = std::max(size, b[node].norm());
        }
    return dealii::Utilities::MPI::max(difference, MPI_COMM_WORLD) /
           dealii::Utilities::MPI::max(size, MPI_COMM_WORLD);
  }
};

TEST_F(Weak, IsRecognized)
{
  EXPECT_EQ(state.weak_contacts, 1u);
  EXPECT_LT(state.contact_change_margin, 1e-9);
  EXPECT_FALSE(scene.gradients(state, {"compliance"}, {}).of_response[0].differentiable);
  EXPECT_TRUE(scene.gradients(state, {"potential energy"}, {}).of_response[0].differentiable);
  const auto away = Problem<2>(curved_scene(1.01 * pressure)).solve();
  EXPECT_EQ(away.weak_contacts, 0u);
  EXPECT_GT(away.contact_change_margin, 1e-4);
}

TEST_F(Weak, QuadraticProgramGivesEveryOneSidedDerivative)
{
  const auto list  = directions();
  const auto right = data(list);
  const auto both  = sensitivity::directional_derivatives(scene.problem.solver, state, right);
  const auto strong =
    sensitivity::TangentSystem(scene.problem.solver.feti(state),
                               sensitivity::strong_rows(scene.problem.solver, state),
                               scene.problem.model.solver, sensitivity::Solves::block,
                               state.dual.directions)
      .solve(right);
  std::vector<mesh::BodyMesh<2>::Field> by_qp, by_strong;
  for (unsigned int j = 0; j < list.size(); ++j)
    {
      by_qp.push_back(displacement(both, j));
      by_strong.push_back(displacement(strong, j));
    }
  double worst_strong = 0.;
  for (unsigned int j = 0; j < list.size(); ++j)
    {
      const auto expected = one_sided_difference(list[j], 1e-5);
      EXPECT_LT(error(scene.problem.mesh, by_qp[j], expected), 1e-5) << j;
      worst_strong = std::max(worst_strong, error(scene.problem.mesh, by_strong[j], expected));
    }
  EXPECT_GT(worst_strong, 1e-2);
}

TEST_F(Weak, DerivativesOfResponsesDependOnTheSide)
{
  sensitivity::Responses<2>      responses;
  const std::vector<std::string> names = {"compliance", "strain energy", "potential energy"};
  for (const auto &name : names)
    responses.push_back(scene.responses.at(name).get());
  const auto found     = sensitivity::one_sided_gradients(scene.at(state, parameters), responses);
  const auto energy    = scene.gradients(state, {"potential energy"}, {}).of_response[0].values;
  double     jump      = 0.;
  const unsigned int k = scene.basis->n_variables();
  const double       t = 1e-5;
  for (unsigned int j = 0; j < k; ++j)
    for (const double sign : {1., -1.})
      {
        std::vector<double> slope(names.size());
        const double        weight[] = {-1.5, 2., -0.5};
        for (unsigned int p = 0; p < 3; ++p)
          {
            auto design = scene.design;
            design[j] += sign * p * t;
            const auto values = scene.values(design).responses;
            for (unsigned int i = 0; i < names.size(); ++i)
              slope[i] += sign * weight[p] / t * values.at(names[i]);
          }
        for (unsigned int i = 0; i < names.size(); ++i)
          {
            const auto &gradient = sign > 0. ? found[i].increasing : found[i].decreasing;
            EXPECT_NEAR(gradient[j], slope[i], 1e-5 * norm(gradient))
              << names[i] << " " << j << " " << sign;
          }
        EXPECT_NEAR(energy[j], slope[2], 1e-6 * norm(energy));
        jump = std::max(jump, std::abs(found[0].increasing[j] - found[0].decreasing[j]) /
                                norm(found[0].increasing));
      }
  EXPECT_GT(jump, 1e-2);
}

TEST_F(Weak, AwayFromItBothSidesAgree)
{
  GradientScene<2> regular(curved_scene(1.05 * pressure), 0.05);
  const auto       there    = regular.solve(regular.design);
  const auto       sides    = sensitivity::one_sided_gradients(regular.at(there, parameters),
                                                               {regular.responses["compliance"].get()});
  const auto       gradient = regular.gradients(there, {"compliance"}, {}).of_response[0].values;
  EXPECT_LT(relative_error(sides[0].increasing, gradient), 1e-10);
  EXPECT_LT(relative_error(sides[0].decreasing, gradient), 1e-10);
}
} // namespace
