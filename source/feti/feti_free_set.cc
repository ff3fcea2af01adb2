#include <snug/feti/feti_free_set.h>

#include <deal.II/base/mpi.h>

#include <cmath>

namespace snug::feti {
Linearization::FetiFreeSet::FetiFreeSet(const Linearization &the_feti, const qp::FreeRows &the_free)
  : feti(the_feti)
  , free(the_free)
  , slides(
      dealii::Utilities::MPI::logical_or(!free.slips().empty(), the_feti.context().communicator()))
  , equations{the_free.transpose(), nullptr}
  , multipliers{the_free, nullptr}
{}

/// Assemble the coarse problem when it is first needed. For example, the faces of SMALSE-M only
/// precondition, and the projection belongs to another face. The assembly is collective, so all
/// ranks must call this function at the same time.
const CoarseProblem &Linearization::FetiFreeSet::coarse_problem(const Side &side) const
{
  if (!side.problem)
    {
      side.problem = std::make_unique<CoarseProblem>(feti.coarse(), side.free);
      ++feti.context().work.coarse_factorizations;
    }
  return *side.problem;
}

/// Return G M y.
qp::MultiVector Linearization::FetiFreeSet::multiply(const Side &side, qp::MultiVector y) const
{
  side.free.expand(y);
  return feti.coarse().multiply(y);
}

/// Return M' G' alpha.
qp::MultiVector Linearization::FetiFreeSet::transpose_multiply(const Side            &side,
                                                               const qp::MultiVector &alpha) const
{
  auto y = feti.coarse().transpose_multiply(alpha);
  side.free.transpose().reduce(y);
  return y;
}

qp::MultiVector Linearization::FetiFreeSet::amplitudes(const qp::MultiVector &x) const
{
  qp::MultiVector rest = x, alpha(feti.table().n_kernel(), x.n_columns());
  subtract_rigid_part(equations, rest, alpha);
  // Repeat the subtraction: in long chains of subdomains the motion at the ends is a sum of many
  // parts. Otherwise the rounding error that the first pass leaves, 1000 epsilon of x after 200
  // subdomains, would count as a residual.
  subtract_rigid_part(equations, rest, alpha);
  return alpha;
}

/// Add a = (G_M G_M')^+ G_M x to alpha and subtract G_M' a from x, in steps. Each step computes its
/// part from the present x, so it also removes what inaccurate earlier solutions left.
void Linearization::FetiFreeSet::subtract_rigid_part(const Side      &side,
                                                     qp::MultiVector &x,
                                                     qp::MultiVector &alpha) const
{
  free.restrict(x);
  for (unsigned int step = 0; step < coarse_problem(side).n_steps(); ++step)
    {
      feti.context().work.coarse_solves += x.n_columns();
      const auto part = coarse_problem(side).solve(multiply(side, x), step);
      x.add(-1., transpose_multiply(side, part));
      alpha.add(1., part);
    }
}

void Linearization::FetiFreeSet::project(qp::MultiVector &x) const
{
  // P_M x = x_M - G_M' (G_M G_M')^+ G_M x_M
  qp::MultiVector alpha(feti.table().n_kernel(), x.n_columns());
  subtract_rigid_part(equations, x, alpha);
}

void Linearization::FetiFreeSet::project_multipliers(qp::MultiVector &y) const
{
  qp::MultiVector alpha(feti.table().n_kernel(), y.n_columns());
  subtract_rigid_part(of_multipliers(), y, alpha);
}

std::vector<double> Linearization::FetiFreeSet::deflate(qp::MultiVector &x) const
{
  return feti.deflation ? feti.deflation->orthogonalize(x) : FreeSet::deflate(x);
}

void Linearization::FetiFreeSet::minimize_over_deflated(qp::MultiVector &lambda,
                                                        qp::MultiVector &residual) const
{
  if (feti.deflation)
    feti.deflation->coarse_correction(lambda, residual);
}

qp::MultiVector Linearization::FetiFreeSet::precondition(const qp::MultiVector &r) const
{
  qp::MultiVector z = r;
  free.restrict(z);
  if (feti.structure.parameters.preconditioner == Preconditioner::none)
    return z;
  feti.context().work.preconditioner_applications += r.n_columns();
  // Only the owner of equal contact rows detects them.
  if (!is_checked)
    throw_collectively(feti.context().communicator(), [&]() { feti.gram->check(free); });
  is_checked = true;
  // M^-1 = W_M^-1 (B D^-1 S D^-1 B') W_M^-1. W_M is the identity for orthonormal rows and D = I.
  scale_slips(z);
  feti.gram->solve(free, z);
  feti.precondition(z);
  feti.gram->solve(free, z);
  scale_slips(z);
  return z;
}

/// Multiply z by (1 + D / F_yy)^-1/2 across slips, where the operator is F + D.
void Linearization::FetiFreeSet::scale_slips(qp::MultiVector &z) const
{
  for (const qp::Slip &slip : free.slips())
    if (slip.cone.n_tangents == 2)
      {
        const double F  = slip.cone.compliance(feti.diagonal());
        const double by = 1. / std::sqrt(1. + slip.compliance / F);
        for (unsigned int k = 0; k < z.n_columns(); ++k)
          for (const unsigned int row : slip.cone.tangents)
            z(row, k) *= by;
      }
}

std::vector<double> Linearization::FetiFreeSet::make_feasible(qp::MultiVector       &x,
                                                              const qp::MultiVector &e) const
{
  const Side &side = of_multipliers();
  free.restrict(x);
  qp::MultiVector missing = e;
  missing.add(-1., multiply(side, x));
  for (unsigned int step = 0; step < coarse_problem(side).n_steps(); ++step)
    {
      feti.context().work.coarse_solves += x.n_columns();
      // Add the minimum change of x, in the Euclidean norm, that balances e as far as M can.
      x.add(1., transpose_multiply(side, coarse_problem(side).solve(missing, step)));
      missing = e;
      missing.add(-1., multiply(side, x));
    }
  free.expand(x);
  return feti.coarse().structure().norms(missing);
}

const qp::MultiVector &Linearization::FetiFreeSet::unresisted_motions() const
{
  return coarse_problem(equations).kernel();
}

std::unique_ptr<qp::FreeSet> Linearization::free_set(const qp::FreeRows &free_rows) const
{
  return std::make_unique<FetiFreeSet>(*this, free_rows);
}
} // namespace snug::feti
