#ifndef snug_feti_local_schur_h
#define snug_feti_local_schur_h

#include <snug/base/run_context.h>
#include <snug/feti/sparse_factor.h>
#include <snug/feti/subdomain_system.h>

#include <memory>

namespace snug::feti {
/**
 * The primal operator of one subdomain inside the preconditioner, on its
 * unknowns b with an entry in B, and on the fixing unknowns where holding
 * those leaves it a rigid motion:
 * S = K_bb - K_bi K_ii^{-1} K_ib ("Dirichlet") or K_bb ("lumped").
 * b and the symbolic part are made with the first numbers.
 */
class LocalSchur
{
public:
  /// @p system and @p orderings must outlive this object.
  LocalSchur(const SubdomainSystem &system,
             bool                   lumped,
             Factorization          package,
             FillOrderings         &orderings,
             RunContext            &context);

  /// For the present K and R.
  void factorize(const std::string &what);

  /// Unknown of the subdomain -> position in b, or n_boundary().
  const std::vector<unsigned int> &boundary_position() const { return position_b; }

  unsigned int n_boundary() const { return n_b; }

  /// S x for every column; n_boundary rows.
  qp::MultiVector apply(const qp::MultiVector &x) const;

private:
  struct Part
  {
    CsrMatrix                matrix;
    std::vector<std::size_t> source; ///< positions in K.values
  };

  void choose_boundary(bool with_fixing_dofs);
  bool boundary_holds() const;
  Part extract(bool rows_on_boundary, bool columns_on_boundary) const;

  const SubdomainSystem        &system;
  RunContext                   &context;
  const bool                    lumped;
  const Factorization           package;
  FillOrderings                &orderings;
  bool                          has_fixing_dofs = false;
  unsigned int                  n_b = 0, n_i = 0;
  std::vector<unsigned int>     position_b, position_i;
  Part                          bb; ///< its lower triangle
  Part                          ib, ii;
  std::unique_ptr<SparseFactor> factor;
};

/// Rows of x, of all unknowns, at the boundary.
qp::MultiVector on_boundary(const qp::MultiVector &x, const LocalSchur &schur);
} // namespace snug::feti

#endif
