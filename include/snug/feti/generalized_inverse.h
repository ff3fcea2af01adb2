#ifndef snug_feti_generalized_inverse_h
#define snug_feti_generalized_inverse_h

#include <snug/base/run_context.h>
#include <snug/feti/factor_pool.h>
#include <snug/feti/subdomain_system.h>

#include <memory>
#include <string>

namespace snug::feti {
/**
 * A += rho N_f (N_f' N_f)^{-1} N_f' on the unknowns @p f, all coupled in the
 * pattern of A, with the rows @p N_f of the kernel N of A and rho = mean diag A.
 * Makes A regular, and A^-1 a generalized inverse of the former A, as
 * (A + rho Q) N = rho N_f. Nothing if N has no columns.
 */
void fix_kernel(CsrMatrix &A, const std::vector<unsigned int> &f, const qp::MultiVector &N_f);

/**
 * K^+ of a floating subdomain by fixing nodes,
 * @f[ K^+ = (K + \rho Q_f)^{-1}, \qquad
 *     Q_f = R_f (R_f^T R_f)^{-1} R_f^T, \quad
 *     \rho = \mathrm{mean}\,\mathrm{diag} K, @f]
 * where R_f are the rows of R at a few far-apart nodes. K K^+ K = K holds
 * whatever R_f, if only R_f'R is regular for the rows R of the modes there:
 * K_rho R = rho Q_f R gives R_f' K^+ K = 0. They are rounded, so that congruent
 * subdomains whose K have the same bits have one K^+.
 *
 * Source: Brzobohatý, Dostál, Kozubek, Kovář, Markopoulos, Int. J. Numer.
 * Meth. Engng (2011).
 */
class GeneralizedInverse
{
public:
  /// @p system and @p factors must outlive this object.
  GeneralizedInverse(const SubdomainSystem &the_system,
                     const FactorPool      &the_factors,
                     RunContext            &the_context)
    : system(the_system), factors(the_factors), context(the_context)
  {}

  /// Of the present K and R.
  void factorize(const std::string &what);

  /// Leave the factor, which is of former numbers, to the pool: to be factorized again.
  void release() { factor.reset(); }

  /// x = K^+ b for every column.
  void apply(const qp::MultiVector &b, qp::MultiVector &x) const;

private:
  const SubdomainSystem              &system;
  const FactorPool                   &factors;
  RunContext                         &context;
  std::shared_ptr<const SparseFactor> factor;
};
} // namespace snug::feti

#endif
