#include <snug/accuracy/contact_pressure.h>
#include <snug/accuracy/transfer.h>

namespace snug::accuracy {
template <int dim>
qp::WarmStart transferred(const state::StateSolver<dim>  &from,
                          const state::ContactState<dim> &state,
                          const state::StateSolver<dim>  &to,
                          const mesh::Field<dim>         &positions)
{
  std::vector<double> pressures;
  for (const auto &point : state.contact)
    pressures.push_back(point.pressure);
  const ContactSides<dim> sides(from, from.contact(state.load_case), state);
  const auto              nodal    = sides.values(pressures);
  const auto             &contact  = to.contact(state.load_case);
  const auto              x        = to.surface().gather(positions);
  const auto              in_space = contact.placed_surface().to_space(x);
  const auto              areas    = contact.areas(x);
  const auto             &places   = contact.places();
  std::vector<double>     forces;
  bool                    any = false;
  for (unsigned int i = 0; i < places.size(); ++i)
    {
      const auto shares = sides.closest(places[i].pair, in_space[places[i].slave]);
      forces.push_back(std::max(0., areas[i] * value(shares, nodal)));
      any = any || forces.back() > 0.;
    }
  if (!any)
    return qp::WarmStart();
  const auto   &gluing         = to.gluing(state.load_case);
  const auto   &contact_of_row = gluing.contact_of_row();
  qp::WarmStart start{qp::MultiVector(contact_of_row.size()), qp::RowSet(contact_of_row.size(), 1)};
  for (unsigned int row = 0; row < contact_of_row.size(); ++row)
    if (contact_of_row[row] < forces.size())
      {
        const double force = forces[contact_of_row[row]];
        start.lambda(row)  = force * gluing.contact_scales()[contact_of_row[row]];
        start.active[row]  = force > 0.;
      }
  return start;
}

#define SNUG_INSTANTIATE(dim)                                          \
  template qp::WarmStart transferred(const state::StateSolver<dim> &,  \
                                     const state::ContactState<dim> &, \
                                     const state::StateSolver<dim> &, const mesh::Field<dim> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::accuracy
