#include <snug/feti/coarse_space.h>
#include <snug/feti/generalized_inverse.h>
#include <snug/qp/independent_columns.h>

#include <algorithm>

namespace snug::feti {
namespace {
/// Of motions W on each other, that is rounding.
const double dependence = 1e-8;
} // namespace

/// The matrix is replicated: every rank factorizes it, and solving needs no communication.
CoarseProblem::CoarseProblem(const CoarseSpace &space, const qp::RowSet &free)
{
  CsrMatrix matrix   = space.pattern();
  matrix.values      = space.gram_values(free);
  const auto motions = space.hardly_seen_motions(matrix);
  // Orthonormal, as both factors are.
  N         = times(space.body_modes(), motions.unseen);
  W         = times(space.body_modes(), motions.weak);
  auto held = N;
  held.append(W);
  // The same way out as fixing nodes for K; only the unknowns of one subdomain per body become
  // coupled.
  fix_kernel(matrix, space.representatives(), rows_of(held, space.representatives()));
  A = space.factors().factorize(matrix, "the coarse problem G G'");
  if (W.n_columns() == 0)
    return;
  // By way of the rows: the small numbers G_M' W are rounding in the values of G_M G_M'.
  const auto image = [&]() { return space.multiply(space.transpose_multiply(W, &free), &free); };
  // W - A^-1 G_M G_M' W and N span all that (I - A^-1 G_M G_M') x can be: steps along W and with
  // A^-1 by turns end, but for rounding, at once.
  qp::MultiVector solved(W.n_rows(), W.n_columns());
  A->solve(image(), solved);
  W.add(-1., solved);
  W = times(W, qp::orthonormal_combinations(transpose_times(W, image()),
                                            std::vector<double>(W.n_columns(), 0.), dependence));
}

qp::MultiVector CoarseProblem::solve(const qp::MultiVector &c, const unsigned int step) const
{
  if (step % 2 == 0 && W.n_columns() > 0)
    return times(W, transpose_times(W, c));
  qp::MultiVector alpha(c.n_rows(), c.n_columns());
  A->solve(c, alpha);
  // Solutions differ by the kernel N; without it they are those of the pseudo-inverse if c is in
  // the range of G_M G_M'. Other c, of loads that M cannot hold, lose a combination of N_f: the
  // result is then only good to find out that they are not balanced.
  alpha.add(-1., kernel_part(alpha));
  return alpha;
}

qp::MultiVector CoarseProblem::kernel_part(const qp::MultiVector &c) const
{
  return times(N, transpose_times(N, c));
}
} // namespace snug::feti
