#ifndef snug_feti_row_gram_h
#define snug_feti_row_gram_h

#include <snug/feti/contact_gram.h>

#include <memory>

namespace snug::feti {
/// This class is the structure of a RowGram: the groups of the equality rows with their patterns,
/// and the nodes of the contact rows. It belongs to a pairing.
struct RowGramStructure
{
  /// Find the structure of the rows of @p layout for the subdomains of @p table. Collective.
  RowGramStructure(const RowLayout &layout, const SubdomainTable &table);

  /// One group of equality rows. No equality row couples two groups.
  struct Group
  {
    std::vector<unsigned int>         rows; ///< owned rows, ascending
    std::shared_ptr<const CsrPattern> pattern;
  };

  const RowEntries          entries; ///< of the equality rows
  const ContactNodes        contact;
  qp::RowSet                ties;  ///< flag of each owned row
  Group                     alone; ///< node rows that are not coupled to ties
  Group                     tied;  ///< ties and the node rows coupled to them
  FillOrderings             orderings;
  FactorPool                factors{MatrixKind::row_gram, Factorization::CHOLMOD, &orderings};
  std::vector<unsigned int> place; ///< of each owned equality row in its group
};

/**
 * The Gram matrix @f$W_M = B_M D^{-1} B_M^T@f$ of the rows of B on the owned rows. It corrects the
 * preconditioner where rows are not orthonormal: stiffness scaling, and contact rows that share
 * nodes. The equality rows are always in M, and one factorization serves all sets. They are
 * eliminated, and the Schur complement of the contact rows is inverted by a polynomial, see
 * ContactGram. Rows of rigid bodies alone are replaced by rows of the identity.
 */
class RowGram
{
public:
  /// Compute the values. @p entries holds B and 1/D for each gathered entry, @p stride numbers
  /// apart. @p ground holds 1/D of the unknown of a spring at its owned row; empty: no springs.
  /// @p structure must outlive this object. Collective.
  RowGram(const RowGramStructure    &structure,
          const std::vector<double> &entries,
          unsigned int               stride,
          const std::vector<double> &ground = {});

  /// Set x <- W_M^{-1} x on M, the inverse of the contact rows by the polynomial, and x <- 0 on
  /// rows outside M. Across slips M has one row. Collective.
  void solve(const qp::FreeRows &free, qp::MultiVector &x) const;

  /// Check that the free contact rows are different, see ContactGram::check(). Not collective.
  void check(const qp::FreeRows &free) const { contact.check(free); }

  /// Set x <- W_EE^{-1} x in the equality rows E, and x <- 0 in the contact rows.
  void solve_equalities(qp::MultiVector &x) const;

  /// Set x <- W_EE^{-1} x in the node rows E, and x <- 0 in the other rows.
  void solve_node_rows(qp::MultiVector &x) const;

private:
  void solve_groups(const SparseFactor *of_tied, qp::MultiVector &x) const;

  const RowGramStructure             &structure;
  CsrMatrix                           tied_matrix;
  std::shared_ptr<const SparseFactor> alone, tied; ///< factors of the groups, null if empty
  ContactGram                         contact;
};
} // namespace snug::feti

#endif
