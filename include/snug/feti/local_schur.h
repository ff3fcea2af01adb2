#ifndef snug_feti_local_schur_h
#define snug_feti_local_schur_h

#include <snug/feti/factor_cache.h>
#include <snug/feti/subdomain_system.h>

#include <memory>

namespace snug::feti {
/**
 * The primal operator of one subdomain in the preconditioner,
 * S = K_bb - K_bi K_ii^{-1} K_ib ("Dirichlet") or K_bb ("lumped").
 * b is the boundary of the system. The fixing unknowns are added to b if holding the boundary
 * leaves the subdomain a rigid motion.
 */
class LocalSchur
{
public:
  /// Extract the blocks of K and factorize K_ii. Error messages call the matrix @p what. The caches
  /// keep patterns and factors of former matrices.
  LocalSchur(const SubdomainSystem &system,
             bool                   lumped,
             const FactorCache     &cache,
             const std::string     &what);

  /// Return the position in b of each unknown of the subdomain, or n_boundary() outside b.
  const std::vector<unsigned int> &boundary_position() const { return position_b; }

  unsigned int n_boundary() const { return n_b; }

  /// Return S x for every column of x (n_boundary rows).
  qp::MultiVector apply(const qp::MultiVector &x) const;

private:
  void      number(const std::vector<bool> &in_boundary);
  bool      boundary_holds(const qp::MultiVector &R) const;
  CsrMatrix extract(const CsrMatrix &K, bool rows_on_boundary, bool columns_on_boundary) const;

  RunContext                         &context;
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
