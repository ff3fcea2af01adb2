#include <snug/state/certificate.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace snug::state {
namespace {
/// Errors are differences of terms. Errors below this fraction of the terms count as zero. Where
/// prescribed displacements move a body, no other quantity measures the errors.
const double round_off = 128. * std::numeric_limits<double>::epsilon();

/// Where no force moves its row by more than this fraction of the displacements and gaps, as where
/// a motion just closes a gap, all forces are round-off of the solver.
const double force_round_off = 8. * round_off;

/// Return a / b, or 0 for 0 / 0; NaN stays NaN.
double relative(double a, double b)
{
  return a == 0. ? 0. : a / b;
}

/// Return the larger of both, or infinity instead of NaN, because std::max ignores NaN and MPI_MAX
/// may ignore it.
double larger(double a, double b)
{
  return b <= a ? a : std::isnan(b) ? INFINITY : b;
}

/// Return sum_j |K_ij| |u_j|, to which the round-off of (K u)_i is proportional.
double absolute_product(const feti::CsrMatrix &K, const qp::MultiVector &u, unsigned int i)
{
  double sum = 0.;
  for (PetscInt p = K.row_start()[i]; p < K.row_start()[i + 1]; ++p)
    sum += std::abs(K.values[p] * u(K.columns()[p]));
  return sum;
}

/// Return sum_i |B_ij lambda_i| of each unknown of a rigid subdomain, whose forces only balance.
std::vector<double>
gross_forces(const feti::Linearization &linear, const unsigned int s, const qp::MultiVector &local)
{
  std::vector<double> result(linear.subdomains()[s].n_dofs(), 0.);
  for (const auto &entry : linear.B()[s])
    result[entry.dof] += std::abs(entry.value * local(entry.row));
  return result;
}

/// Return the maximum over bodies of ||Ku - f + B'lambda|| / (||f|| + ||B'lambda||). The error of a
/// body is zero where it is round-off of K u. The forces of a rigid body are those of its rows
/// before they cancel.
double equilibrium_error(const feti::LoadedProblem &feti,
                         const qp::MultiVector     &lambda,
                         const feti::PrimalVectors &u)
{
  const auto         forces   = feti.linearization().multiply_Bt(lambda);
  const auto         local    = feti.linearization().layout().to_local(lambda);
  const unsigned int n_bodies = feti.linearization().table().n_bodies();
  // per body: |residual|^2, |f|^2, |B'lambda|^2 and |terms of K u|^2
  std::vector<double> squares(4 * n_bodies, 0.);
  for (unsigned int s = 0; s < u.size(); ++s)
    {
      const auto     &system = feti.linearization().subdomains()[s];
      double         *of     = &squares[4 * system.body];
      qp::MultiVector r      = forces[s];
      system.K.multiply_add(1., u[s], r);
      const auto gross =
        system.is_rigid() ? gross_forces(feti.linearization(), s, local) : std::vector<double>();
      for (unsigned int i = 0; i < system.n_dofs(); ++i)
        {
          const double f = feti.loads()[s](i), error = r(i) - f;
          const double force = gross.empty() ? forces[s](i) : gross[i];
          of[0] += error * error;
          of[1] += f * f;
          of[2] += force * force;
          // scale of the round-off of (K u)_i
          const double terms = absolute_product(system.K, u[s], i);
          of[3] += terms * terms;
        }
    }
  MPI_Allreduce(MPI_IN_PLACE, squares.data(), squares.size(), MPI_DOUBLE, MPI_SUM,
                feti.context().communicator());
  double worst = 0., largest = 0.;
  for (unsigned int body = 0; body < n_bodies; ++body)
    largest = std::max({largest, squares[4 * body + 1], squares[4 * body + 2]});
  for (unsigned int body = 0; body < n_bodies; ++body)
    {
      const double *of = &squares[4 * body];
      // A body that is only moved, or on which the others do not press, has residuals of round-off
      // and no forces to compare them with.
      if (std::sqrt(of[0]) <= round_off * std::sqrt(std::max(of[3], largest)))
        continue;
      const double error = relative(std::sqrt(of[0]), std::sqrt(of[1]) + std::sqrt(of[2]));
      worst              = error > worst || std::isnan(error) ? error : worst;
    }
  return worst;
}
/// Return F_ii |lambda_i| of the row whose estimate of it is the maximum, @p largest. The product
/// is exact for that row, so it is a lower bound of the maximum over rows.
double
largest_product(const feti::LoadedProblem &feti, const qp::MultiVector &lambda, double largest)
{
  const MPI_Comm comm = feti.context().communicator();
  int            rank = feti.context().rank(), owner = feti.context().n_ranks();
  unsigned int   row = feti.n_owned();
  for (unsigned int i = 0; i < feti.n_owned(); ++i)
    // The comparison is exact, because the maximum over ranks is one of these products, bit for
    // bit. Of equal products, the first row of the lowest rank counts.
    if (feti.diagonal()[i] * std::abs(lambda(i)) == largest)
      row = std::min(row, i);
  const int candidate = row < feti.n_owned() ? rank : owner;
  MPI_Allreduce(&candidate, &owner, 1, MPI_INT, MPI_MIN, comm);
  qp::MultiVector unit(feti.n_owned());
  if (rank == owner)
    unit(row) = 1.;
  // Do not call apply(), because F-mults count the work of solvers.
  auto column = feti.linearization().multiply_B(
    feti.linearization().apply_inverse(feti.linearization().multiply_Bt(unit)));
  feti.linearization().add_compliance(1., unit, column);
  double product = rank == owner ? column(row) * std::abs(lambda(row)) : 0.;
  MPI_Allreduce(MPI_IN_PLACE, &product, 1, MPI_DOUBLE, MPI_MAX, comm);
  return product;
}

/// Return the maximum of |f_i| / K_ii over the node loads. It measures how far the loads deform the
/// bodies where the bodies carry them without contact or gluing.
double largest_load_product(const feti::LoadedProblem &feti)
{
  double      largest = 0.;
  const auto &systems = feti.linearization().subdomains();
  for (unsigned int s = 0; s < systems.size(); ++s)
    for (unsigned int i = 0; i < systems[s].n_dofs(); ++i)
      largest = larger(largest, std::abs(feti.loads()[s](i)) * systems[s].compliance(i));
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, feti.context().communicator());
  return largest;
}

