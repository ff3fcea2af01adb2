#ifndef snug_state_gluing_h
#define snug_state_gluing_h

#include <snug/state/gluing_rows.h>

namespace snug
{
  namespace state
  {
    /**
     * The rows of B. At a node with m copies (one per subdomain that reaches
     * it): every copy carries one unit row per fixed direction; the other
     * directions carry m-1 orthonormal (Helmert) rows
     * (1, .., 1, -i, 0, ..)/sqrt(i(i+1)); a contact row spreads its
     * coefficients evenly over the copies of its nodes, after they were
     * projected off the fixed directions, and is divided by
     * nr = sqrt(sum_a |c_a|^2 / m_a) of the reference geometry.
     * Then B B' = I but for nodes shared by contact rows.
     */
    template <int dim>
    class Gluing
    {
    public:
      /**
       * Rows for the copies of all nodes and for @p reference_rows, the
       * contact rows at the reference geometry (equal on all ranks).
       * Collective.
       */
      Gluing(const mesh::BodyMesh<dim>            &mesh,
             const mesh::Tearing                  &tearing,
             const mesh::Surface<dim>             &surface,
             const std::vector<Support>           &supports,
             const std::vector<contact::Row<dim>> &reference_rows);

      const feti::RowLayout &
      layout() const;

      /// Global dual rows, contact rows among them, of all ranks.
      unsigned int
      n_rows() const;
      unsigned int
      n_contact_rows() const;

      /// nr of each contact row: physical force = lambda / nr.
      const std::vector<double> &
      contact_scales() const;

      /// B of subdomain @p s of this rank for the given contact rows; with
      /// @p derivative only their entries, the others are zero.
      void
      fill_B(unsigned int                          s,
             const std::vector<contact::Row<dim>> &rows,
             bool                                  derivative,
             std::vector<feti::BEntry>            &B) const;

      /// Contact rows that the supports at their nodes hold entirely: no dual
      /// row, their gaps must not be negative.
      std::vector<unsigned int>
      vanished_rows() const;

      /// Right-hand side of the owned rows: gap / nr at contact rows.
      qp::MultiVector
      right_hand_side(const std::vector<contact::Row<dim>> &rows) const;

      /// Values of the owned contact rows on all ranks, in the order of the
      /// contact rows. Collective.
      std::vector<double>
      gather_contact(const double *owned_values) const;

      /// Owned row -> contact row, or n_contact_rows().
      const std::vector<unsigned int> &
      contact_of_row() const;

    private:
      GluingRows<dim> rows;
    };
  } // namespace state
} // namespace snug

#endif
