#ifndef snug_qp_nnls_h
#define snug_qp_nnls_h

#include <snug/qp/multi_vector.h>

namespace snug::qp {
/// A solution x (n x 1) and its residual b - A x (m x 1).
struct NnlsResult
{
  MultiVector x;
  MultiVector residual;
};

/**
 * Solve a small dense non-negative least squares problem, on this rank alone:
 * @f[ \min_{x \ge 0} \|A x - b\|. @f]
 * The residual is unique and satisfies @f$A^T (b - A x) \le 0@f$. A nonzero residual is a direction
 * in which b pushes and no column of A resists. Columns are compared by their angle to the
 * residual, so their lengths do not matter. Angles with a cosine below 1e-12 count as right angles.
 *
 * @param A m x n; m up to a few hundred, n up to thousands.
 * @param b m x 1.
 * @throws SolveError if A or b are not finite.
 *
 * Source: Lawson, Hanson, Solving Least Squares Problems, chapter 23 (1974).
 */
NnlsResult nnls(const MultiVector &A, const MultiVector &b);

/**
 * Return the shortest y (m x 1) that satisfies the n conditions @f$A^T y \ge b@f$, on this rank
 * alone. Some y must satisfy the conditions.
 *
 * Source: Lawson, Hanson, as nnls(): problem LDP.
 */
MultiVector shortest(const MultiVector &A, const MultiVector &b);
} // namespace snug::qp

#endif
