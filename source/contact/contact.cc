#include <snug/base/assertions.h>
#include <snug/contact/contact.h>
#include <snug/contact/mortar_rows.h>
#include <snug/contact/pair_rows.h>

#include <algorithm>

namespace snug::contact {
namespace {
/// Step of the difference quotients of gap formulas, as a fraction of the size of the slave faces.
const double gap_step = 1. / 25.;

/// Return the length of the part of @p v at right angles to @p normal [length]. Normal rows do not
/// resist this part.
template <int dim>
double along(const dealii::Tensor<1, dim> &v, const dealii::Tensor<1, dim> &normal)
{
  return (v - (v * normal) * normal).norm();
}
} // namespace

/// Return the value of the field @p in_space at the slave of a row minus the value at its master,
/// if the row has master nodes. Coefficients are c n, so their product with n is the factor c: 1 at
/// the slave and -w_k at the master, or the factors of a mortar row. A row against an obstacle has
/// no master nodes, so its result is the value at the slave.
template <int dim>
dealii::Tensor<1, dim> Contact<dim>::slave_minus_master(const Row<dim> &row,
                                                        const Field    &in_space) const
{
  dealii::Tensor<1, dim> sum;
  for (const auto &[node, coefficient] : row.coefficients)
    // (c n . n) u = c u
    sum += (placed.turned(node, coefficient) * row.normal) * in_space[node];
  return sum;
}

/// Shift the row indices: groups number their own rows, but rows of Contact count through all
/// groups.
template <int dim>
void Contact<dim>::collect_dependent_multipliers()
{
  shared.clear();
  unsigned int first = 0;
  for (const Group &group : groups)
    {
      for (DependentMultiplier &node : group.rows->dependent_multipliers())
        {
          for (auto &row : node.rows)
            row.first += first;
          shared.push_back(std::move(node));
        }
      first += group.rows->slaves().size();
    }
}

template <int dim>
void Contact<dim>::measure_pairing(const Field &positions, const std::vector<Row<dim>> &paired)
{
  const auto sizes    = node_face_sizes(surface, positions);
  const auto in_space = placed.to_space(positions);
  paired_rows.assign(paired.size(), {});
  row_nodes.assign(paired.size(), {});
  paired_offsets.clear();
  gaps.assign(groups.size(), {});
  for (unsigned int i = 0; i < paired.size(); ++i)
    {
      const auto &[p, slave, of] = row_places[i];
      paired_offsets.push_back(slave_minus_master(paired[i], in_space));
      for (const auto &coefficient : paired[i].coefficients)
        row_nodes[i].push_back(coefficient.first);
      if (!chosen[p].obstacle && chosen[p].parameters.method == Method::mortar)
        paired_rows[i] = paired[i];
      double gap = paired[i].gap;
      // An obstacle that moves into a body is a load, not a misplaced body.
      if (chosen[p].obstacle)
        {
          const auto &obstacle = *chosen[p].obstacle;
          gap -= paired[i].normal *
                 position.of_obstacle(obstacle.name).vector(to_point<dim>(obstacle.displacement));
        }
      gaps[p].least   = std::min(gaps[p].least, gap);
      gaps[p].largest = std::max(gaps[p].largest, gap);
      if (!named[of].parameters.interference)
        gaps[p].overlap = std::max(gaps[p].overlap, -gap / sizes[slave]);
    }
}

template <int dim>
typename Contact<dim>::Group Contact<dim>::make_group(const PairGeometry<dim> &geometry) const
{
  const PairParameters &parameters = geometry.pair.parameters;
  Group                 group;
  if (geometry.pair.obstacle)
    group.rows = obstacle_rows(geometry);
  else if (parameters.method == Method::nodal)
    group.rows = nodal_rows(geometry);
  else
    group.rows = std::make_unique<MortarRows<dim>>(geometry);
  group.step = gap_step * geometry.slave_size();
  return group;
}

/// Return the sum of the gap formulas of the pairs of row @p i. They are evaluated at the slave's
/// position in the design, because they belong to places, not to the material. They move with the
/// slave's body.
template <int dim>
double Contact<dim>::gap_offset(const unsigned int i, const Field &positions) const
{
  const dealii::Point<dim> at(positions[row_places[i].slave]);
  double                   sum = 0.;
  for (const auto &[named, share] : gap_shares[i])
    sum += share * gap_formulas[named]->value(at);
  return sum;
}

template <int dim>
dealii::Tensor<1, dim> Contact<dim>::gap_offset_gradient(const unsigned int i,
                                                         const Field       &positions) const
{
  const dealii::Point<dim> at(positions[row_places[i].slave]);
  const double             step = groups[row_places[i].pair].step;
  dealii::Tensor<1, dim>   sum;
  for (const auto &[named, share] : gap_shares[i])
    sum += share * gap_formulas[named]->gradient(at, step);
  return sum;
}

template <int dim>
std::vector<Row<dim>> Contact<dim>::rows(const Field &positions) const
{
  SNUG_ASSERT_EQUAL(positions.size(), surface.n_points());
  const auto            in_space = placed.to_space(positions);
  std::vector<Row<dim>> result;
  for (const Group &group : groups)
    for (Row<dim> &row : group.rows->rows(in_space))
      {
        row.gap += gap_offset(result.size(), positions);
        result.push_back(std::move(row));
      }
  return placed.turned_back(std::move(result));
}

template <int dim>
std::vector<Row<dim>> Contact<dim>::row_derivatives(const Field &positions,
                                                    const Field &velocity) const
{
  SNUG_ASSERT_EQUAL(positions.size(), surface.n_points());
  SNUG_ASSERT_EQUAL(velocity.size(), surface.n_points());
  const auto            in_space = placed.to_space(positions), motion = placed.turned(velocity);
  std::vector<Row<dim>> result;
  for (const Group &group : groups)
    for (Row<dim> &row : group.rows->row_derivatives(in_space, motion))
      {
        // d/dt g(x_s(t)) = grad g . V_s
        const unsigned int i = result.size();
        row.gap += gap_offset_gradient(i, positions) * velocity[row_places[i].slave];
        result.push_back(std::move(row));
      }
  return placed.turned_back(std::move(result));
}

/// Return the derivatives of sum_i force_i (sum_b c_ib . u_b - gap_i) with respect to the rows.
template <int dim>
std::vector<RowSlopes<dim>> Contact<dim>::energy_slopes(const Field               &moved,
                                                        const std::vector<double> &forces) const
{
  std::vector<RowSlopes<dim>> slopes(forces.size());
  for (unsigned int i = 0; i < forces.size(); ++i)
    if (forces[i] != 0.)
      {
        slopes[i].gap = -forces[i];
        for (const unsigned int node : row_nodes[i])
          slopes[i].coefficients.push_back(forces[i] * moved[node]);
      }
  return slopes;
}

template <int dim>
typename Contact<dim>::Field Contact<dim>::energy_gradient(const Field              &positions,
                                                           const Field              &displacement,
                                                           const ContactForces<dim> &forces) const
{
  SNUG_ASSERT_EQUAL(positions.size(), surface.n_points());
  SNUG_ASSERT_EQUAL(displacement.size(), surface.n_nodes());
  SNUG_ASSERT_EQUAL(forces.normal.size(), n_rows());
  const auto in_space = placed.to_space(positions), moved = placed.turned(displacement);
  Field      gradient(surface.n_points()), of_offsets     = gradient;
  auto       slopes = energy_slopes(moved, forces.normal);
  if (!forces.tangential.empty())
    add_tangential_slopes(positions, moved, forces.tangential, slopes, gradient);
  auto first = slopes.cbegin();
  for (const Group &group : groups)
    {
      const auto                       &slaves = group.rows->slaves();
      const std::vector<RowSlopes<dim>> of_group(first, first + slaves.size());
      first += slaves.size();
      group.rows->add_gradient(in_space, of_group, gradient);
    }
  for (unsigned int i = 0; i < slopes.size(); ++i)
    of_offsets[row_places[i].slave] += slopes[i].gap * gap_offset_gradient(i, positions);
  gradient = placed.turned_back(std::move(gradient));
  for (unsigned int point = 0; point < gradient.size(); ++point)
    gradient[point] += of_offsets[point];
  return gradient;
}

/// Subtract the energy gradient of a body at rest, because the energy is linear in the
/// displacement.
template <int dim>
typename Contact<dim>::Field
Contact<dim>::coefficient_gradient(const Field              &positions,
                                   const Field              &displacement,
                                   const ContactForces<dim> &forces) const
{
  auto       gradient = energy_gradient(positions, displacement, forces);
  const auto of_gaps  = energy_gradient(positions, Field(surface.n_nodes()), forces);
  for (unsigned int point = 0; point < gradient.size(); ++point)
    gradient[point] -= of_gaps[point];
  return gradient;
}

template <int dim>
std::vector<double> Contact<dim>::areas(const Field &positions) const
{
  SNUG_ASSERT_EQUAL(positions.size(), surface.n_points());
  const auto          in_space = placed.to_space(positions);
  std::vector<double> result;
  for (const Group &group : groups)
    {
      const auto of_group = group.rows->areas(in_space);
      result.insert(result.end(), of_group.begin(), of_group.end());
    }
  return result;
}

template <int dim>
std::vector<double> Contact<dim>::area_derivatives(const Field &positions,
                                                   const Field &velocity) const
{
  const auto          in_space = placed.to_space(positions), motion = placed.turned(velocity);
  std::vector<double> result;
  for (const Group &group : groups)
    {
      const auto of_group = group.rows->area_derivatives(in_space, motion);
      result.insert(result.end(), of_group.begin(), of_group.end());
    }
  return result;
}

template <int dim>
typename Contact<dim>::Field Contact<dim>::area_gradient(const Field               &positions,
                                                         const std::vector<double> &factors) const
{
  SNUG_ASSERT_EQUAL(positions.size(), surface.n_points());
  SNUG_ASSERT_EQUAL(factors.size(), n_rows());
  const auto in_space = placed.to_space(positions);
  Field      gradient(surface.n_points());
  auto       first = factors.begin();
  for (const Group &group : groups)
    {
      const auto last = first + group.rows->slaves().size();
      group.rows->add_area_gradient(in_space, {first, last}, gradient);
      first = last;
    }
  return placed.turned_back(std::move(gradient));
}

template <int dim>
std::unique_ptr<PointGaps<dim>>
Contact<dim>::point_gaps(const unsigned int                p,
                         const Field                      &positions,
                         const faces::HeldDirections<dim> &held) const
{
  return std::make_unique<PointGaps<dim>>(geometry(p, positions, held), joined[p], gap_formulas);
}

template <int dim>
std::vector<double> Contact<dim>::tangential_slips(const Field                 &positions,
                                                   const std::vector<Row<dim>> &rows,
                                                   const Field                 &displacement) const
{
  const auto          sizes = node_face_sizes(surface, positions);
  const auto          moved = placed.turned(displacement);
  std::vector<double> result;
  for (unsigned int i = 0; i < rows.size(); ++i)
    result.push_back(along(slave_minus_master(rows[i], moved), rows[i].normal) /
                     sizes[row_places[i].slave]);
  return result;
}

template <int dim>
std::vector<double> Contact<dim>::pairing_drifts(const Field                 &positions,
                                                 const std::vector<Row<dim>> &rows) const
{
  const auto          sizes    = node_face_sizes(surface, positions);
  const auto          in_space = placed.to_space(positions);
  std::vector<double> result;
  for (unsigned int i = 0; i < rows.size(); ++i)
    {
      // Mortar rows follow the positions, so their own offset is always that of opposite points.
      const bool is_mortar = !paired_rows[i].coefficients.empty();
      const auto offset    = slave_minus_master(is_mortar ? paired_rows[i] : rows[i], in_space);
      const auto &[pair, slave, of] = row_places[i];
      const auto &off_face          = rows[i].off_face;
      // Where the foot point follows the node, the offset is along the normal, except for fixed
      // coordinates.
      const auto moved = off_face ? offset : offset - paired_offsets[i];
      // The closest point on an obstacle follows the node, so the node cannot drift off this point.
      result.push_back(chosen[pair].obstacle
                         ? 0.
                         : along(moved, rows[i].normal) / sizes[slave] + off_face.value_or(0.));
    }
  return result;
}

template class Contact<2>;
template class Contact<3>;
} // namespace snug::contact
