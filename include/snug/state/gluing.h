#ifndef snug_state_gluing_h
#define snug_state_gluing_h

#include <snug/contact/contact_rows.h>
#include <snug/feti/row_layout.h>
#include <snug/feti/subdomain_system.h>
#include <snug/mesh/tearing.h>

#include <map>
#include <memory>

namespace snug
{
  namespace state
  {
    /// Fixed displacement components of one boundary of a body.
    struct Support
    {
      unsigned int              body, boundary;
      std::vector<unsigned int> components;
    };

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
      Gluing(const mesh::BodyMesh<dim>             &mesh,
             const mesh::Tearing                   &tearing,
             const mesh::Surface<dim>              &surface,
             const std::vector<Support>            &supports,
             const std::vector<contact::Row<dim>>  &reference_rows);

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
      struct Builder;

      /// An entry whose value is fixed, or follows a contact row.
      struct Entry
      {
        unsigned int local_row, dof;
        double       value;       ///< of a fixed entry
        unsigned int contact;     ///< contact row, or none
        unsigned int coefficient; ///< index in the row's coefficients
      };

      const mesh::Surface<dim>        &surface;
      std::unique_ptr<feti::RowLayout> rows;
      std::vector<std::vector<Entry>>  entries; ///< per subdomain
      std::vector<unsigned int>        owned_contact;
      std::vector<double>              scales;
      /// fixed directions at surface nodes, orthonormal
      std::vector<std::vector<dealii::Tensor<1, dim>>> fixed_directions;
      std::vector<unsigned int>                        copies; ///< surface nodes
      unsigned int                                     n_global = 0;
    };
  } // namespace state
} // namespace snug

#endif
