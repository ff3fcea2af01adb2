#include <snug/base/errors.h>
#include <snug/contact/contact.h>
#include <snug/contact/nodal_rows.h>

namespace snug
{
  namespace contact
  {
    namespace
    {
      template <int dim>
      PairFaces
      find_sides(const mesh::Surface<dim> &surface, const Pair &pair)
      {
        PairFaces sides;
        for (unsigned int f = 0; f < surface.faces().size(); ++f)
          {
            const auto &face = surface.faces()[f];
            const auto  side = std::make_pair(face.body, face.boundary);
            if (side == pair.slave)
              sides.slave.push_back(f);
            if (side == pair.master)
              sides.master.push_back(f);
          }
        return sides;
      }

      /// The rows of all groups, one after the other.
      template <typename Groups, typename Values>
      auto
      joined(const Groups &groups, const Values &values)
      {
        decltype(values(*groups.front())) result;
        for (const auto &group : groups)
          {
            const auto of_group = values(*group);
            result.insert(result.end(), of_group.begin(), of_group.end());
          }
        return result;
      }
    } // namespace

    template <int dim>
    const ChoiceTable<std::unique_ptr<RowGroup<dim>>(const PairGeometry<dim> &)>
      &
      contact_method_table()
    {
      static const ChoiceTable<std::unique_ptr<RowGroup<dim>>(
        const PairGeometry<dim> &)>
        table = {{"nodal",
                  "slave nodes against the closest points of master faces",
                  [](const PairGeometry<dim> &pair) {
                    return std::make_unique<NodalRows<dim>>(pair);
                  }}};
      return table;
    }

    template <int dim>
    Contact<dim>::Contact(const mesh::Surface<dim> &surface,
                          const std::vector<Pair>  &pairs,
                          unsigned int              degree,
                          const Field              &positions)
      : surface(surface)
    {
      const FaceShape<dim> shape(degree);
      for (unsigned int p = 0; p < pairs.size(); ++p)
        {
          const PairGeometry<dim> geometry{surface,
                                           shape,
                                           find_sides(surface, pairs[p]),
                                           positions};
          groups.push_back(choose(contact_method_table<dim>(), pairs[p].method)
                             .make(geometry));
          for (const unsigned int slave : groups.back()->slaves())
            row_places.push_back({p, slave});
          if (groups.back()->slaves().empty())
            throw InputError("contact pair '" + pairs[p].name +
                             "': no slave node lies opposite to the master");
        }
    }

    template <int dim>
    unsigned int
    Contact<dim>::n_rows() const
    {
      return row_places.size();
    }

    template <int dim>
    const std::vector<RowPlace> &
    Contact<dim>::places() const
    {
      return row_places;
    }

    template <int dim>
    std::vector<Row<dim>>
    Contact<dim>::rows(const Field &positions) const
    {
      AssertDimension(positions.size(), surface.n_nodes());
      return joined(groups, [&](const RowGroup<dim> &group) {
        return group.rows(positions);
      });
    }

    template <int dim>
    std::vector<Row<dim>>
    Contact<dim>::row_derivatives(const Field &positions,
                                  const Field &velocity) const
    {
      AssertDimension(positions.size(), surface.n_nodes());
      AssertDimension(velocity.size(), surface.n_nodes());
      return joined(groups, [&](const RowGroup<dim> &group) {
        return group.row_derivatives(positions, velocity);
      });
    }

    template <int dim>
    typename Contact<dim>::Field
    Contact<dim>::energy_gradient(const Field               &positions,
                                  const Field               &displacement,
                                  const std::vector<double> &forces) const
    {
      AssertDimension(positions.size(), surface.n_nodes());
      AssertDimension(displacement.size(), surface.n_nodes());
      AssertDimension(forces.size(), n_rows());
      Field gradient(surface.n_nodes());
      auto  first = forces.begin();
      for (const auto &group : groups)
        {
          const auto last = first + group->slaves().size();
          group->add_energy_gradient(positions,
                                     displacement,
                                     std::vector<double>(first, last),
                                     gradient);
          first = last;
        }
      return gradient;
    }

    template <int dim>
    std::vector<double>
    Contact<dim>::areas(const Field &positions) const
    {
      AssertDimension(positions.size(), surface.n_nodes());
      return joined(groups, [&](const RowGroup<dim> &group) {
        return group.areas(positions);
      });
    }

    template const ChoiceTable<
      std::unique_ptr<RowGroup<2>>(const PairGeometry<2> &)> &
    contact_method_table();
    template const ChoiceTable<
      std::unique_ptr<RowGroup<3>>(const PairGeometry<3> &)> &
    contact_method_table();
    template class Contact<2>;
    template class Contact<3>;
  } // namespace contact
} // namespace snug
