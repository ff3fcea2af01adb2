#ifndef snug_feti_local_schur_h
#define snug_feti_local_schur_h

#include <snug/base/run_context.h>
#include <snug/feti/factor_pool.h>
#include <snug/feti/subdomain_system.h>

#include <memory>

namespace snug::feti {
/**
 * The primal operator of one subdomain inside the preconditioner, on its
 * unknowns b with an entry in B, and on the fixing unknowns where holding
 * those leaves it a rigid motion:
 * S = K_bb - K_bi K_ii^{-1} K_ib ("Dirichlet") or K_bb ("lumped").
 * b is found with the first numbers.
 */
class LocalSchur
{
public:
  /// @p system, @p factors and @p patterns must outlive this object.
  LocalSchur(const SubdomainSystem &system,
             bool                   lumped,
             const FactorPool      &factors,
             SharedPatterns        &patterns,
             RunContext            &context);

  /// For the present K and R.
  void factorize(const std::string &what);

  /// Leave the factor, which is of former numbers, to the pool: to be factorized again.
  void release() { factor.reset(); }

  /// Unknown of the subdomain -> position in b, or n_boundary().
  const std::vector<unsigned int> &boundary_position() const { return position_b; }

  unsigned int n_boundary() const { return n_b; }

  /// S x for every column; n_boundary rows.
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
  CsrMatrix                           bb; ///< its lower triangle
  CsrMatrix                           ib;
  std::shared_ptr<const SparseFactor> factor;
};

/// Rows of x, of all unknowns, at the boundary.
qp::MultiVector on_boundary(const qp::MultiVector &x, const LocalSchur &schur);
} // namespace snug::feti

#endif
