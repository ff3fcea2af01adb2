#include <snug/state/ties.h>

#include <algorithm>

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
  return contact->coefficient_gradient(positions, displacement,
                                       contact->forces(contact->rows(positions),
                                                       with_held(forces)));
}

/// Return the forces with zeros at the tangential rows that rows() leaves out.
template <int dim>
std::vector<double> Ties<dim>::with_held(const std::vector<double> &forces) const
{
  auto                next = forces.begin() + contact->n_rows();
  std::vector<double> result(forces.begin(), next);
  for (const auto &tangent : contact->tangents())
    result.push_back(tangent.is_held ? 0. : *next++);
  return result;
}

template <int dim>
std::vector<dealii::Tensor<1, dim>> Ties<dim>::tractions(const Field               &positions,
                                                         const std::vector<double> &forces) const
{
  std::vector<dealii::Tensor<1, dim>> result;
  if (!contact)
    return result;
  const auto   rows    = contact->rows(positions);
  const auto   of_rows = contact->forces(rows, with_held(forces));
  const auto   areas   = contact->areas(positions);
  const double largest = *std::max_element(areas.begin(), areas.end());
  for (unsigned int i = 0; i < rows.size(); ++i)
    {
      auto force = of_rows.normal[i] * rows[i].normal;
      if (!of_rows.tangential.empty())
        force += of_rows.tangential[i];
      // The area may be round-off, as on the axis with degree 2.
      result.push_back(areas[i] > 1e-10 * largest ? -1. / areas[i] * force
                                                  : dealii::Tensor<1, dim>());
    }
  return result;
}

/// Leave out the couples of tangential rows that are held, because both sides may turn there.
template <int dim>
typename Ties<dim>::Parting Ties<dim>::parting(const Field &positions,
                                               const Field &displacement) const
{
  Parting result;
  if (!contact)
    return result;
  const auto rows    = contact->rows(positions);
  const auto along   = contact->tangent_directions(rows);
  const auto compare = [&](const unsigned int row, const double distance) {
    if (std::abs(distance) > result.distance)
      result = {std::abs(distance), contact->pairs()[contact->places()[row].pair].name()};
  };
  std::vector<dealii::Tensor<1, dim>> moved(rows.size()); // the slave relative to the master
  for (unsigned int i = 0; i < rows.size(); ++i)
    {
      for (const auto &[node, c] : rows[i].coefficients)
        moved[i] += (c * rows[i].normal) * displacement[node];
      compare(i, moved[i] * rows[i].normal);
    }
  for (unsigned int i = 0; i < along.size(); ++i)
    if (const auto &tangent = contact->tangents()[i]; tangent.is_held)
      compare(tangent.row, moved[tangent.row] * along[i]);
  return result;
}

template class Ties<2>;
template class Ties<3>;
} // namespace snug::state
