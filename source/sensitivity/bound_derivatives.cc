#include <snug/sensitivity/bound_derivatives.h>
#include <snug/sensitivity/tangent_system.h>

#include <algorithm>

namespace snug::sensitivity {
namespace {
/// Return b / a of each contact in the units of the multipliers.
template <int dim>
std::vector<double> bounds_per_area(const state::StateSolver<dim>  &solver,
                                    const state::ContactState<dim> &state)
{
  const auto         &contact = solver.contact(state.load_case);
  const auto         &scales  = solver.gluing(state.load_case).contact_scales();
  std::vector<double> result;
  for (unsigned int i = 0; i < contact.n_rows(); ++i)
    result.push_back(contact.friction(i).bound * scales[i]);
  return result;
}
} // namespace

template <int dim>
bool has_bounds(const state::StateSolver<dim> &solver, const state::ContactState<dim> &state)
{
  const auto bounds = bounds_per_area(solver, state);
  return std::any_of(bounds.begin(), bounds.end(), [](const double bound) { return bound > 0.; });
}

template <int dim>
qp::MultiVector bound_derivatives(const state::StateSolver<dim>       &solver,
                                  const state::ContactState<dim>      &state,
                                  const std::vector<mesh::Field<dim>> &velocities)
{
  if (!has_bounds(solver, state))
    return qp::MultiVector(0, 0);
  const auto     &surface    = solver.surface();
  const auto     &x          = state.surface_positions;
  const auto      per_area   = bounds_per_area(solver, state);
  const auto     &of_contact = solver.gluing(state.load_case).contact_of_row();
  const auto      slips      = strong_rows(solver, state).slips();
  qp::MultiVector result(solver.feti(state).n_owned(),
                         static_cast<unsigned int>(velocities.size()));
  for (unsigned int j = 0; j < velocities.size(); ++j)
    {
      const auto areas =
        solver.contact(state.load_case).area_derivatives(x, surface.gather(velocities[j]));
      for (const qp::Slip &slip : slips)
        {
          const unsigned int i = of_contact[slip.cone.normal];
          for (unsigned int t = 0; t < slip.cone.n_tangents; ++t)
            result(slip.cone.tangents[t], j) = per_area[i] * areas[i] * slip.direction[t];
        }
    }
  return result;
}

template <int dim>
void add_bound_gradient(const state::StateSolver<dim>  &solver,
                        const state::ContactState<dim> &state,
                        const qp::MultiVector          &of_rows,
                        const unsigned int              j,
                        mesh::Field<dim>               &gradient)
{
  const auto      free_rows = strong_rows(solver, state);
  qp::MultiVector along(of_rows.n_rows()); // x'n^, in the normal row of each contact
  for (const qp::Slip &slip : free_rows.slips())
    for (unsigned int t = 0; t < slip.cone.n_tangents; ++t)
      along(slip.cone.normal) += slip.direction[t] * of_rows(slip.cone.tangents[t], j);
  auto       factors  = solver.gluing(state.load_case).gather_contact(along).front();
  const auto per_area = bounds_per_area(solver, state);
  factors.resize(per_area.size());
  for (unsigned int i = 0; i < factors.size(); ++i)
    factors[i] *= per_area[i];
  const auto &surface = solver.surface();
  surface.add_owned(solver.contact(state.load_case).area_gradient(state.surface_positions, factors),
                    gradient);
}

#define SNUG_INSTANTIATE(dim)                                                                            \
  template bool has_bounds(const state::StateSolver<dim> &, const state::ContactState<dim> &);           \
  template qp::MultiVector bound_derivatives(const state::StateSolver<dim> &,                            \
                                             const state::ContactState<dim> &,                           \
                                             const std::vector<mesh::Field<dim>> &);                     \
  template void            add_bound_gradient(const state::StateSolver<dim> &,                           \
                                              const state::ContactState<dim> &, const qp::MultiVector &, \
                                              unsigned int, mesh::Field<dim> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::sensitivity
