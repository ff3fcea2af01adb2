#ifndef snug_feti_local_schur_h
#define snug_feti_local_schur_h

#include <snug/base/run_context.h>
#include <snug/feti/factor_pool.h>
#include <snug/feti/subdomain_system.h>

#include <memory>

namespace snug::feti {
/**
 * The primal operator of one subdomain in the preconditioner,
 * S = K_bb - K_bi K_ii^{-1} K_ib ("Dirichlet") or K_bb ("lumped").
 * b are the unknowns with an entry in B. The fixing unknowns are added to b if holding the unknowns
 * with entries in B leaves the subdomain a rigid motion. factorize() chooses b.
 */
class LocalSchur
{
public:
  /// Keep references to all arguments. The referenced objects must outlive this object.
  LocalSchur(const SubdomainSystem &system,
             bool                   lumped,
             const FactorPool      &factors,
             SharedPatterns        &patterns,
             RunContext            &context);

  /// Extract the blocks of the present K and factorize K_ii. Error messages call it @p what.
  void factorize(const std::string &what);

  /// Return the factor to the pool, which may use it for other matrices of the pattern.
  void release() { factor.reset(); }

  /// Return the position in b of each unknown of the subdomain, or n_boundary() outside b.
  const std::vector<unsigned int> &boundary_position() const { return position_b; }

  unsigned int n_boundary() const { return n_b; }

  /// Return S x for every column of x (n_boundary rows).
  qp::MultiVector apply(const qp::MultiVector &x) const;

private:
  void      choose_boundary(bool with_fixing_dofs);
  bool      boundary_holds() const;
  CsrMatrix extract(bool rows_on_boundary, bool columns_on_boundary) const;

  const SubdomainSystem              &system;
  const FactorPool                   &factors;
  SharedPatterns                     &patterns;
  RunContext                         &context;
  const bool                          lumped;
  bool                                has_fixing_dofs = false;
  unsigned int                        n_b = 0, n_i = 0;
  std::vector<unsigned int>           position_b, position_i;
  CsrMatrix                           bb; ///< lower triangle of K_bb
  CsrMatrix                           ib;
  std::shared_ptr<const SparseFactor> factor;
};

/// Return the rows of @p x at the boundary. @p x has a row for each unknown of the subdomain.
qp::MultiVector on_boundary(const qp::MultiVector &x, const LocalSchur &schur);
} // namespace snug::feti

#endif