/// Set w_i to 0 where it is round-off of B u - g, and lambda to 0 if all forces are round-off. Rows
/// of B have lengths of about one, and the coarse problem spreads round-off over all rows.
/// @return whether all forces are round-off.
bool set_round_off_to_zero(const feti::LoadedProblem &feti,
                           const feti::PrimalVectors &u,
                           qp::MultiVector           &w,
                           qp::MultiVector           &lambda)
{
  double largest[3] = {0., 0., 0.}; // |u|, |g|, F_ii |lambda_i|
  for (const auto &part : u)
    for (unsigned int i = 0; i < part.n_rows(); ++i)
      largest[0] = std::max(largest[0], std::abs(part(i)));
  for (unsigned int i = 0; i < w.n_rows(); ++i)
    {
      largest[1] = std::max(largest[1], std::abs(feti.g()(i)));
      largest[2] = larger(largest[2], feti.diagonal()[i] * std::abs(lambda(i)));
    }
  MPI_Allreduce(MPI_IN_PLACE, largest, 3, MPI_DOUBLE, MPI_MAX, feti.context().communicator());
  const double size        = largest[0] + largest[1];
  const bool   is_unloaded = largest[2] <= force_round_off * size;
  const double length      = (is_unloaded ? force_round_off : round_off) * size;
  for (unsigned int i = 0; i < w.n_rows(); ++i)
    // u may be far larger than the lengths F_ii lambda_i that w is compared with later, for example
    // where prescribed displacements move a body.
    if (std::abs(w(i)) <= length)
      w(i) = 0.;
  if (is_unloaded)
    lambda = qp::MultiVector(lambda.n_rows());
  return is_unloaded;
}

/// Set the errors of friction. @p length is the length by which forces deform the bodies.
void certify_friction(const feti::LoadedProblem &feti,
                      const qp::MultiVector     &lambda,
                      const qp::MultiVector     &w,
                      const double               length,
                      const double               strain_energy,
                      Certificate               &certificate)
{
  double largest[3] = {0., 0., 0.}; // excess of forces, |s| (b - |lambda_T|), b
  double missing    = 0.;
  for (const qp::FrictionCone &full : feti.cones())
    {
      const auto cone  = full.acting(lambda);
      double     force = 0., slip = 0., work = 0.;
      for (unsigned int t = 0; t < cone.n_tangents; ++t)
        {
          const unsigned int row = cone.tangents[t];
          force += lambda(row) * lambda(row);
          slip += w(row) * w(row);
          work += lambda(row) * w(row);
        }
      force              = std::sqrt(force);
      slip               = std::sqrt(slip);
      const double limit = cone.limit(lambda);
      largest[0]         = larger(largest[0], force - limit);
      largest[1]         = larger(largest[1], slip * std::max(limit - force, 0.));
      largest[2]         = larger(largest[2], limit);
      missing += limit * slip - work;
    }
  const MPI_Comm comm = feti.context().communicator();
  MPI_Allreduce(MPI_IN_PLACE, largest, 3, MPI_DOUBLE, MPI_MAX, comm);
  MPI_Allreduce(MPI_IN_PLACE, &missing, 1, MPI_DOUBLE, MPI_SUM, comm);
  certificate.cone        = relative(largest[0], largest[2]);
  certificate.creep       = relative(largest[1], length * largest[2]);
  certificate.dissipation = relative(std::abs(missing), strain_energy);
}
} // namespace

