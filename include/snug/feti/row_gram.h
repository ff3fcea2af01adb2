#ifndef snug_feti_row_gram_h
#define snug_feti_row_gram_h

#include <snug/feti/coarse_space.h>

#include <memory>

namespace snug::feti {
/// This class is the structure of a RowGram: its groups of rows and their patterns. It belongs to a
/// pairing.
struct RowGramStructure
{
  /// Find the structure of the rows of @p layout for the subdomains of @p table.
  RowGramStructure(const RowLayout &layout, const SubdomainTable &table);

  /// One group of rows. No row couples two groups.
  struct Group
  {
    std::vector<unsigned int>         rows; ///< owned rows, ascending
    std::shared_ptr<const CsrPattern> pattern;
  };

  Group         fixed;   ///< rows that are not coupled to contact rows
  Group         contact; ///< contact rows and the rows coupled to them
  FillOrderings orderings;
  FactorPool    factors{MatrixKind::row_gram, Factorization::CHOLMOD, &orderings};
  /// of each owned row: (in the contact group, index in its group)
  std::vector<std::pair<bool, unsigned>> place;
  /// gathered entries of each unknown (subdomain, dof), without those of rigid bodies (1/D = 0)
  std::vector<std::vector<unsigned int>> entries_of_unknown;
  std::vector<unsigned int>              row_of_entry;
  qp::RowSet beside_ties; ///< contact rows, if there are RowLayout::tie_rows()
};

/**
 * The Gram matrix @f$W_M = B_M D^{-1} B_M^T@f$ of the rows of B on the owned rows. It corrects the
 * preconditioner where rows are not orthonormal: stiffness scaling, and contact rows that share
 * nodes. Rows coupled to contact rows are factorized per face, the other rows once per
 * design. Rows outside M, and rows of rigid bodies alone, are replaced by rows of the identity.
 */
class RowGram
{
public:
  /// Compute the values. @p entries holds B and 1/D for each gathered entry, @p stride numbers
  /// apart. @p ground holds 1/D of the unknown of a spring at its owned row; empty: no springs.
  /// @p structure must outlive this object.
  RowGram(const RowGramStructure    &structure,
          const std::vector<double> &entries,
          unsigned int               stride,
          const std::vector<double> &ground = {});

  /// The part of the factorization that depends on the set M.
  class Factor
  {
  public:
    Factor(const RowGram &gram, const qp::FreeRows &free);

    /// Set x <- W_M^{-1} x on M, and x <- 0 on rows outside M. Across slips M has one row.
    void solve(qp::MultiVector &x) const;

  private:
    /// Replace the two tangential rows of slips by their combinations across and along the slip, or
    /// go back. The row along the slip is not in M.
    CsrMatrix turned(CsrMatrix matrix) const;

    const RowGram                      &gram;
    const qp::FreeRows                  free;
    qp::RowSet                          rows; ///< M, across slips in the first tangential row
    std::shared_ptr<const SparseFactor> W;    ///< factor of the contact group
  };

private:
  const RowGramStructure             &structure;
  CsrMatrix                           contact; ///< matrix of the contact group
  std::shared_ptr<const SparseFactor> fixed;   ///< factor of the fixed group
};
} // namespace snug::feti

#endif
