#include <snug/sensitivity/bound_derivatives.h>
#include <snug/sensitivity/residual_gradient.h>
#include <snug/state/cell_gradients.h>
#include <snug/state/contact_results.h>
#include <snug/state/point_results.h>

namespace snug::sensitivity {
namespace {
template <int dim>
using Field = mesh::Field<dim>;

/// Add d/dX (eta'(g - B u) - lambda'B w) to @p gradient. Collective.
template <int dim>
void add_rows(const state::StateSolver<dim>  &solver,
              const state::ContactState<dim> &state,
              const KktVectors               &adjoint,
              unsigned int                    j,
              Field<dim>                     &gradient)
{
  const auto &surface = solver.surface();
  const auto &contact = solver.contact(state.load_case);
  const auto &gluing  = solver.gluing(state.load_case);
  const auto &X       = state.surface_positions;
  const auto  rows    = contact.rows(X);
  auto        both    = state.dual.lambda; // and -eta
  both.append(qp::MultiVector(both.n_rows()));
  for (unsigned int i = 0; i < both.n_rows(); ++i)
    both(i, 1) = -adjoint.dual(i, j);
  const auto forces    = gluing.row_forces(both);
  const auto lambda    = contact.forces(rows, forces[0].contact);
  const auto minus_eta = contact.forces(rows, forces[1].contact);
  // The contact energy force (c.u - gap) without its gap is linear in u.
  auto       sum       = state.surface_displacement;
  const auto of_u      = contact.energy_gradient(X, sum, minus_eta);
  auto       ties      = solver.ties().energy_gradient(X, sum, forces[1].ties);
  sum                  = surface.gather(state::nodal_values(solver, adjoint.primal, j));
  const auto of_w      = contact.energy_gradient(X, sum, lambda);
  const auto ties_of_w = solver.ties().energy_gradient(X, sum, forces[0].ties);
  sum.assign(sum.size(), {});
  auto total = contact.energy_gradient(X, sum, lambda);
  for (unsigned int a = 0; a < total.size(); ++a)
    total[a] += of_u[a] - of_w[a] + ties[a] - ties_of_w[a];
  if (!solver.points().empty())
    {
      const auto all = solver.rows(state.positions, state.load_case);
      const auto add = [&](const feti::PrimalVectors &of, const unsigned int column,
                           const std::vector<double> &row_forces, const double factor) {
        const auto q = state::point_motions(solver, of, column);
        const auto G = solver.points().energy_gradient(X, q, row_forces, all, contact);
        for (unsigned int a = 0; a < total.size(); ++a)
          total[a] += factor * G[a];
      };
      add(state.u, 0, forces[1].all, 1.);
      add(adjoint.primal, j, forces[0].all, -1.);
    }
  surface.add_owned(total, gradient);
}

/// Add the same derivative for the springs, eta'(D lambda - B u) - lambda'B w, where D lambda = B u
/// and D eta = B w.
template <int dim>
void add_springs(const state::StateSolver<dim>  &solver,
                 const state::ContactState<dim> &state,
                 const KktVectors               &adjoint,
                 unsigned int                    j,
                 Field<dim>                     &gradient)
{
  if (solver.springs().empty())
    return;
  const auto &gluing = solver.gluing(state.load_case);
  solver.springs().add_energy_gradient(state.positions,
                                       gluing.spring_forces(state.dual.lambda.column(0)),
                                       state.displacement,
                                       gluing.spring_forces(adjoint.dual.column(j)),
                                       state::nodal_values(solver, adjoint.primal, j), -1.,
                                       gradient);
}

/// Add the same derivative for the supports, where q . u = s and q . w = 0.
template <int dim>
void add_held(const state::StateSolver<dim>  &solver,
              const state::ContactState<dim> &state,
              const KktVectors               &adjoint,
              unsigned int                    j,
              Field<dim>                     &gradient)
{
  if (!solver.held().follow_positions())
    return;
  const auto rows = solver.rows(state.positions, state.load_case);
  Field<dim> sum(gradient.size());
  solver.held().add_energy_gradient(
    state.positions, state.displacement,
    solver.gluing(state.load_case).reactions(adjoint.dual.columns_from(j, 1), rows), sum);
  solver.held().add_energy_gradient(
    state.positions, state::nodal_values(solver, adjoint.primal, j),
    solver.gluing(state.load_case).reactions(state.dual.lambda, rows), sum);
  for (unsigned int a = 0; a < sum.size(); ++a)
    gradient[a] -= sum[a];
}
} // namespace

template <int dim>
void add_residual_gradient(const state::StateSolver<dim>  &solver,
                           const state::ContactState<dim> &state,
                           const KktVectors               &adjoint,
                           unsigned int                    j,
                           mesh::Field<dim>               &gradient)
{
  const auto w = adjoint.primal.columns_from(j, 1);
  state::add_stiffness_gradient(solver, state, w, -1., gradient);
  state::add_load_gradient(solver, state, w, 1., gradient);
  add_rows(solver, state, adjoint, j, gradient);
  add_springs(solver, state, adjoint, j, gradient);
  add_held(solver, state, adjoint, j, gradient);
  if (adjoint.given.n_columns() > 0)
    add_bound_gradient(solver, state, adjoint.given, j, gradient);
}

#define SNUG_INSTANTIATE(dim)                                                               \
  template void add_residual_gradient(const state::StateSolver<dim> &,                      \
                                      const state::ContactState<dim> &, const KktVectors &, \
                                      unsigned int, mesh::Field<dim> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::sensitivity
