#ifndef snug_feti_sparse_factor_h
#define snug_feti_sparse_factor_h

#include <snug/base/petsc_handle.h>
#include <snug/feti/csr_matrix.h>
#include <snug/feti/feti_parameters.h>
#include <snug/feti/fill_orderings.h>

namespace snug::feti {
/**
 * Cholesky factorization of a sparse symmetric positive definite matrix
 * on one process, by a package of PETSc. The symbolic part is done once
 * for the pattern. Scaling the matrix by a power of two changes no digit:
 * the package factorizes it divided by one, so that no square root of its
 * units is taken.
 */
class SparseFactor
{
public:
  /**
   * @param[in] matrix referenced, not copied: it must outlive this object
   *   and keep its arrays. Only its pattern is used here.
   * @param[in] orderings where CHOLMOD takes its order from; null: it tries some of its own.
   */
  SparseFactor(const CsrMatrix &matrix, Factorization package, FillOrderings *orderings = nullptr);

  /**
   * Factorize the present values of the matrix.
   * @throws SolveError if the matrix is not positive definite, holds NaN,
   *   or the solution of one check system is wrong (packages can fail
   *   silently); @p what names the matrix. It counts as singular where
   *   entries of a solution that should be of order one are above
   *   @p singular_size: 1e11 leaves five digits.
   */
  void factorize(const std::string &what, double singular_size = 1e11);

  /// x = A^{-1} b for every column.
  void solve(const qp::MultiVector &b, qp::MultiVector &x) const;

private:
  void check(const std::string &what, double singular_size) const;

  const CsrMatrix &matrix;
  petsc::Matrix    wrapped;
  petsc::Matrix    factor;
  petsc::Vector    right_hand_side, solution;
  double           unit = 1.; ///< power of two; the factor is of A / unit
};
} // namespace snug::feti

#endif
