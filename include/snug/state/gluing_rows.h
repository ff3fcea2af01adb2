#ifndef snug_state_gluing_rows_h
#define snug_state_gluing_rows_h

#include <snug/contact/row_group.h>
#include <snug/feti/row_layout.h>
#include <snug/feti/subdomain_system.h>
#include <snug/mesh/tearing.h>
#include <snug/state/support.h>

#include <map>
#include <memory>

namespace snug
{
  namespace state
  {
    /**
     * Who owns which row of B and which copies of which nodes it joins: the
     * topology of Gluing. Each node's copies meet on one rank, which numbers
     * the rows and sends their entries to the subdomains.
     */
    template <int dim>
    class GluingRows
    {
    public:
      using Directions = std::vector<dealii::Tensor<1, dim>>;

      /// An entry whose value is fixed, or follows a contact row.
      struct Entry
      {
        unsigned int local_row, dof;
        double       value;       ///< of a fixed entry
        unsigned int contact;     ///< contact row, or n_contact_rows
        unsigned int coefficient; ///< index in the row's coefficients
      };

      /// See Gluing. Collective.
      GluingRows(const mesh::BodyMesh<dim>            &mesh,
                 const mesh::Tearing                  &tearing,
                 const mesh::Surface<dim>             &surface,
                 const std::vector<Support>           &supports,
                 const std::vector<contact::Row<dim>> &reference_rows);

      /// The part of a coefficient at a surface node that its supports leave.
      dealii::Tensor<1, dim>
      projected(unsigned int                  surface_node,
                const dealii::Tensor<1, dim> &coefficient) const;

      std::unique_ptr<feti::RowLayout> layout;
      std::vector<std::vector<Entry>>  entries;       ///< per subdomain
      std::vector<unsigned int>        owned_contact; ///< per owned row
      std::vector<double>              scales;        ///< nr per contact row
      std::vector<unsigned int>        copies;        ///< per surface node
      unsigned int                     n_global = 0;

    private:
      /// The copies of one node, known to the owner of its rows.
      struct NodeCopies
      {
        std::vector<unsigned int> subdomains; ///< global ids, ascending
        Directions                fixed;
      };

      /// One entry on its way from the owner of the row to the subdomain.
      struct Message;

      void
      collect_surface(const mesh::Tearing        &tearing,
                      const std::vector<Support> &supports);
      void
      scale_rows(const std::vector<contact::Row<dim>> &reference_rows);
      std::vector<unsigned int>
      cluster_ranks(const std::vector<contact::Row<dim>> &rows) const;
      std::map<unsigned int, NodeCopies>
      collect_copies(const mesh::Tearing             &tearing,
                     const std::vector<Support>      &supports,
                     const std::vector<unsigned int> &rank_of_contact) const;
      qp::RowSet
      number_rows(const std::map<unsigned int, NodeCopies> &nodes,
                  const std::vector<contact::Row<dim>>     &reference_rows,
                  const std::vector<unsigned int>          &rank_of_contact,
                  std::vector<Message>                     &messages);
      void
      deliver(const std::vector<Message> &messages,
              const mesh::Tearing        &tearing,
              const qp::RowSet           &bounded);

      const mesh::BodyMesh<dim> &mesh;
      const mesh::Surface<dim>  &surface;
      std::vector<Directions>    fixed_directions; ///< per surface node
    };
  } // namespace state
} // namespace snug

#endif
