#ifndef snug_state_gluing_h
#define snug_state_gluing_h

#include <snug/state/gluing_rows.h>

namespace snug::state {
/**
 * The rows of B. At a node with m copies (one per subdomain that reaches
 * it) m-1 orthonormal (Helmert) rows (1, .., 1, -i, 0, ..)/sqrt(i(i+1))
 * glue each component, and one row per held direction q of DirichletConstraints,
 * (q, .., q)/sqrt(m) with right-hand side sqrt(m) s, holds what is glued.
 * A contact row spreads its coefficients c evenly over the copies of its
 * nodes, after they were projected off the held directions (their share
 * (c . q) s goes to the gap), and is divided by
 * nr = sqrt(sum_a |c_a|^2 / m_a) of the reference geometry.
 * Then B B' = I but for nodes shared by contact rows.
 */
template <int dim>
class Gluing
{
public:
  /**
   * Rows for the copies of all nodes, for @p held and for the contact rows
   * @p reference has at the reference geometry (equal on all ranks).
   * @p held must outlive this object. Collective.
   */
  Gluing(const mesh::BodyMesh<dim>                 &mesh,
         const mesh::Tearing                       &tearing,
         const mesh::Surface<dim>                  &surface,
         const supports::DirichletConstraints<dim> &held,
         const RowCoefficients<dim>                &reference);

  const feti::RowLayout &layout() const { return *rows.layout; }

  /// Global dual rows, contact rows among them, of all ranks.
  unsigned int n_rows() const { return rows.n_global; }
  unsigned int n_contact_rows() const { return rows.scales.size(); }

  /// nr of each contact row: physical force = lambda / nr.
  const std::vector<double> &contact_scales() const { return rows.scales; }

  /// B of subdomain @p s of this rank.
  void fill_B(unsigned int s, const RowCoefficients<dim> &rows, std::vector<feti::BEntry> &B) const;

  /// B' where @p rows have the derivative @p derivative; entries that do
  /// not change are zero.
  void fill_B_derivative(unsigned int                s,
                         const RowCoefficients<dim> &rows,
                         const RowCoefficients<dim> &derivative,
                         std::vector<feti::BEntry>  &B) const;

  /// g of the owned rows in a load case, and g'.
  qp::MultiVector right_hand_side(const RowCoefficients<dim> &rows, unsigned int load_case) const;
  qp::MultiVector right_hand_side_derivative(const RowCoefficients<dim> &rows,
                                             const RowCoefficients<dim> &derivative,
                                             unsigned int                load_case) const;

  /// Gap of contact row @p i in a load case, less what the displacements
  /// held at its nodes take of it [length].
  double gap(unsigned int i, const RowCoefficients<dim> &rows, unsigned int load_case) const;

  /// Contact rows that the supports at their nodes hold entirely: no dual
  /// row, their gaps must not be negative.
  std::vector<unsigned int> vanished_rows() const;

  /// Values of the owned contact rows on all ranks, in the order of the
  /// contact rows. Collective.
  std::vector<double> gather_contact(const double *owned_values) const;

  /**
   * Multipliers of q . u = s at each held node and direction, on all
   * ranks, as if contact rows were not projected off the held directions:
   * -reaction * q is the force of the support on the body [force].
   * Collective.
   */
  std::vector<std::vector<double>> reactions(const double               *owned_lambda,
                                             const RowCoefficients<dim> &rows) const;

  /// Owned row -> contact row, or n_contact_rows().
  const std::vector<unsigned int> &contact_of_row() const { return owned_contact; }

private:
  using Source = typename GluingRows<dim>::Source;

  double gap_derivative(unsigned int                i,
                        const RowCoefficients<dim> &rows,
                        const RowCoefficients<dim> &derivative,
                        unsigned int                load_case) const;

  const supports::DirichletConstraints<dim> &held;
  GluingRows<dim>                            rows;
  std::vector<unsigned int>                  owned_contact;
};
} // namespace snug::state

#endif
