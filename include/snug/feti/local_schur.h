#ifndef snug_feti_local_schur_h
#define snug_feti_local_schur_h

#include <snug/base/run_context.h>
#include <snug/feti/sparse_factor.h>
#include <snug/feti/subdomain_system.h>

#include <memory>
#include <string>

namespace snug::feti {
/**
 * The primal operator of one subdomain inside the preconditioner, on its
 * unknowns b with an entry in B, and on the fixing unknowns where those are
 * too few to hold it:
 * S = K_bb - K_bi K_ii^{-1} K_ib ("Dirichlet") or K_bb ("lumped").
 */
class LocalSchur
{
public:
  /// Symbolic part. @p system must outlive this object.
  LocalSchur(const SubdomainSystem &system,
             bool                   lumped,
             const std::string     &package,
             RunContext            &context);

  /// Numeric part for the present K.
  void factorize(const std::string &what);

  /// Unknown of the subdomain -> position in b, or n_boundary().
  const std::vector<unsigned int> &boundary_position() const;

  unsigned int n_boundary() const;

  /// S x for every column; n_boundary rows.
  qp::MultiVector apply(const qp::MultiVector &x) const;

private:
  struct Part
  {
    CsrMatrix                matrix;
    std::vector<std::size_t> source; ///< positions in K.values
  };

  Part extract(bool rows_on_boundary, bool columns_on_boundary) const;

  const SubdomainSystem        &system;
  RunContext                   &context;
  bool                          lumped;
  unsigned int                  n_b = 0, n_i = 0;
  std::vector<unsigned int>     position_b, position_i;
  Part                          bb; ///< its lower triangle
  Part                          ib, ii;
  std::unique_ptr<SparseFactor> factor;
};
} // namespace snug::feti

#endif
