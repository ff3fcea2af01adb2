#include <snug/sensitivity/data_derivatives.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>
#include <unit/sensitivity/velocities.h>

namespace {
using namespace snug;
using namespace snug::test;

template <int dim>
TestScene<dim> loaded_scene()
{
  auto scene = two_blocks<dim>(3, 4, 3.);
  set_design(scene, 3, 0.03);
  scene.bodies[1].refined_below                          = 0.45;
  scene.bodies[1].body_force[dim - 1]                    = -0.7;
  scene.bodies[1].loads[face_index(0, 1)].pressure       = 0.5;
  scene.bodies[1].loads[face_index(dim - 1, 1)].pressure = 0.3;
  auto &side                                             = scene.bodies[1].loads[face_index(0, 0)];
  side.traction[dim - 1]                                 = 0.2;
  side.factor              = [](const dealii::Point<dim> &x) { return 1. + x[dim - 1]; };
  side.resultant.force[0]  = 0.3;
  side.resultant.moment[2] = 0.1;
  return scene;
}

/// f - K u - B' lambda of the systems and g - B u at other positions, u and
/// lambda those of the state: what ft and ct are the derivatives of.
template <int dim>
sensitivity::KktVectors residuals_at(const Problem<dim>                 &problem,
                                     const state::ContactState<dim>     &state,
                                     const typename Problem<dim>::Field &positions)
{
  const auto               &solver = problem.solver;
  const auto               &layout = solver.gluing(0).layout();
  const auto                rows   = solver.rows(positions, 0);
  const auto                loads  = solver.loads(positions, 0);
  const auto                lambda = layout.to_local(state.dual.lambda);
  qp::MultiVector           Bu(layout.n_local());
  std::vector<feti::BEntry> B;
  sensitivity::KktVectors   result;
  for (unsigned int s = 0; s < state.u.size(); ++s)
    {
      const auto &assembler = *solver.assemblers()[s];
      auto        K         = assembler.sparsity();
      assembler.stiffness(positions, K);
      result.primal.emplace_back(state.u[s].n_rows());
      auto &r = result.primal.back();
      K.multiply_add(-1., state.u[s], r);
      r.add(1., loads[s]);
      solver.gluing(0).fill_B(s, rows, B);
      for (const auto &entry : B)
        {
          r(entry.dof) -= entry.value * lambda(entry.row);
          Bu(entry.row) += entry.value * state.u[s](entry.dof);
        }
    }
  result.dual = solver.gluing(0).right_hand_side(rows, 0);
  result.dual.add(-1., layout.to_owned(Bu));
  return result;
}

double largest(const sensitivity::KktVectors &x, bool dual)
{
  double     value   = 0.;
  const auto include = [&](const qp::MultiVector &v) {
    for (unsigned int j = 0; j < v.n_columns(); ++j)
      for (unsigned int i = 0; i < v.n_rows(); ++i)
        value = std::max(value, std::abs(v(i, j)));
  };
  if (dual)
    include(x.dual);
  else
    for (const auto &part : x.primal)
      include(part);
  return dealii::Utilities::MPI::max(value, MPI_COMM_WORLD);
}

void add(double factor, const sensitivity::KktVectors &from, sensitivity::KktVectors &to)
{
  for (unsigned int s = 0; s < to.primal.size(); ++s)
    to.primal[s].add(factor, from.primal[s]);
  to.dual.add(factor, from.dual);
}

template <int dim>
void check_data_derivatives(const sensitivity::Derivatives kind, double tolerance)
{
  Problem<dim>                    problem(loaded_scene<dim>());
  const auto                      state = problem.solve();
  const auto                      V     = column_velocities(problem);
  sensitivity::GradientParameters parameters;
  parameters.derivatives      = kind;
  const auto              all = sensitivity::data_derivatives(problem.solver, state, V, parameters);
  const unsigned int      j   = V.size() / 2;
  sensitivity::KktVectors error;
  error.primal          = all.primal.columns_from(j, 1);
  error.dual            = all.dual.columns_from(j, 1);
  const double sizes[]  = {largest(error, false), largest(error, true)};
  const double step     = 1e-3;
  const int    place[]  = {-2, -1, 1, 2};
  const double weight[] = {1. / 12., -8. / 12., 8. / 12., -1. / 12.};
  for (unsigned int k = 0; k < 4; ++k)
    {
      auto x = state.positions;
      for (unsigned int i = 0; i < x.size(); ++i)
        x[i] += place[k] * step * V[j][i];
      add(-weight[k] / step, residuals_at(problem, state, x), error);
    }
  EXPECT_LT(largest(error, false), tolerance * sizes[0]);
  EXPECT_LT(largest(error, true), tolerance * sizes[1]);
}

TEST(DataDerivatives, ExactAgainstDifferencesOfTheWhole)
{
  check_data_derivatives<2>(sensitivity::Derivatives::exact, 1e-8);
  check_data_derivatives<3>(sensitivity::Derivatives::exact, 1e-8);
}

TEST(DataDerivatives, SemiAnalyticAgainstDifferencesOfTheWhole)
{
  using sensitivity::Derivatives;
  for (const auto central : {Derivatives::central, Derivatives::refined_central})
    {
      check_data_derivatives<2>(central, 1e-6);
      check_data_derivatives<3>(central, 1e-6);
    }
  for (const auto forward : {Derivatives::forward, Derivatives::refined_forward})
    check_data_derivatives<2>(forward, 1e-3);
}
} // namespace
