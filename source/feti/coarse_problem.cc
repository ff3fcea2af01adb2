#include <snug/feti/coarse_space.h>
#include <snug/feti/generalized_inverse.h>

#include <algorithm>

namespace snug::feti {
/// The matrix is replicated: every rank factorizes it, and solving needs no communication.
CoarseProblem::CoarseProblem(const CoarseSpace &space, const qp::RowSet &free)
  : A(space.factors().take(space.pattern()))
{
  CsrMatrix &matrix = A->matrix;
  const auto values = space.gram_values(free);
  std::copy(values.begin(), values.end(), matrix.values.begin());
  // Orthonormal, as both factors are.
  N = times(space.body_modes(), space.unseen_motions(matrix));
  // The same way out as fixing nodes for K; only the unknowns of one subdomain per body become
  // coupled.
  fix_kernel(matrix, space.representatives(), N);
  // The item may be one that an earlier face left behind: its values are another set's until here.
  A->factor.factorize("the coarse problem G G'");
}

qp::MultiVector CoarseProblem::solve(const qp::MultiVector &c) const
{
  qp::MultiVector alpha(c.n_rows(), c.n_columns());
  A->factor.solve(c, alpha);
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
