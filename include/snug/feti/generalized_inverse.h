#ifndef snug_feti_generalized_inverse_h
#define snug_feti_generalized_inverse_h

#include <snug/base/run_context.h>
#include <snug/feti/factor_pool.h>
#include <snug/feti/subdomain_system.h>

#include <memory>
#include <string>

namespace snug::feti {
/**
 * Add rho N_f (N_f' N_f)^{-1} N_f' to A on the unknowns @p f, all of which must be coupled in the
 * pattern of A. @p N_f are the rows f of the kernel N of A, and @p rho is of the size of A: a much
 * smaller rho loses digits of A^+, and a much larger one worsens the condition number. The sum A +
 * rho Q is regular, and its inverse is a generalized inverse of the former A, because (A + rho Q) N
 * = rho N_f. Nothing is added if N has no columns.
 */
void fix_kernel(CsrMatrix                       &A,
                const std::vector<unsigned int> &f,
                const qp::MultiVector           &N_f,
                double                           rho);

/// Fix the kernel with rho = mean diag A, or 1 if A is zero. A is zero where no row is left, for
/// bodies in one piece that nothing holds or touches.
void fix_kernel(CsrMatrix &A, const std::vector<unsigned int> &f, const qp::MultiVector &N_f);

/**
 * The generalized inverse K^+ of a floating subdomain by fixing nodes,
 * @f[ K^+ = (K + \rho Q_f)^{-1}, \qquad
 *     Q_f = R_f (R_f^T R_f)^{-1} R_f^T, \quad
 *     \rho = \mathrm{mean}\,\mathrm{diag} K, @f]
 * where R_f are the rounded rows of R at a few far-apart nodes, the fixing nodes. K K^+ K = K holds
 * for every R_f for which R_f' R is regular, with R_f extended by zeros: K_rho R = rho Q_f R gives
 * R_f' K^+ K = 0. Rounding R_f lets congruent subdomains whose K have the same bits share one K^+.
 *
 * Source: Brzobohatý, Dostál, Kozubek, Kovář, Markopoulos, Int. J. Numer. Meth. Engng (2011).
 */
class GeneralizedInverse
{
public:
  /// Factorize K_rho = K + rho Q_f. Error messages call the matrix @p what. The context must
  /// outlive this object.
  GeneralizedInverse(const SubdomainSystem &system,
                     const FactorPool      &factors,
                     RunContext            &context,
                     const std::string     &what);

  /// Compute x = K^+ b for every column.
  void apply(const qp::MultiVector &b, qp::MultiVector &x) const;

private:
  RunContext                         &context;
  std::shared_ptr<const SparseFactor> factor;
};
} // namespace snug::feti

#endif
