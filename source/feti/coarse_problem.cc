#include <snug/feti/coarse_problem.h>
#include <snug/feti/generalized_inverse.h>
#include <snug/qp/independent_columns.h>

#include <algorithm>

namespace snug::feti {
namespace {
/// Pivots of the Gram matrix of the motions W, scaled to unit diagonal, below which motions are
/// taken as linearly dependent: such pivots are rounding error.
const double dependence = 1e-8;
} // namespace

/// Every rank has the whole matrix. Only a factorization by a group communicates in solve().
CoarseProblem::CoarseProblem(const CoarseSpace &space, const qp::FreeRows &free)
{
  CsrMatrix   matrix          = space.gram(free);
  const auto &representatives = space.structure().representatives;
  const auto  motions         = space.near_kernel(matrix);
  // The columns of N and W are orthonormal, because those of both factors are.
  N         = times(space.body_modes(), motions.kernel);
  W         = times(space.body_modes(), motions.weak);
  auto held = N;
  held.append(W);
  // Regularize the matrix as fixing nodes regularize K. This couples only the coarse unknowns of
  // one subdomain per body.
  fix_kernel(matrix, representatives, rows_of(held, representatives));
  A = space.structure().factors.factorize(matrix, "the coarse problem G G'");
  if (W.n_columns() == 0)
    return;
  // Compute G_M G_M' W from the rows, because the small numbers G_M' W are lost in the rounding of
  // the values of G_M G_M'.
  const auto image = [&]() {
    auto y = space.transpose_multiply(W);
    free.transpose().reduce(y);
    free.expand(y);
    return space.multiply(y);
  };
  // W - A^-1 G_M G_M' W and N span all vectors (I - A^-1 G_M G_M') x. Alternating steps along W and
  // with A^-1 are therefore exact after the first steps, except for rounding.
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
  // Solutions differ by the kernel N. Without their part in N they are those of the pseudo-inverse
  // if c is in the range of G_M G_M'. For another c, of loads that M cannot hold, the solution
  // lacks a combination of N_f. Such a result serves only to find out that the loads are not
  // balanced.
  alpha.add(-1., times(N, transpose_times(N, alpha)));
  return alpha;
}
} // namespace snug::feti
