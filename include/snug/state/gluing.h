#ifndef snug_state_gluing_h
#define snug_state_gluing_h

#include <snug/state/gluing_rows.h>

namespace snug::state {
/**
 * This class provides the rows of B. A node has m copies (one per subdomain that reaches it). For
 * each component, m-1 orthonormal (Helmert) rows (1, .., 1, -i, 0, ..)/sqrt(i(i+1)) glue the
 * copies. For each held direction q of DirichletConstraints, one row (q, .., q)/sqrt(m) with
 * right-hand side sqrt(m) s holds the glued node. A contact row spreads its coefficients c evenly
 * over the copies of its nodes, after projecting c off the held directions. The share (c . q) s of
 * these directions goes to the gap. The row is divided by nr = sqrt(sum_a |c_a|^2 / m_a) of the
 * reference geometry. Then B B' = I except for nodes shared by contact rows.
 *
 * A tangential row along which supports hold both sides (contact::Tangent) has no entries in B, but
 * for those of its couple. Its slip is prescribed, and its friction force goes to the supports. The
 * row has the compliance D of the body near the node, so that the force follows the slip
 * continuously where the slip turns back. The force is at its limit once the slip exceeds D times
 * the limit. A held row along which no displacement is prescribed has no dual row.
 *
 * Entries on the motions of reference points (ReferencePoints) do not count in nr. A motion that
 * the load case holds has one row of length one.
 */
template <int dim>
class Gluing
{
public:
  /**
   * Build the rows for the copies of all nodes, for @p held and for the contact rows that
   * @p reference contains at the reference geometry (equal on all ranks), with the places
   * @p tangents of the tangential rows. The rows of gluing and supports are the same in all
   * positions of the bodies. Motions of the reference points of @p model are held as in
   * @p load_case. References must outlive this object. Collective.
   */
  Gluing(const mesh::BodyMesh<dim>                 &mesh,
         const mesh::Tearing                       &tearing,
         const mesh::Surface<dim>                  &surface,
         const supports::DirichletConstraints<dim> &held,
         const RowCoefficients<dim>                &reference,
         const std::vector<contact::Tangent>       &tangents,
         const Model<dim>                          &model,
         unsigned int                               load_case);

  const feti::RowLayout &layout() const { return *rows.layout; }

  /// Return the global number of dual rows of all ranks, including contact rows.
  unsigned int n_rows() const { return rows.n_global; }
  /// Return the number of normal rows of contact.
  unsigned int n_contact_rows() const { return rows.n_bounded - n_tangents; }

  /// Return nr of each contact row; the physical force is lambda / nr. Tangential rows follow the
  /// normal rows. The scale is 0 where the supports at its nodes hold a row entirely.
  const std::vector<double> &contact_scales() const { return rows.scales; }

  /// Return the unknowns of subdomain @p s of this rank that have an entry in B, ascending.
  std::vector<unsigned int> boundary(unsigned int s) const;

  /// Compute B of subdomain @p s of this rank.
  void fill_B(unsigned int s, const RowCoefficients<dim> &rows, std::vector<feti::BEntry> &B) const;

  /// Compute the derivative B' where @p rows have the derivative @p derivative. Entries that do not
  /// change are zero.
  void fill_B_derivative(unsigned int                s,
                         const RowCoefficients<dim> &rows,
                         const RowCoefficients<dim> &derivative,
                         std::vector<feti::BEntry>  &B) const;

  /// Return g of the owned rows in a load case, or its derivative g'.
  qp::MultiVector right_hand_side(const RowCoefficients<dim> &rows, unsigned int load_case) const;
  qp::MultiVector right_hand_side_derivative(const RowCoefficients<dim> &rows,
                                             const RowCoefficients<dim> &derivative,
                                             unsigned int                load_case) const;