double Certificate::worst() const
{
  double worst = 0.;
  for (const double error : {equilibrium, continuity, penetration, negative_pressure,
                             complementarity, cone, creep, dissipation})
    // The condition is written so that NaN counts, because NaN must not pass as small.
    if (!(error <= worst))
      worst = std::isnan(error) ? INFINITY : error;
  return worst;
}

Certificate certify(const feti::LoadedProblem &feti,
                    const qp::MultiVector     &all_lambda,
                    const feti::PrimalVectors &u)
{
  auto w = feti.linearization().multiply_B(u);
  w.add(-1., feti.g());
  // The length by which a spring is stretched is D lambda.
  feti.linearization().add_compliance(-1., all_lambda, w);
  qp::MultiVector lambda      = all_lambda;
  const bool      is_unloaded = set_round_off_to_zero(feti, u, w, lambda);
  // maxima of continuity, penetration, negative and positive contact force, and F_ii |lambda_i|
  double largest[5] = {0., 0., 0., 0., 0.};
  double sums[2]    = {0., 0.}; // lambda_I' w_I, u'Ku
  for (unsigned int i = 0; i < feti.n_owned(); ++i)
    {
      largest[4] = larger(largest[4], feti.diagonal()[i] * std::abs(lambda(i)));
      if (feti.linearization().contact_rows()[i] && !feti.bounded()[i])
        continue; // tangential rows
      if (!feti.bounded()[i])
        {
          largest[0] = larger(largest[0], std::abs(w(i)));
          continue;
        }
      largest[1] = larger(largest[1], w(i));
      largest[2] = larger(largest[2], -lambda(i));
      // Negative contact forces are compared with the maximum contact force, not with multipliers
      // of gluing.
      largest[3] = larger(largest[3], lambda(i));
      sums[0] += lambda(i) * w(i);
    }
  for (unsigned int s = 0; s < u.size(); ++s)
    {
      qp::MultiVector Ku(u[s].n_rows());
      feti.linearization().subdomains()[s].K.multiply_add(1., u[s], Ku);
      for (unsigned int i = 0; i < u[s].n_rows(); ++i)
        sums[1] += Ku(i) * u[s](i);
    }
  const MPI_Comm comm = feti.context().communicator();
  MPI_Allreduce(MPI_IN_PLACE, largest, 5, MPI_DOUBLE, MPI_MAX, comm);
  MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, comm);
  // The size is a length by which forces deform the bodies. |u| would contain rigid motions,
  // however large.
  const double of_loads = largest_load_product(feti);
  const double size     = std::max(largest_product(feti, lambda, largest[4]), of_loads);
  Certificate  certificate;
  // Without loads, forces that are round-off have residuals of their own size.
  if (!is_unloaded || of_loads > 0.)
    certificate.equilibrium = equilibrium_error(feti, all_lambda, u);
  certificate.continuity        = relative(largest[0], size);
  certificate.penetration       = relative(largest[1], size);
  certificate.negative_pressure = relative(largest[2], largest[3]);
  // Compare energies. Without any strain the work of contact has to vanish exactly.
  certificate.complementarity = relative(std::abs(sums[0]), std::abs(sums[1]) / 2);
  certify_friction(feti, lambda, w, size, std::abs(sums[1]) / 2, certificate);
  return certificate;
}

bool is_nearly_unloaded(const feti::LoadedProblem &feti, const qp::MultiVector &lambda)
{
  double largest[2] = {0., 0.};
  for (unsigned int i = 0; i < feti.n_owned(); ++i)
    {
      largest[0] = std::max(largest[0], feti.diagonal()[i] * std::abs(lambda(i)));
      // Gaps far from where bodies touch, however wide, do not show how much the bodies deform.
      if (!feti.bounded()[i] || lambda(i) != 0.)
        largest[1] = std::max(largest[1], std::abs(feti.g()(i)));
    }
  MPI_Allreduce(MPI_IN_PLACE, largest, 2, MPI_DOUBLE, MPI_MAX, feti.context().communicator());
  // Use the estimates F_ii, which are of the right size except for nearly incompressible bodies.
  return largest[0] < 1e-3 * largest[1];
}
} // namespace snug::state
