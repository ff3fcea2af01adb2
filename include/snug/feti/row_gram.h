#ifndef snug_feti_row_gram_h
#define snug_feti_row_gram_h

#include <snug/feti/factor_pool.h>
#include <snug/feti/row_layout.h>

#include <memory>

namespace snug::feti {
/**
 * @f$W_M = B_M D^{-1} B_M^T@f$ on the owned rows, the Gram matrix of the
 * rows of B that makes the preconditioner right where rows are not
 * orthonormal: stiffness scaling, node-to-face rows, supports at contact
 * nodes. Rows coupled to contact rows are factorized per face, the others
 * once per design. Off M, the rows of W_M are those of the identity.
 */
class RowGram
{
public:
  explicit RowGram(const RowLayout &layout);

  /// New numbers: B and 1/D per gathered entry, @p stride apart, B first.
  void update(const std::vector<double> &entries, unsigned int stride);

  /// The part that depends on the set M.
  class Factor
  {
  public:
    Factor(const RowGram &gram, const qp::RowSet &free);

    /// x <- W_M^{-1} x on M, zero off M.
    void solve(qp::MultiVector &x) const;

  private:
    const RowGram                      &gram;
    qp::RowSet                          free;
    std::shared_ptr<const SparseFactor> W; ///< of the contact group
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
  std::vector<std::pair<bool, unsigned>> place; ///< (in contact, index)
  std::shared_ptr<const SparseFactor>    fixed_factor;
  /// entries by unknown: (subdomain, dof) -> gathered entries
  std::vector<std::vector<unsigned int>> entries_of_unknown;
  std::vector<unsigned int>              row_of_entry;
};
} // namespace snug::feti

#endif
