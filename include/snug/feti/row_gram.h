#ifndef snug_feti_row_gram_h
#define snug_feti_row_gram_h

#include <snug/feti/factor_pool.h>
#include <snug/feti/row_layout.h>

#include <memory>

namespace snug::feti {
/**
 * The Gram matrix @f$W_M = B_M D^{-1} B_M^T@f$ of the rows of B on the owned rows. It corrects the
 * preconditioner where rows are not orthonormal: stiffness scaling, node-to-face rows, supports at
 * contact nodes. Rows coupled to contact rows are factorized per face, the other rows once per
 * design. Rows outside M are replaced by rows of the identity.
 */
class RowGram
{
public:
  explicit RowGram(const RowLayout &layout);

  /// Set the values. @p entries holds B and 1/D for each gathered entry, @p stride numbers apart.
  void update(const std::vector<double> &entries, unsigned int stride);

  /// The part of the factorization that depends on the set M.
  class Factor
  {
  public:
    Factor(const RowGram &gram, const qp::RowSet &free);

    /// Set x <- W_M^{-1} x on M, and x <- 0 on rows outside M.
    void solve(qp::MultiVector &x) const;

  private:
    const RowGram                      &gram;
    qp::RowSet                          free;
    std::shared_ptr<const SparseFactor> W; ///< factor of the contact group
  };

private:
  /// One group of rows with its matrix in the group's numbering.
  struct Group
  {
    std::vector<unsigned int> rows; ///< owned rows, ascending
    CsrMatrix                 matrix;
    void                      solve(const SparseFactor &factor, qp::MultiVector &x) const;
  };

  Group         fixed, contact;
  FillOrderings orderings;
  FactorPool    factors{FactorOf::row_gram, Factorization::CHOLMOD, &orderings};
  std::vector<std::pair<bool, unsigned>>
    place; ///< of each owned row: (in contact group, index in group)
  std::shared_ptr<const SparseFactor> fixed_factor;
  /// Gathered entries of each unknown (subdomain, dof).
  std::vector<std::vector<unsigned int>> entries_of_unknown;
  std::vector<unsigned int>              row_of_entry;
};
} // namespace snug::feti

#endif
