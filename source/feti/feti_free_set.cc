#include <snug/feti/feti_free_set.h>

namespace snug::feti {
Linearization::FetiFreeSet::FetiFreeSet(const Linearization &the_feti, const qp::RowSet &the_free)
  : feti(the_feti), free(the_free)
{}

const qp::RowSet &Linearization::FetiFreeSet::rows() const
{
  return free;
}

/// Assemble the coarse problem when it is first needed. For example, the faces of SMALSE-M only
/// precondition, and the projection belongs to another face. The assembly is collective, so all
/// ranks must call this function at the same time.
const CoarseProblem &Linearization::FetiFreeSet::coarse_problem() const
{
  if (!problem)
    {
      problem = std::make_unique<CoarseProblem>(feti.coarse(), free);
      ++feti.context().work.coarse_factorizations;
    }
  return *problem;
}

void Linearization::FetiFreeSet::restrict(qp::MultiVector &x) const
{
  for (unsigned int k = 0; k < x.n_columns(); ++k)
    for (unsigned int row = 0; row < x.n_rows(); ++row)
      if (!free[row])
        x(row, k) = 0.;
}

qp::MultiVector Linearization::FetiFreeSet::amplitudes(const qp::MultiVector &x) const
{
  qp::MultiVector rest = x, alpha(feti.table().n_kernel(), x.n_columns());
  subtract_rigid_part(rest, alpha);
  // Repeat the subtraction: in long chains of subdomains the motion at the ends is a sum of many
  // parts. Otherwise the rounding error that the first pass leaves, 1000 epsilon of x after 200
  // subdomains, would count as a residual.
  subtract_rigid_part(rest, alpha);
  return alpha;
}

/// Add a = (G_M G_M')^+ G_M x to alpha and subtract G_M' a from x, in steps. Each step computes its
/// part from the present x, so it also removes what inaccurate earlier solutions left.
void Linearization::FetiFreeSet::subtract_rigid_part(qp::MultiVector &x,
                                                     qp::MultiVector &alpha) const
{
  restrict(x);
  for (unsigned int step = 0; step < coarse_problem().n_steps(); ++step)
    {
      feti.context().work.coarse_solves += x.n_columns();
      const auto part = coarse_problem().solve(feti.coarse().multiply(x, &free), step);
      x.add(-1., feti.coarse().transpose_multiply(part, &free));
      alpha.add(1., part);
    }
}

void Linearization::FetiFreeSet::project(qp::MultiVector &x) const
{
  // P_M x = x_M - G_M' (G_M G_M')^+ G_M x_M
  qp::MultiVector alpha(feti.table().n_kernel(), x.n_columns());
  subtract_rigid_part(x, alpha);
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
  if (feti.structure.parameters.preconditioner == Preconditioner::none)
    {
      restrict(z);
      return z;
    }
  feti.context().work.preconditioner_applications += r.n_columns();
  // Only the owner of linearly dependent contact rows detects them.
  if (!gram)
    throw_collectively(feti.context().communicator(),
                       [&]() { gram = std::make_unique<RowGram::Factor>(*feti.gram, free); });
  // M^-1 = W_M^-1 (B D^-1 S D^-1 B') W_M^-1. W_M is the identity for orthonormal rows and D = I.
  gram->solve(z);
  feti.precondition(z);
  gram->solve(z);
  return z;
}

std::vector<double> Linearization::FetiFreeSet::make_feasible(qp::MultiVector       &x,
                                                              const qp::MultiVector &e) const
{
  restrict(x);
  qp::MultiVector missing = e;
  missing.add(-1., feti.coarse().multiply(x, &free));
  for (unsigned int step = 0; step < coarse_problem().n_steps(); ++step)
    {
      feti.context().work.coarse_solves += x.n_columns();
      // Add the minimum change of x, in the Euclidean norm, that balances e as far as M can.
      x.add(1., feti.coarse().transpose_multiply(coarse_problem().solve(missing, step), &free));
      missing = e;
      missing.add(-1., feti.coarse().multiply(x, &free));
    }
  return feti.coarse().structure().norms(missing);
}

std::vector<double> Linearization::FetiFreeSet::gap_closing_rates(const qp::MultiVector &e) const
{
  const qp::MultiVector rates =
    // N N'e is the part of the load that M does not hold, taken as a motion. G' N N'e are the rates
    // at which the rows close. N'G_M = 0, so the forces of rows of M do not contribute.
    feti.coarse().transpose_multiply(coarse_problem().kernel_part(e), nullptr);
  return std::vector<double>(rates.column(0), rates.column(0) + rates.n_rows());
}

std::unique_ptr<qp::FreeSet> Linearization::free_set(const qp::RowSet &free_rows) const
{
  return std::make_unique<FetiFreeSet>(*this, free_rows);
}
} // namespace snug::feti
