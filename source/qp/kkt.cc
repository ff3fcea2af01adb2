#include <snug/qp/held_sets.h>
#include <snug/qp/kkt.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace snug::qp {
namespace {
/// Minimum of the scale of residuals, as a part of the residual before its projection.
const double least_part = 1e-10;

/// A projected residual below this part of the residual before its projection may be rounding of F.
/// This occurs for slender subdomains, whose K^+ loses many digits.
const double suspect_part = 1e-6;

/// A scale of this many times the rounding of F makes tolerances of 1e-6 attainable.
const double above_rounding = 1e8;

/// Return row i of the natural residual: w_i for equalities, -min(lambda_i F_ii, -w_i) for
/// contacts. It is zero where lambda_i, -w_i >= 0 and one of them vanishes. lambda_i F_ii is a
/// length like w_i, so all rows have equal weight.
double natural_residual(const DualProblem &problem,
                        const MultiVector &lambda,
                        const MultiVector &w,
                        unsigned int       i)
{
  if (!problem.bounded()[i])
    return w(i);
  return -std::min(lambda(i) * problem.diagonal()[i], -w(i));
}

/// Set the rows of a cone to (P(lambda_T + c w_T) - lambda_T) / c with c = 1 / F_TT, where P is the
/// projection onto the cone: zero if lambda_T is in the cone and opposes the slip w_T with its full
/// limit.
void set_natural_residual(const DualProblem  &problem,
                          const FrictionCone &cone,
                          const MultiVector  &lambda,
                          const MultiVector  &w,
                          MultiVector        &residual)
{
  const double F = cone.compliance(problem.diagonal()), limit = cone.limit(lambda);
  const auto   x      = cone.acting(lambda).trial_force(F, lambda, w);
  const double length = std::hypot(x[0], x[1]);
  for (unsigned int t = 0; t < cone.n_tangents; ++t)
    residual(cone.tangents[t]) =
      F * (x[t] * (length > limit ? limit / length : 1.) - lambda(cone.tangents[t]));
}
} // namespace

double load_scale(const DualProblem &problem, const MultiVector &lambda, double scale)
{
  const MPI_Comm comm    = problem.context().communicator();
  double         softest = 0.;
  for (const double F_ii : problem.diagonal())
    softest = std::max(softest, F_ii);
  MPI_Allreduce(MPI_IN_PLACE, &softest, 1, MPI_DOUBLE, MPI_MAX, comm);
  const double force = norms(lambda, comm)[0] + (softest > 0. ? scale / softest : 0.);
  return norms(problem.e(), MPI_COMM_SELF)[0] + problem.feasibility_scale(force);
}

KktResidual kkt_residual(const DualProblem &problem,
                         const MultiVector &rigid,
                         const MultiVector &lambda,
                         const MultiVector &residual,
                         double             scale)
{
  const MPI_Comm comm = problem.context().communicator();
  KktResidual    kkt;
  kkt.amplitudes = MultiVector(problem.e().n_rows());
  // On the rows of a face alpha = -(G_M G_M')^+ G_M (d - F lambda) makes w vanish as far as rigid
  // motions can.
  kkt.amplitudes.add(-1., rigid);
  kkt.w = residual;
  kkt.w.add(1., problem.apply_Gt(kkt.amplitudes));

  MultiVector both(problem.n_owned(), 0);
  both.append(kkt.w);
  both.append(residual);
  for (unsigned int i = 0; i < problem.n_owned(); ++i)
    both(i, 0) = natural_residual(problem, lambda, kkt.w, i);
  for (const FrictionCone &cone : problem.cones())
    set_natural_residual(problem, cone, lambda, kkt.w, both);
  const auto sizes = norms(both, comm);
  // w = (d - F lambda) + G'alpha. Where nearly all of d - F lambda is rigid motion, the two terms
  // cancel, and the remainder is their rounding error.
  kkt.rounding = projection_rounding * sizes[1];

  MultiVector missing = problem.e();
  missing.add(-1., problem.apply_G(lambda));
  // Do not sum over ranks, because coarse vectors are equal on all ranks and would count
  // repeatedly.
  const double imbalance = norms(missing, MPI_COMM_SELF)[0];
  kkt.feasibility        = imbalance > 0. ? imbalance / load_scale(problem, lambda, scale) : 0.;
  kkt.relative           = kkt.feasibility + (sizes[0] <= kkt.rounding ? 0. : sizes[0] / scale);
  if (!std::isfinite(kkt.relative))
    throw SolveError("the contact forces are not finite numbers; check "
                     "stiffness, loads and gaps");
  return kkt;
}

