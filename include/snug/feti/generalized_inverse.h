#ifndef snug_feti_generalized_inverse_h
#define snug_feti_generalized_inverse_h

#include <snug/base/run_context.h>
#include <snug/feti/sparse_factor.h>
#include <snug/feti/subdomain_system.h>

#include <memory>
#include <string>

namespace snug::feti {
/**
 * A += rho N_f (N_f' N_f)^{-1} N_f' on the unknowns @p f, all coupled in the
 * pattern of A, with the rows N_f of the kernel N of A and rho = mean diag A.
 * Makes A regular, and A^-1 a generalized inverse of the former A, as
 * (A + rho Q) N = rho N_f. Nothing if N has no columns.
 */
void fix_kernel(CsrMatrix &A, const std::vector<unsigned int> &f, const qp::MultiVector &N);

/**
 * K^+ of a floating subdomain by fixing nodes,
 * @f[ K^+ = (K + \rho Q_f)^{-1}, \qquad
 *     Q_f = R_f (R_f^T R_f)^{-1} R_f^T, \quad
 *     \rho = \mathrm{mean}\,\mathrm{diag} K, @f]
 * where R_f are the rows of R at a few far-apart nodes. K K^+ K = K holds
 * exactly because K_rho R = rho R_f.
 *
 * Source: Brzobohatý, Dostál, Kozubek, Kovář, Markopoulos, Int. J. Numer.
 * Meth. Engng (2011).
 */
class GeneralizedInverse
{
public:
  /// Symbolic factorization for the pattern of @p system.K, which must
  /// outlive this object. Counts one symbolic factorization.
  GeneralizedInverse(const SubdomainSystem &system,
                     Factorization          package,
                     FillOrderings         &orderings,
                     RunContext            &context);

  /// Numeric factorization of the present K and R. Counts one.
  void factorize(const std::string &what);

  /// x = K^+ b for every column.
  void apply(const qp::MultiVector &b, qp::MultiVector &x) const;

private:
  const SubdomainSystem        &system;
  RunContext                   &context;
  CsrMatrix                     K_rho;
  std::vector<std::size_t>      place_of_K; ///< in K_rho.values
  std::unique_ptr<SparseFactor> factor;
};
} // namespace snug::feti

#endif
