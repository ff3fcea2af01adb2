#include <snug/response/response.h>
#include <snug/state/cell_gradients.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>
#include <unit/state/test_scene.h>

namespace {
using namespace snug;
using namespace snug::test;

/// Loads on both bodies, hanging nodes, a curved punch, random heights.
template <int dim>
TestScene<dim> loaded_scene(unsigned int degree)
{
  auto scene   = two_blocks<dim>(3, 4, 3.);
  scene.degree = degree;
  set_design(scene, 3, 0.03);
  for (auto &body : scene.bodies)
    {
      body.refined_below                    = 0.45;
      body.body_force[dim - 1]              = -0.7;
      body.loads[face_index(0, 1)].pressure = 0.5;
    }
  scene.bodies[1].loads[face_index(0, 1)].traction[dim - 1] = -0.4;
  auto &top                    = scene.bodies[0].loads[face_index(dim - 1, 1)];
  top.resultant.force[dim - 1] = -2.;
  top.resultant.moment[2]      = 0.1;
  if (dim == 3)
    top.resultant.moment[0] = 0.2;
  top.factor = [](const dealii::Point<dim> &x) { return 1. + 0.5 * x[0]; };
  return scene;
}

/// A smooth velocity of all nodes; hanging ones follow their masters.
template <int dim>
typename Problem<dim>::Field smooth_velocity(const Problem<dim> &problem)
{
  auto V = problem.mesh.reference_positions();
  for (auto &v : V)
    {
      const auto x = v;
      for (unsigned int c = 0; c < dim; ++c)
        v[c] = std::sin(1. + c + 2. * x[0] + x[1]) * std::cos(x[dim - 1]);
    }
  problem.mesh.interpolate_hanging(V);
  return V;
}

/// With its defaults.
template <int dim>
std::unique_ptr<response::Response<dim>> of_quantity(const std::string &name)
{
  response::ResponseParameters parameters;
  parameters.quantity = name;
  return response::make_response<dim>(parameters);
}

/// Below the least scaled Jacobian of all cells, and next to it for large p.
template <int dim>
void expect_least_scaled_jacobian(unsigned int degree)
{
  Problem<dim>             problem(loaded_scene<dim>(degree));
  state::ContactState<dim> state;
  state.positions    = problem.positions(problem.scene.design);
  const double least = problem.solver.solve(state.positions, qp::WarmStart()).least_scaled_jacobian;
  double       before = -1e9;
  for (const double p : {2., 8., 30., 1000.})
    {
      response::ResponseParameters parameters;
      parameters.quantity = "least scaled Jacobian";
      parameters.exponent = p;
      const double J      = response::make_response<dim>(parameters)->value(problem.solver, state);
      EXPECT_LE(J, least + 1e-12);
      EXPECT_GT(J, before);
      before = J;
    }
  EXPECT_NEAR(before, least, 0.02 * (1. - least));
}

TEST(Responses, LeastScaledJacobianIsNextToTheLeast)
{
  for (const unsigned int degree : {1, 2})
    {
      expect_least_scaled_jacobian<2>(degree);
      expect_least_scaled_jacobian<3>(degree);
    }
}

double sum(double mine)
{
  return dealii::Utilities::MPI::sum(mine, MPI_COMM_WORLD);
}

template <int dim>
double dot(const typename Problem<dim>::Field &a, const typename Problem<dim>::Field &b)
{
  double product = 0.;
  for (unsigned int i = 0; i < a.size(); ++i)
    product += a[i] * b[i];
  return sum(product);
}

/// u'Ku/2, f'u and lambda'(Bu - g) with K, f, B and g at other positions,
/// u and lambda those of the state.
struct Parts
{
  double strain_energy = 0., work = 0., contact = 0.;
};

template <int dim>
Parts parts_at(const Problem<dim>                 &problem,
               const state::ContactState<dim>     &state,
               const typename Problem<dim>::Field &positions)
{
  const auto               &solver = problem.solver;
  const auto                rows   = solver.rows(positions, 0);
  const auto                loads  = solver.loads(positions, 0);
  const auto                lambda = solver.gluing(0).layout().to_local(state.dual.lambda);
  std::vector<feti::BEntry> B;
  Parts                     parts;
  for (unsigned int s = 0; s < state.u.size(); ++s)
    {
      const auto     &assembler = *solver.assemblers()[s];
      auto            K         = assembler.sparsity();
      qp::MultiVector Ku(state.u[s].n_rows());
      assembler.stiffness(positions, K);
      K.multiply_add(1., state.u[s], Ku);
      for (unsigned int i = 0; i < Ku.n_rows(); ++i)
        {
          parts.strain_energy += state.u[s](i) * Ku(i) / 2;
          parts.work += state.u[s](i) * loads[s](i);
        }
      solver.gluing(0).fill_B(s, rows, B);
      for (const auto &entry : B)
        parts.contact += lambda(entry.row) * entry.value * state.u[s](entry.dof);
    }
  const auto g = solver.gluing(0).right_hand_side(rows, 0);
  for (unsigned int i = 0; i < g.n_rows(); ++i)
    parts.contact -= state.dual.lambda(i) * g(i);
  return {sum(parts.strain_energy), sum(parts.work), sum(parts.contact)};
}

template <int dim>
void check_gradients(unsigned int degree)
{
  Problem<dim> problem(loaded_scene<dim>(degree));
  const auto   state = problem.solve();
  const auto   V     = smooth_velocity(problem);
  const double step  = 1e-3;
  Parts        slope;
  const int    place[]  = {-2, -1, 1, 2};
  const double weight[] = {1. / 12., -8. / 12., 8. / 12., -1. / 12.};
  for (unsigned int k = 0; k < 4; ++k)
    {
      auto x = state.positions;
      for (unsigned int i = 0; i < x.size(); ++i)
        x[i] += place[k] * step * V[i];
      const Parts at = parts_at(problem, state, x);
      slope.strain_energy += weight[k] / step * at.strain_energy;
      slope.work += weight[k] / step * at.work;
      slope.contact += weight[k] / step * at.contact;
    }
  std::map<std::string, double> partial, total;
  for (const std::string name : {"potential energy", "compliance", "strain energy"})
    {
      const auto response = of_quantity<dim>(name);
      auto       gradient = response->partials(problem.solver, state).positions;
      partial[name]       = dot<dim>(gradient, V);
      if (!response->stationary())
        continue;
      state::add_constraint_gradient(problem.solver, state, gradient);
      total[name] = dot<dim>(gradient, V);
    }
  // round-off and the fourth order error are near 1e-11
  const double same =
    1e-8 * (std::abs(slope.strain_energy) + std::abs(slope.work) + std::abs(slope.contact));
  EXPECT_NEAR(partial["strain energy"], slope.strain_energy, same);
  EXPECT_NEAR(partial["compliance"], slope.work, same);
  EXPECT_NEAR(partial["potential energy"], slope.strain_energy - slope.work, same);
  EXPECT_NEAR(total["potential energy"], slope.strain_energy - slope.work + slope.contact, same);
  EXPECT_EQ(total.size(), 1u);
}

TEST(Response, PositionGradients2D)
{
  check_gradients<2>(1);
  check_gradients<2>(2);
}

TEST(Response, PositionGradients3D)
{
  check_gradients<3>(1);
}

/// J of u + v, from K and f of the systems; -1 and 1/2 weights of both.
double quadratic(const feti::LoadedProblem &feti,
                 const feti::PrimalVectors &u,
                 double                     of_strain_energy,
                 double                     of_work)
{
  double value = 0.;
  for (unsigned int s = 0; s < u.size(); ++s)
    {
      const auto     &system = feti.linearization().subdomains()[s];
      qp::MultiVector Ku(u[s].n_rows());
      system.K.multiply_add(1., u[s], Ku);
      for (unsigned int i = 0; i < Ku.n_rows(); ++i)
        value += u[s](i) * (of_strain_energy * Ku(i) / 2 + of_work * feti.loads()[s](i));
    }
  return sum(value);
}

TEST(Response, ValuesAndStateGradients)
{
  Problem<3>  problem(loaded_scene<3>(1));
  const auto  state = problem.solve();
  const auto &feti  = problem.solver.feti(state);
  // central differences of a quadratic are exact
  const std::map<std::string, std::pair<double, double>> weights = {{"potential energy", {1., -1.}},
                                                                    {"compliance", {0., 1.}},
                                                                    {"strain energy", {1., 0.}}};
  for (const auto &[name, weight] : weights)
    {
      const auto response = of_quantity<3>(name);
      const auto gradient = response->partials(problem.solver, state).u;
      auto       plus = state.u, minus = state.u;
      double     slope = 0.;
      for (unsigned int s = 0; s < plus.size(); ++s)
        for (unsigned int i = 0; i < plus[s].n_rows(); ++i)
          {
            const double v = 0.01 * std::sin(1. + i + 3. * s);
            plus[s](i) += v;
            minus[s](i) -= v;
            slope += gradient[s](i) * v;
          }
      const double value = quadratic(feti, plus, weight.first, weight.second);
      const double other = quadratic(feti, minus, weight.first, weight.second);
      EXPECT_NEAR(sum(slope), (value - other) / 2, 1e-12 * (std::abs(value) + std::abs(other)));
      EXPECT_NEAR(response->value(problem.solver, state),
                  quadratic(feti, state.u, weight.first, weight.second),
                  1e-8 * std::abs(state.energy))
        << name;
    }
}

TEST(Response, VolumeOfBentBodies)
{
  // boxes of volume 1; the flat punch, the foundation under mean height
  // 0.02: (0 + 0.02 + 0.04) / 3 is the mean of three Bernstein heights
  auto scene           = two_blocks<2>(3, 4, 0.);
  scene.control_points = {3, 1};
  scene.design         = {0., 0.02, 0.04};
  scene.degree         = 2; // reproduces the parabola
  Problem<2> problem(scene);
  const auto state = problem.solve();
  EXPECT_NEAR(of_quantity<2>("volume")->value(problem.solver, state), 2.02, 1e-13);
}
} // namespace
