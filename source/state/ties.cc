#include <snug/state/ties.h>

namespace snug::state {
template <int dim>
Ties<dim>::Ties(const mesh::Surface<dim>         &surface,
                std::vector<contact::Pair>        pairs,
                const unsigned int                degree,
                const Field                      &positions,
                const faces::HeldDirections<dim> &held)
{
  for (auto &pair : pairs)
    {
      // Contacts have tangential rows if they have friction. Its bound is not used here.
      pair.parameters.law            = contact::Law::contact;
      pair.parameters.gap            = "0";
      pair.parameters.friction       = contact::Friction::Tresca;
      pair.parameters.friction_bound = "1";
    }
  if (!pairs.empty())
    contact = std::make_unique<contact::Contact<dim>>(surface, pairs, degree, positions, held);
}

template <int dim>
void Ties<dim>::pair(const Field &positions, const faces::HeldDirections<dim> &held)
{
  if (contact)
    contact->pair(positions, held);
}

/// Return normal rows and tangential rows as one list, without gaps and without the tangential rows
/// along directions that supports hold on both sides.
template <int dim>
std::vector<contact::Row<dim>>
Ties<dim>::joined(std::vector<contact::Row<dim>>        rows,
                  const std::vector<contact::Row<dim>> &tangents) const
{
  for (unsigned int i = 0; i < tangents.size(); ++i)
    if (!contact->tangents()[i].is_held)
      rows.push_back(tangents[i]);
  for (auto &row : rows)
    row.gap = 0.;
  return rows;
}

template <int dim>
std::vector<contact::Row<dim>> Ties<dim>::rows(const Field &positions) const
{
  if (!contact)
    return {};
  const auto normal = contact->rows(positions);
  return joined(normal, contact->tangent_rows(positions, normal));
}

template <int dim>
std::vector<contact::Row<dim>> Ties<dim>::row_derivatives(const Field &positions,
                                                          const Field &velocity) const
{
  if (!contact)
    return {};
  const auto derivatives = contact->row_derivatives(positions, velocity);
  return joined(derivatives,
                contact->tangent_row_derivatives(positions, velocity, contact->rows(positions),
                                                 derivatives));
}

template <int dim>
typename Ties<dim>::Field Ties<dim>::energy_gradient(const Field               &positions,
                                                     const Field               &displacement,
                                                     const std::vector<double> &forces) const
{
  if (!contact)
    return Field(positions.size());
  const unsigned int  n = contact->n_rows();
  std::vector<double> of_all(forces.begin(), forces.begin() + n);
  auto                next = forces.begin() + n;
  for (const auto &tangent : contact->tangents())
    of_all.push_back(tangent.is_held ? 0. : *next++);
  return contact->coefficient_gradient(positions, displacement,
                                       contact->forces(contact->rows(positions), of_all));
}

template class Ties<2>;
template class Ties<3>;
} // namespace snug::state
