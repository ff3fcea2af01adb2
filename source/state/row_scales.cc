#include <snug/base/narrow.h>
#include <snug/state/gluing_rows.h>

#include <algorithm>
#include <cmath>

namespace snug::state {
template <int dim>
dealii::Tensor<1, dim>
GluingRows<dim>::projected(unsigned int                                       surface_node,
                           const dealii::Tensor<1, dim>                      &coefficient,
                           const std::vector<supports::ConstraintFrame<dim>> &frames) const
{
  dealii::Tensor<1, dim> result = coefficient;
  if (held_of_surface[surface_node] < frames.size())
    // The q are orthonormal, so successive projections are the projection off all of them.
    for (const auto &q : frames[held_of_surface[surface_node]].directions)
      result -= (result * q) * q;
  return result;
}

template <int dim>
double GluingRows<dim>::gap(const unsigned int          i,
                            const RowCoefficients<dim> &now,
                            const unsigned int          load_case) const
{
  double gap = now.row(i).gap;
  for (const auto &c : now.row(i).coefficients)
    {
      const unsigned int h = held_of_surface[c.first];
      if (h == held.n_nodes())
        continue;
      const auto &frame = now.held[h];
      for (unsigned int k = 0; k < frame.directions.size(); ++k)
        // c . u = (projected c) . u + sum_k (c . q_k) (q_k . u), where q_k . u = s_k is known.
        gap -= (c.second * frame.directions[k]) * frame.values[k][load_case];
    }
  return gap;
}

/// Return whether displacements are prescribed along a tangential row in any load case.
template <int dim>
bool GluingRows<dim>::is_displaced(const unsigned int          i,
                                   const RowCoefficients<dim> &reference) const
{
  const auto n_load_cases =
    reference.held.empty() ? 0u : narrow<unsigned int>(reference.held[0].values[0].size());
  for (unsigned int load_case = 0; load_case < n_load_cases; ++load_case)
    if (gap(i, reference, load_case) != 0.)
      return true;
  return false;
}

/// Return the stiffness of a body near a node, E h^(dim - 2) times the thickness or the
/// circumference.
template <int dim>
double GluingRows<dim>::stiffness_at(const unsigned int surface_node, const double modulus) const
{
  const auto &x = surface.reference_positions();
  double      h = 1.;
  if (dim == 3)
    for (const auto &face : surface.faces())
      if (std::find(face.nodes.begin(), face.nodes.end(), surface_node) != face.nodes.end())
        h = (x[face.nodes.back()] - x[face.nodes.front()]).norm();
  return modulus * mesh.idealization().weight(x[surface_node]) * h;
}

/// Compute the scales. A coefficient c spread evenly over m copies has the square |c|^2 / m, so
/// scaled rows have unit length. Use the reference geometry only, so that nr does not depend on the
/// design. A row whose nodes are held in its direction has the scale 0. Tangential rows have the
/// scale of their normal row, so that the friction cone is circular in the multipliers.
template <int dim>
void GluingRows<dim>::scale_rows(const RowCoefficients<dim>          &reference,
                                 const std::vector<contact::Tangent> &tangents,
                                 const double                         modulus)
{
  // A row whose projection is round-off of a unit normal has vanished.
  const double vanishing = 1e-12;
  for (unsigned int i = 0; i < reference.n_rows(); ++i)
    {
      double square = 0.;
      for (const auto &c : reference.row(i).coefficients)
        square += projected(c.first, c.second, reference.held).norm_square() / copies[c.first];
      scales.push_back(square < vanishing ? 0. : std::sqrt(square));
    }
  for (unsigned int i = 0; i < tangents.size(); ++i)
    {
      const unsigned int row = narrow<unsigned int>(reference.contact.size()) + i;
      const bool counts = tangents[i].is_held ? is_displaced(row, reference) : scales[row] > 0.;
      scales[row]       = counts ? scales[tangents[i].row] : 0.;
      if (tangents[i].is_held && counts)
        held_tangents[row] =
          stiffness_at(reference.tangents[i].coefficients.front().first, modulus);
    }
}

#define SNUG_INSTANTIATE(dim)                                                                    \
  template dealii::Tensor<1, dim> GluingRows<dim>::projected(                                    \
    unsigned int, const dealii::Tensor<1, dim> &,                                                \
    const std::vector<supports::ConstraintFrame<dim>> &) const;                                  \
  template double GluingRows<dim>::gap(unsigned int, const RowCoefficients<dim> &, unsigned int) \
    const;                                                                                       \
  template void GluingRows<dim>::scale_rows(const RowCoefficients<dim> &,                        \
                                            const std::vector<contact::Tangent> &, double);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::state