  /// Add the end of the load step before (ContactState::slips) to @p g of the owned rows: to the
  /// tangential rows, and to the rows of motions that the load case locks.
  void
  add_step(const std::vector<double> &before, unsigned int load_case, qp::MultiVector &g) const;

  /// Return the places of the owned rows of locked motions, with their places in
  /// ContactState::slips.
  std::vector<std::pair<unsigned int, unsigned int>> locked_rows(unsigned int load_case) const;

  /// Return the gap of contact row @p i in a load case, minus the part that the displacements held
  /// at its nodes take [length].
  double gap(unsigned int i, const RowCoefficients<dim> &coefficients, unsigned int load_case) const
  {
    return rows.gap(i, coefficients, load_case);
  }

  /// Return the normal rows that the supports at their nodes hold entirely. Such rows have no dual
  /// row, and their gaps must not be negative.
  std::vector<unsigned int> vanished_rows() const;

  /// Return the values of the owned contact rows on all ranks, per column, in the order of
  /// RowCoefficients::row(). Collective.
  std::vector<std::vector<double>> gather_contact(const qp::MultiVector &owned) const;

  /// Forces of the rows of gather_contact().
  struct RowForces
  {
    std::vector<double> contact; ///< of normal rows, then tangential rows
    std::vector<double> ties;
    std::vector<double> all; ///< by RowCoefficients::row()
  };
  /// Return lambda_i / nr_i of the contact rows and of ties on all ranks, per column of
  /// @p multipliers: the forces of the rows, or their derivatives. Rows without a multiplier have
  /// none. Collective.
  std::vector<RowForces> row_forces(const qp::MultiVector &multipliers) const;
  /// Return the parts RowForces::contact.
  std::vector<std::vector<double>> contact_forces(const qp::MultiVector &multipliers) const;

  /// Return the friction cones of the owned contacts, for the law of each contact and its area
  /// [length^2].
  qp::FrictionCones cones(const contact::Contact<dim> &contact,
                          const std::vector<double>   &areas) const;

  /**
   * Return the multipliers @p lambda (one column) of q . u = s at each held node and direction, on
   * all ranks, as if contact rows were not projected off the held directions. The force of the
   * support on the body is -reaction * q [force]. Collective.
   */
  std::vector<std::vector<double>> reactions(const qp::MultiVector      &lambda,
                                             const RowCoefficients<dim> &rows) const;

  /// Return the forces of the supports on the motions of the reference points: force and moment in
  /// the order of the unknowns, 0 where nothing is held [force, force length]. Collective.
  std::vector<std::vector<double>> point_reactions(const double *owned_lambda) const;

  /// @name Springs, in the order of RowCoefficients::springs
  /// @{
  /// Return D = 1 / (nr^2 kappa) of the owned rows of springs and of held tangential rows, zero for
  /// other rows; empty if all are zero. The equations of the rows are B u - D lambda = g.
  std::vector<double> compliances(const RowCoefficients<dim> &rows) const;
  /// Return the derivatives D'.
  std::vector<double> compliance_derivatives(const RowCoefficients<dim> &rows,
                                             const RowCoefficients<dim> &derivative) const;
  /// Return the forces lambda / nr = kappa (c . u) of all springs [force]. Collective.
  std::vector<double> spring_forces(const double *owned_lambda) const;
  /// @}

  /// Return the index of each owned row in RowCoefficients::row(), or the number of these rows for
  /// the other rows.
  const std::vector<unsigned int> &contact_of_row() const { return owned_contact; }

private:
  using Source = typename GluingRows<dim>::Source;

  double gap_derivative(unsigned int                i,
                        const RowCoefficients<dim> &rows,
                        const RowCoefficients<dim> &derivative,
                        unsigned int                load_case) const;

  const supports::DirichletConstraints<dim> &held;
  const Model<dim>                          &model;
  GluingRows<dim>                            rows;
  const unsigned int                         n_tangents, n_ties;
  std::vector<unsigned int>                  owned_contact;
};
} // namespace snug::state

#endif
