#ifndef snug_feti_contact_gram_h
#define snug_feti_contact_gram_h

#include <snug/feti/contact_nodes.h>

namespace snug::feti {
/**
 * The parts of @f$W = B D^{-1} B^T@f$ that belong to the contact rows C. With the node rows E, the
 * Schur complement @f$S = W_{CC} - W_{CE} W_{EE}^{-1} W_{EC}@f$ is a sum over nodes. It is kept as
 * @f$S = L D^{-1} L^T + \mathrm{diag}(g)@f$: the rows of L are the rows of @f$B_C@f$ minus their
 * projections on those of @f$B_E@f$ in the inner product of @f$D^{-1}@f$. At tied nodes S is too
 * large, because ties are not eliminated.
 */
class ContactGram
{
public:
  /// Compute the values. @p entries holds B and 1/D for each gathered entry, @p stride numbers
  /// apart. @p ground is g for owned rows; empty: zero. Rows with S_ii = 0 get g = 1.
  /// @p structure must outlive this object. Collective.
  ContactGram(const ContactNodes        &structure,
              const std::vector<double> &entries,
              unsigned int               stride,
              std::vector<double>        ground);

  /// Return W_CE y for the equality rows E, zero in these rows. Collective.
  qp::MultiVector from_equalities(const qp::MultiVector &y) const;

  /// Return W_EC z for the equality rows E, zero in contact rows. Collective.
  qp::MultiVector to_equalities(const qp::MultiVector &z) const;

  /// Check that the free rows are different. Not collective.
  /// @throws SolveError if two free rows of this rank are the same up to a factor.
  void check(const qp::FreeRows &free) const;

  /**
   * Set x <- p(P S P) x in the contact rows, for x = P x with the projector P on the free
   * multipliers (qp::FreeRows::restrict()). p(S) is close to 1/S: of the eigenvalues of S, scaled
   * to unit diagonal, those above 1/30 of the largest are inverted within 5 %, and p is positive
   * below. Chebyshev iterations of fixed degree, so that p is linear. Collective.
   */
  void solve(const qp::FreeRows &free, qp::MultiVector &x) const;

private:
  /// An entry of L or W_EC in a contact row of the nodes.
  struct Value
  {
    unsigned int row;    ///< place among the contact rows of the nodes
    unsigned int column; ///< of L, or owned equality row of W_EC
    double       value;
  };

  void            add_node(const ContactNodes::Node  &node,
                           const std::vector<double> &entries,
                           unsigned int               stride,
                           const qp::MultiVector     &received);
  void            scale();
  void            find_equal_rows();
  qp::MultiVector multiply(const qp::MultiVector &x) const;

  const ContactNodes &structure;
  std::vector<Value>  W_EC, L;
  std::vector<double> weights; ///< 1/D of the columns of L
  std::vector<double> ground;
  std::vector<double> diagonal; ///< of S; 0 in equality rows
  /// bounds of the eigenvalues of S scaled to unit diagonal, and number of terms of p
  double       high = 1., low = 1.;
  unsigned int n_terms = 1;
  /// owned rows that are the same up to a factor
  std::vector<std::pair<unsigned int, unsigned int>> equal_rows;
};
} // namespace snug::feti

#endif
