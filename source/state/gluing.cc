#include <snug/state/gluing.h>

namespace snug
{
  namespace state
  {
    template <int dim>
    Gluing<dim>::Gluing(const mesh::BodyMesh<dim>            &mesh,
                        const mesh::Tearing                  &tearing,
                        const mesh::Surface<dim>             &surface,
                        const std::vector<Support>           &supports,
                        const std::vector<contact::Row<dim>> &reference_rows)
      : rows(mesh, tearing, surface, supports, reference_rows)
    {
    }

    template <int dim>
    const feti::RowLayout &
    Gluing<dim>::layout() const
    {
      return *rows.layout;
    }

    template <int dim>
    unsigned int
    Gluing<dim>::n_rows() const
    {
      return rows.n_global;
    }

    template <int dim>
    unsigned int
    Gluing<dim>::n_contact_rows() const
    {
      return rows.scales.size();
    }

    template <int dim>
    const std::vector<double> &
    Gluing<dim>::contact_scales() const
    {
      return rows.scales;
    }

    template <int dim>
    const std::vector<unsigned int> &
    Gluing<dim>::contact_of_row() const
    {
      return rows.owned_contact;
    }

    template <int dim>
    std::vector<unsigned int>
    Gluing<dim>::vanished_rows() const
    {
      std::vector<unsigned int> vanished;
      for (unsigned int i = 0; i < rows.scales.size(); ++i)
        if (rows.scales[i] == 0.)
          vanished.push_back(i);
      return vanished;
    }

    template <int dim>
    void
    Gluing<dim>::fill_B(unsigned int                          s,
                        const std::vector<contact::Row<dim>> &contact_rows,
                        bool                                  derivative,
                        std::vector<feti::BEntry>            &B) const
    {
      B.clear();
      for (const auto &entry : rows.entries[s])
        {
          double value = derivative ? 0. : entry.value;
          if (entry.contact < rows.scales.size())
            {
              const auto &c =
                contact_rows[entry.contact].coefficients[entry.coefficient];
              value = rows.projected(c.first, c.second)[entry.dof % dim] /
                      (rows.copies[c.first] * rows.scales[entry.contact]);
            }
          B.push_back({entry.local_row, entry.dof, value});
        }
    }

    template <int dim>
    qp::MultiVector
    Gluing<dim>::right_hand_side(
      const std::vector<contact::Row<dim>> &contact_rows) const
    {
      qp::MultiVector g(rows.layout->n_owned());
      for (unsigned int row = 0; row < rows.layout->n_owned(); ++row)
        if (rows.owned_contact[row] < rows.scales.size())
          g(row) = contact_rows[rows.owned_contact[row]].gap /
                   rows.scales[rows.owned_contact[row]];
      return g;
    }

    template <int dim>
    std::vector<double>
    Gluing<dim>::gather_contact(const double *owned_values) const
    {
      std::vector<double> values(rows.scales.size(), 0.);
      for (unsigned int row = 0; row < rows.layout->n_owned(); ++row)
        if (rows.owned_contact[row] < rows.scales.size())
          values[rows.owned_contact[row]] = owned_values[row];
      MPI_Allreduce(MPI_IN_PLACE,
                    values.data(),
                    values.size(),
                    MPI_DOUBLE,
                    MPI_SUM,
                    rows.layout->communicator());
      return values;
    }

    template class Gluing<2>;
    template class Gluing<3>;
  } // namespace state
} // namespace snug