double
recurrence_error(const DualProblem &problem, const MultiVector &residual, const unsigned int steps)
{
  MultiVector parts = problem.d();
  parts.add(-1., residual);
  parts.append(problem.d());
  const auto sizes = norms(parts, problem.context().communicator()); // of F lambda and of d
  return std::numeric_limits<double>::epsilon() * steps * (sizes[0] + sizes[1]);
}

std::vector<double> force_rounding(const DualProblem &problem,
                                   const MultiVector &lambda,
                                   const KktResidual &kkt,
                                   double             scale,
                                   double             tolerance)
{
  // Forces that cancel leave round-off of some 1e-14 of the largest force.
  const double part    = std::clamp(1e-3 * tolerance, 1e-13, 1e-12);
  double       largest = 0.;
  for (unsigned int i = 0; i < lambda.n_rows(); ++i)
    largest = std::max(largest, std::abs(lambda(i)));
  // Take the maximum over all rows and ranks, because the forces of different contacts are
  // comparable.
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, problem.context().communicator());
  std::vector<double> rounding;
  for (const double F_ii : problem.diagonal())
    rounding.push_back(std::max(part * largest, std::max(part * scale, kkt.rounding) / F_ii));
  return rounding;
}

namespace {
/// Return ||P (3 F (lambda / 3) - F lambda)||, which is zero except for rounding. One F-mult.
double application_rounding(const DualProblem &problem, const EqualityPart &part)
{
  // d - F lambda = part.residual
  MultiVector third(problem.n_owned()), error = part.residual;
  third.add(1. / 3., part.lambda);
  error.add(-1., problem.d());
  error.add(3., problem.apply(third));
  part.free_set->project(error);
  return norms(error, problem.context().communicator())[0];
}
} // namespace

EqualityPart equality_part(const DualProblem &problem, const RowSet &rows, MultiVector &x)
{
  EqualityPart part;
  part.lambda = MultiVector(problem.n_owned());
  // From lambda = 0 this gives lambda_Im = G'(GG')^+ e, in the range of Q.
  part.free_set = HeldSets(problem).balanced(rows, MultiVector(problem.n_owned()), 0., part.lambda);

  MultiVector block = part.lambda;
  block.append(x);
  const MultiVector F_block = problem.apply(block);
  part.residual             = problem.d();
  part.residual.add(-1., F_block.columns_from(0, 1));
  for (unsigned int j = 0; j < x.n_columns(); ++j)
    for (unsigned int i = 0; i < x.n_rows(); ++i)
      x(i, j) = problem.d()(i) - F_block(i, 1 + j);

  MultiVector both = part.residual;
  part.free_set->project(both);
  // Project twice, because the first projection leaves rounding of part.residual in the range of
  // G', which may be all of the result.
  part.free_set->project(both);
  both.append(part.residual);
  both.append(x);
  auto sizes = norms(both, problem.context().communicator());
  // A projected residual that is rounding error is no valid scale, because the tolerance would be
  // far below the rounding of the residual itself. This occurs where bodies only move or deform
  // evenly. A residual of gaps has the rounding of the positions whose differences the gaps are.
  if (sizes[0] <= residual_rounding * sizes[1])
    sizes[0] = *std::max_element(sizes.begin() + 1, sizes.end());
  else if (sizes[0] < suspect_part * sizes[1])
    sizes[0] = std::max(sizes[0], above_rounding * application_rounding(problem, part));
  sizes[0] = std::max(sizes[0], least_part * sizes[1]);
  // Without loads and gaps the solution is zero, and any scale is valid.
  part.scale = sizes[0] == 0. ? 1. : sizes[0];
  if (!std::isfinite(part.scale))
    throw SolveError("the loads or gaps are not finite numbers");
  return part;
}

SolveError not_converged(const std::string &method,
                         double             reached,
                         double             tolerance,
                         unsigned long      f_mults,
                         bool               out_of_f_mults)
{
  std::ostringstream text;
  text.precision(2);
  text << "the " << method << " solver reached a relative KKT residual of " << reached
       << " instead of " << tolerance << " in " << counted(f_mults, "F-mult")
       << (out_of_f_mults ? "; increase 'Maximum F-mults' or 'Relative tolerance', "
                          : ", and further steps do not reduce it; increase 'Relative tolerance', ")
       << "or use the other solver";
  return SolveError(text.str());
}
} // namespace snug::qp
