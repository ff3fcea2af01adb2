#include <snug/base/errors.h>
#include <snug/qp/pcpg.h>
#include <snug/qp/row_set.h>
#include <snug/sensitivity/tangent_system.h>

#include <algorithm>

namespace snug::sensitivity {
namespace {
/// Relative size below which a projected residual is rounding: projecting a
/// residual leaves that share of it (1e-13 on meshes of 100 cells). Iterating on
/// rounding would spoil the directions of all columns.
const double rounding = 1e-12;
} // namespace

template <int dim>
qp::RowSet strong_rows(const state::StateSolver<dim> &solver, const state::ContactState<dim> &state)
{
  qp::RowSet  rows       = solver.feti(state).bounded();
  const auto &of_contact = solver.gluing(state.load_case).contact_of_row();
  for (unsigned int i = 0; i < rows.size(); ++i)
    rows[i] = !rows[i] || state.contact[of_contact[i]].strong;
  return rows;
}

TangentSystem::TangentSystem(const feti::LoadedProblem  &feti,
                             const qp::RowSet           &rows,
                             const qp::SolverParameters &parameters,
                             Solves                      solves,
                             const qp::DirectionBasis   &known)
  : feti(feti)
  , parameters(parameters)
  , solves(solves)
  , free_set(feti.free_set(rows))
  , known(known.off(qp::complement(rows), feti.context().communicator()))
{}

/// Return whether ||G mu - e|| of every column is within the tolerance of the sum of ||mu|| and the
/// loads before they cancel. B and R are orthonormal except for a few rows, so ||G|| is near 1.
bool TangentSystem::balanced(const feti::PrimalVectors &b, const qp::MultiVector &mu) const
{
  auto missing = feti.linearization().rigid_part(b);
  missing.add(-1., feti.apply_G(mu));
  const auto errors = qp::norms(missing, MPI_COMM_SELF);
  const auto gross  = feti.linearization().gross_rigid_part(b);
  const auto sizes  = qp::norms(mu, feti.context().communicator());
  for (unsigned int j = 0; j < errors.size(); ++j)
    if (errors[j] > parameters.relative_tolerance * (sizes[j] + gross[j]))
      return false;
  return true;
}

bool TangentSystem::minimize(qp::MultiVector           &mu,
                             qp::MultiVector           &residual,
                             const std::vector<double> &tolerances,
                             const bool                 deflates) const
{
  qp::Pcpg krylov(feti, *free_set, known, deflates);
  if (solves == Solves::block)
    return krylov.solve(mu, residual, tolerances, parameters.max_iterations).converged;
  qp::MultiVector all_mu(mu.n_rows(), 0), all_residuals(mu.n_rows(), 0);
  for (unsigned int j = 0; j < mu.n_columns(); ++j)
    {
      auto mu_j       = mu.columns_from(j, 1);
      auto residual_j = residual.columns_from(j, 1);
      if (!krylov.solve(mu_j, residual_j, {tolerances[j]}, parameters.max_iterations).converged)
        return false;
      all_mu.append(mu_j);
      all_residuals.append(residual_j);
    }
  mu       = all_mu;
  residual = all_residuals;
  return true;
}

/// Return d - F mu = B K^+ (b - B' mu) - c. This form needs only one application of
/// K^+, because d is not formed separately.
qp::MultiVector TangentSystem::start_residual(const KktVectors      &right_hand_sides,
                                              const qp::MultiVector &mu) const
{
  auto       unbalanced = right_hand_sides.primal;
  const auto forces     = feti.linearization().multiply_Bt(mu);
  for (unsigned int s = 0; s < unbalanced.size(); ++s)
    unbalanced[s].add(-1., forces[s]);
  auto residual = feti.linearization().multiply_B(feti.linearization().apply_inverse(unbalanced));
  residual.add(-1., right_hand_sides.dual);
  return residual;
}

KktVectors TangentSystem::solve(const KktVectors &right_hand_sides) const
{
  const auto &b = right_hand_sides.primal;
  KktVectors  result;
  result.dual = qp::MultiVector(feti.n_owned(), right_hand_sides.dual.n_columns());
  free_set->make_feasible(result.dual, feti.linearization().rigid_part(b));
  auto            residual  = start_residual(right_hand_sides, result.dual);
  qp::MultiVector projected = residual;
  free_set->project(projected);
  auto       tolerances = qp::norms(projected, feti.context().communicator());
  const auto sizes      = qp::norms(residual, feti.context().communicator());
  for (unsigned int j = 0; j < sizes.size(); ++j)
    tolerances[j] = std::max(parameters.relative_tolerance * tolerances[j], rounding * sizes[j]);
  if (!balanced(b, result.dual))
    throw SolveError("no derivative: a rigid body motion is not constrained, and the response "
                     "depends on it or the design changes the loads along it");
  // Where the rounding of soft modes stalls the deflated solve, repeat it without deflation.
  if (!minimize(result.dual, residual, tolerances, true) &&
      !minimize(result.dual, residual, tolerances, false))
    throw SolveError("the sensitivities were not solved to the relative "
                     "tolerance; increase 'Solver/Relative "
                     "tolerance' or 'Solver/Maximum F-mults'");
  auto amplitudes = free_set->amplitudes(residual);
  for (unsigned int j = 0; j < amplitudes.n_columns(); ++j)
    for (unsigned int i = 0; i < amplitudes.n_rows(); ++i)
      amplitudes(i, j) *= -1.;
  result.primal = feti.linearization().recover(b, result.dual, amplitudes);
  return result;
}

template qp::RowSet strong_rows(const state::StateSolver<2> &, const state::ContactState<2> &);
template qp::RowSet strong_rows(const state::StateSolver<3> &, const state::ContactState<3> &);
} // namespace snug::sensitivity
