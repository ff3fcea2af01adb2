#ifndef snug_feti_coarse_problem_h
#define snug_feti_coarse_problem_h

#include <snug/feti/coarse_space.h>

#include <memory>

namespace snug::feti {
/**
 * This class holds the factorized coarse problem G_M G_M' of one face, its kernel N and the motions
 * W. The rows of M hardly resist the motions W, which are scaled to W' G_M G_M' W = I. The
 * factorized matrix is
 * A = G_M G_M' + rho V_f (V_f' V_f)^{-1} V_f'
 * on the representatives f, where the columns of V span the kernel and the hardly resisted motions.
 */
class CoarseProblem
{
public:
  /// Assemble and factorize the coarse problem of the multipliers of @p free, G_M = G Z.
  /// Collective.
  CoarseProblem(const CoarseSpace &space, const qp::FreeRows &free);

  /// Return the number of steps of solve(): one, or five if some motions are hardly resisted.
  unsigned int n_steps() const { return W.n_columns() > 0 ? 5 : 1; }

  /**
   * Return the contribution of step @p step to (G_M G_M')^+ c for every column, orthogonal to N. A
   * single step returns the whole solution if W is empty. Otherwise the solution is a sum over
   * steps: even steps return W W'c, the part along W, and odd steps return A^{-1} c without its
   * part in N. Each step takes the c that remains after the previous steps.
   */
  qp::MultiVector solve(const qp::MultiVector &c, unsigned int step) const;

  /// Return N.
  const qp::MultiVector &kernel() const { return N; }

private:
  std::shared_ptr<const SparseFactor> A;
  qp::MultiVector                     N; ///< orthonormal kernel, n_kernel x (its dimension)
  qp::MultiVector                     W;
};
} // namespace snug::feti

#endif
