#include <snug/base/narrow.h>
#include <snug/state/gluing_rows.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace snug::state {
template <int dim>
dealii::Tensor<1, dim>
GluingRows<dim>::projected(unsigned int                           surface_node,
                           const dealii::Tensor<1, dim>          &coefficient,
                           const supports::ConstraintFrames<dim> &frames) const
{
  dealii::Tensor<1, dim> result = coefficient;
  if (held_of_surface[surface_node] < frames.size())
    // The q are orthonormal, so successive projections are the projection off all of them.
    for (const auto &q : frames.directions(held_of_surface[surface_node]))
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
      const auto directions = now.held.directions(h);
      for (unsigned int k = 0; k < directions.size(); ++k)
        // c . u = (projected c) . u + sum_k (c . q_k) (q_k . u), where q_k . u = s_k is known.
        gap -= (c.second * directions[k]) * now.held.value(h, k, load_case);
    }
  return gap;
}

/// Return whether displacements are prescribed along a tangential row in any load case.
template <int dim>
bool GluingRows<dim>::is_displaced(const unsigned int          i,
                                   const RowCoefficients<dim> &reference) const
{
  const auto n_load_cases = reference.held.size() == 0 ? 0u : reference.held.n_load_cases();
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

/// Set the scales of tied rows that depend on the rows before them to 0, as where several tied
/// pairs meet. In the factorization L L' of the Gram matrix of unit rows, without pivoting, the
/// square of the diagonal entry is the squared distance of the row from the rows before it.
template <int dim>
void GluingRows<dim>::drop_dependent_ties(const RowCoefficients<dim> &reference)
{
  const double dependent = 1e-8;                                            // squared distance
  using Part             = std::pair<unsigned int, dealii::Tensor<1, dim>>; // place of a row, c
  // Rows in the order of their first nodes have neighbours at small distances.
  std::vector<unsigned int> order;
  for (unsigned int i = n_bounded; i < reference.n_rows(); ++i)
    if (scales[i] > 0.)
      order.push_back(i);
  const auto first_node = [&](unsigned int i) {
    return reference.row(i).coefficients.front().first;
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](unsigned int i, unsigned int j) { return first_node(i) < first_node(j); });
  std::vector<std::vector<Part>>   rows_at(surface.n_nodes());
  std::vector<std::vector<double>> L(order.size()); // from the first column that is not zero
  for (unsigned int i = 0; i < order.size(); ++i)
    {
      std::map<unsigned int, double> gram;
      for (const auto &[node, coefficient] : reference.row(order[i]).coefficients)
        {
          const auto c = projected(node, coefficient, reference.held) / scales[order[i]];
          rows_at[node].emplace_back(i, c);
          for (const auto &[j, other] : rows_at[node])
            gram[j] += c * other / copies[node];
        }
      const unsigned int begin = gram.begin()->first;
      auto              &row   = L[i];
      row.assign(i + 1 - begin, 0.);
      for (const auto &[j, value] : gram)
        row[j - begin] = value;
      for (unsigned int j = begin; j <= i; ++j)
        {
          const unsigned int offset = j + 1 - narrow<unsigned int>(L[j].size());
          for (unsigned int k = std::max(begin, offset); k < j; ++k)
            row[j - begin] -= row[k - begin] * L[j][k - offset];
          if (j < i)
            row[j - begin] = L[j].back() > 0. ? row[j - begin] / L[j].back() : 0.;
        }
      row.back() = row.back() > dependent ? std::sqrt(row.back()) : 0.;
      if (row.back() == 0.)
        scales[order[i]] = 0.;
    }
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
  // Contacts whose nodes all follow reference points, at the edge of a rigid face, would depend on
  // the rows of these nodes.
  std::vector<bool> follows(surface.n_nodes(), false);
  for (const auto &row : reference.followers)
    follows[row.coefficients.front().first] = true;
  const auto is_rigid = [&](const contact::Row<dim> &row) {
    return std::all_of(row.coefficients.begin(), row.coefficients.end(),
                       [&](const auto &c) { return follows[c.first]; });
  };
  for (unsigned int i = 0; i < reference.n_rows(); ++i)
    {
      double square = 0.;
      for (const auto &c : reference.row(i).coefficients)
        square += projected(c.first, c.second, reference.held).norm_square() / copies[c.first];
      if (i < reference.contact.size() && is_rigid(reference.row(i)))
        square = 0.;
      scales.push_back(square < vanishing ? 0. : std::sqrt(square));
    }
  for (unsigned int i = 0; i < tangents.size(); ++i)
    {
      const unsigned int row = narrow<unsigned int>(reference.contact.size()) + i;
      const bool counts = tangents[i].is_held ? is_displaced(row, reference) : scales[row] > 0.;
      scales[row]       = counts ? scales[tangents[i].row] : 0.;
      if (tangents[i].is_held && scales[row] > 0.)
        held_tangents[row] =
          stiffness_at(reference.tangents[i].coefficients.front().first, modulus);
    }
  drop_dependent_ties(reference);
}

#define SNUG_INSTANTIATE(dim)                                                                     \
  template dealii::Tensor<1, dim> GluingRows<dim>::projected(                                     \
    unsigned int, const dealii::Tensor<1, dim> &, const supports::ConstraintFrames<dim> &) const; \
  template double GluingRows<dim>::gap(unsigned int, const RowCoefficients<dim> &, unsigned int)  \
    const;                                                                                        \
  template void GluingRows<dim>::scale_rows(const RowCoefficients<dim> &,                         \
                                            const std::vector<contact::Tangent> &, double);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::state
