#include <snug/base/errors.h>
#include <snug/qp/face_krylov.h>
#include <snug/qp/row_set.h>
#include <snug/sensitivity/tangent_system.h>

#include <algorithm>
#include <cmath>

namespace snug::sensitivity {
namespace {
/// Relative size below which a projected residual is rounding: projecting a
/// residual leaves that share of it (1e-13 on meshes of 100 cells). Iterating on
/// rounding would spoil the directions of all columns.
const double rounding = 1e-12;
} // namespace

template <int dim>
qp::FreeRows strong_rows(const state::StateSolver<dim>  &solver,
                         const state::ContactState<dim> &state)
{
  const auto           &feti       = solver.feti(state);
  const auto           &of_contact = solver.gluing(state.load_case).contact_of_row();
  qp::RowSet            rows(feti.n_owned(), 1);
  std::vector<qp::Slip> slips;
  for (unsigned int i = 0; i < rows.size(); ++i)
    if (feti.bounded()[i])
      rows[i] = state.contact[of_contact[i]].strong;
  auto w = feti.linearization().multiply_B(state.u);
  w.add(-1., feti.g());
  feti.linearization().add_compliance(-1., state.dual.lambda, w);
  const auto slides = [&](const qp::FrictionCone &cone) {
    return state.contact[of_contact[cone.normal]].friction == state::FrictionStatus::slip;
  };
  std::vector<qp::FrictionCone> sticking;
  std::copy_if(feti.cones().begin(), feti.cones().end(), std::back_inserter(sticking),
               [&](const auto &cone) { return !slides(cone); });
  for (const qp::FrictionCone &cone : feti.cones())
    for (unsigned int t = 0; t < cone.n_tangents; ++t)
      rows[cone.tangents[t]] = 0;
  qp::free_tangents(sticking, rows);
  for (const qp::FrictionCone &cone : feti.cones())
    {
      if (!rows[cone.normal] || !slides(cone))
        continue;
      qp::Slip of_cone{cone};
      if (cone.is_cornered(rows))
        of_cone.cone.n_tangents = 1;
      double slip = 0., force = 0.;
      for (unsigned int t = 0; t < of_cone.cone.n_tangents; ++t)
        {
          slip  = std::hypot(slip, w(cone.tangents[t]));
          force = std::hypot(force, state.dual.lambda(cone.tangents[t]));
        }
      of_cone.compliance = slip / cone.limit(state.dual.lambda);
      // The friction force is better known than the slip, which may be short.
      for (unsigned int t = 0; t < of_cone.cone.n_tangents; ++t)
        of_cone.direction[t] = state.dual.lambda(cone.tangents[t]) / force;
      slips.push_back(of_cone);
    }
  return {rows, slips};
}

TangentSystem::TangentSystem(const feti::LoadedProblem  &feti,
                             const qp::FreeRows         &rows,
                             const qp::SolverParameters &parameters,
                             Solves                      solves,
                             const qp::DirectionBasis   &known)
  : feti(feti), parameters(parameters), solves(solves), free_set(feti.free_set(rows)), known(known)
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
  qp::FaceKrylov krylov(feti, *free_set, known, deflates);
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

/// Return d - F mu = B K^+ (b - B' mu) - D mu - c. This form needs only one application of
/// K^+, because d is not formed separately.
qp::MultiVector TangentSystem::start_residual(const KktVectors      &right_hand_sides,
                                              const qp::MultiVector &mu) const
{
  auto unbalanced = right_hand_sides.primal;
  unbalanced.add(-1., feti.linearization().multiply_Bt(mu));
  auto residual = feti.linearization().multiply_B(feti.linearization().apply_inverse(unbalanced));
  residual.add(-1., right_hand_sides.dual);
  feti.linearization().add_compliance(-1., mu, residual);
  return residual;
}

KktVectors TangentSystem::solve(const KktVectors &right_hand_sides) const
{
  if (right_hand_sides.given.n_columns() > 0)
    {
      auto others = right_hand_sides;
      others.primal.add(-1., feti.linearization().multiply_Bt(others.given));
      others.given = qp::MultiVector(0, 0);
      auto result  = solve(others);
      result.dual.add(1., right_hand_sides.given);
      return result;
    }
  const auto &b = right_hand_sides.primal;
  KktVectors  result;
  result.dual = qp::MultiVector(feti.n_owned(), right_hand_sides.dual.n_columns());
  free_set->make_feasible(result.dual, feti.linearization().rigid_part(b));
  auto            residual  = start_residual(right_hand_sides, result.dual);
  qp::MultiVector projected = free_set->free_rows().reduced_residual(result.dual, residual);
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
  auto amplitudes =
    free_set->amplitudes(free_set->free_rows().reduced_residual(result.dual, residual));
  for (unsigned int j = 0; j < amplitudes.n_columns(); ++j)
    for (unsigned int i = 0; i < amplitudes.n_rows(); ++i)
      amplitudes(i, j) *= -1.;
  result.primal = feti.linearization().recover(b, result.dual, amplitudes);
  return result;
}

template qp::FreeRows strong_rows(const state::StateSolver<2> &, const state::ContactState<2> &);
template qp::FreeRows strong_rows(const state::StateSolver<3> &, const state::ContactState<3> &);
} // namespace snug::sensitivity
