#include <snug/base/errors.h>
#include <snug/contact/contact.h>
#include <snug/contact/mortar_rows.h>
#include <snug/contact/pair_rows.h>
#include <snug/faces/nodal_normals.h>

#include <algorithm>
#include <map>

namespace snug::contact {
namespace {
/// A side is finer if its faces are smaller by more than this part:
/// equal meshes must be decided neither by round-off nor by a curvature
/// that makes one side a few percent longer.
const double finer_by = 0.1;

/// Times, by size and by modulus together, that faces of mortar pairs are alike. Of sides that are
/// more different the coarser one is the slave: its master must be able to follow its multipliers.
/// Pressures of rings with 60 and 72 cells, the finer stiffer by 200, scatter by 90 % if it is the
/// slave, and of equal moduli by 0.4 %, where a contact of few faces is better off with more nodes.
const double alike = 1.5;

/// Part of the slave faces' size over which gap formulas are
/// differentiated by differences.
const double gap_step = 1. / 25.;

/// Whether the master of a mortar pair is too coarse for its slave, by the size of its faces over
/// that of the slave's and the ratio of their moduli, the stiffer over the softer.
bool asks_too_much(const double size, const double contrast)
{
  return size > 1. / (1. - finer_by) && size * contrast > alike;
}

/// Of obstacles, the master side is empty.
template <int dim>
PairFaces sides_of(const mesh::Surface<dim> &surface, const Pair &pair)
{
  return {faces_of(surface, pair.slave),
          pair.obstacle ? std::vector<unsigned int>() : faces_of(surface, pair.master)};
}

/// Size of the master's faces over that of the slave's.
template <int dim>
double relative_size(const mesh::Surface<dim>                 &surface,
                     const typename mesh::Surface<dim>::Field &positions,
                     const Pair                               &pair)
{
  const auto size = [&](const Side &side) {
    return mean_face_size(surface, faces_of(surface, side), positions);
  };
  return size(pair.master) / size(pair.slave);
}

/// Value of a field at the slave of a row less that at its master, if
/// it has nodes, by the factors of the normal in the coefficients.
/// Coefficients are c n, so their product with n gives c back: 1 at the slave, -w_k at the master,
/// or those of a mortar row. A row against an obstacle has no master nodes and gives the slave's.
template <int dim>
dealii::Tensor<1, dim> slave_minus_master(const Row<dim>                           &row,
                                          const typename mesh::Surface<dim>::Field &field)
{
  dealii::Tensor<1, dim> sum;
  for (const auto &c : row.coefficients)
    // (c n . n) u = c u
    sum += (c.second * row.normal) * field[c.first];
  return sum;
}

/// Length of @p v at right angles to @p normal.
/// [length]; what the row does not resist, as contact is without friction.
template <int dim>
double along(const dealii::Tensor<1, dim> &v, const dealii::Tensor<1, dim> &normal)
{
  return (v - (v * normal) * normal).norm();
}
} // namespace

template <int dim>
Contact<dim>::Contact(const mesh::Surface<dim>         &surface,
                      const std::vector<Pair>          &pairs,
                      unsigned int                      degree,
                      const Field                      &positions,
                      const faces::HeldDirections<dim> &held)
  : surface(surface), shape(degree), joined(join_pairs(surface, shape, pairs, positions))
{
  choose_slaves(positions, held);
  named.resize(pairs.size());
  for (const JoinedPair &of : joined)
    for (const auto &part : of.parts)
      {
        const Pair &pair = pairs[part.pair];
        named[part.pair] = {pair.slave_name, pair.master_name, pair.obstacle, {}};
        if (!pair.slave.has(part.slave))
          std::swap(named[part.pair].slave_name, named[part.pair].master_name);
      }
  make_groups(positions, held);
  // Of the pairs of one boundary of each side that a list of boundaries stands for, some may be
  // too far apart to touch.
  for (unsigned int p = joined.size(); p-- > 0;)
    if (groups[p].rows->slaves().empty())
      {
        joined.erase(joined.begin() + p);
        chosen.erase(chosen.begin() + p);
        matching_of.erase(matching_of.begin() + p);
        groups.erase(groups.begin() + p);
      }
  number_rows(positions, held);
}

/// Choose the slaves and the methods of the joined pairs. The choices are made once: a design that
/// changes which side is finer must not exchange the sides, or the kind of the rows, when contact
/// is paired anew.
template <int dim>
void Contact<dim>::choose_slaves(const Field &positions, const faces::HeldDirections<dim> &held)
{
  // Whether the sides of a pair of the scene are exchanged: in all joined pairs that it is part of,
  // as its force is that on one side.
  std::map<unsigned int, bool> exchanged;
  for (JoinedPair &of : joined)
    {
      Pair      &pair         = of.pair;
      bool       is_exchanged = false;
      const auto known    = std::find_if(of.parts.begin(), of.parts.end(), [&](const auto &part) {
        return exchanged.count(part.pair) > 0;
      });
      const auto exchange = [&]() {
        of.exchange_sides();
        is_exchanged = !is_exchanged;
      };
      if (known != of.parts.end() && exchanged[known->pair])
        exchange();
      const bool may_exchange =
        pair.parameters.slave == Slave::finer && !pair.obstacle && known == of.parts.end();
      if (may_exchange && relative_size(surface, positions, pair) < 1. - finer_by)
        exchange();
      matching_of.emplace_back();
      chosen.push_back(pair);
      if (!pair.obstacle)
        matching_of.back() = matching<dim>(geometry(chosen.size() - 1, positions, held));
      if (!pair.parameters.method)
        pair.parameters.method = matching_of.back().complete() ? Method::nodal : Method::mortar;
      if (may_exchange && pair.parameters.method == Method::mortar &&
          asks_too_much(relative_size(surface, positions, pair), pair.contrast))
        exchange();
      if (!pair.obstacle)
        matching_of.back().finer = relative_size(surface, positions, pair);
      pair.parameters.slave = Slave::first;
      chosen.back()         = pair;
      for (const auto &part : of.parts)
        exchanged[part.pair] = is_exchanged;
    }
}

template <int dim>
PairGeometry<dim> Contact<dim>::geometry(const unsigned int                p,
                                         const Field                      &positions,
                                         const faces::HeldDirections<dim> &held,
                                         std::vector<bool>                 taken) const
{
  taken.resize(surface.n_nodes(), false);
  return {surface,   shape, chosen[p],       sides_of(surface, chosen[p]),
          positions, held,  std::move(taken)};
}

template <int dim>
void Contact<dim>::pair(const Field &positions, const faces::HeldDirections<dim> &held)
{
  make_groups(positions, held);
  number_rows(positions, held);
}

template <int dim>
void Contact<dim>::number_rows(const Field &positions, const faces::HeldDirections<dim> &held)
{
  row_places.clear();
  for (unsigned int p = 0; p < groups.size(); ++p)
    for (const unsigned int slave : groups[p].rows->slaves())
      // The number of a row is its place here, over all groups.
      row_places.push_back({p, slave});
  share_rows(positions, held);
  check_named_pairs();
  collect_shared_nodes();
  measure_pairing(positions);
}

template <int dim>
void Contact<dim>::make_groups(const Field &positions, const faces::HeldDirections<dim> &held)
{
  AssertDimension(held.size(), surface.n_nodes());
  groups.clear();
  for (unsigned int p = 0; p < chosen.size(); ++p)
    groups.push_back(make_group(geometry(p, positions, held)));
  auto taken = contested_nodes(positions);
  for (unsigned int p = 0; p < chosen.size(); ++p)
    if (!taken[p].empty())
      groups[p] = make_group(geometry(p, positions, held, std::move(taken[p])));
}

/// Slave nodes of each group that have a row against the same surface in another group, whose side
/// faces it better: two such rows would be nearly equal and W = B D^-1 B' singular. Empty: none.
template <int dim>
std::vector<std::vector<bool>> Contact<dim>::contested_nodes(const Field &positions) const
{
  struct Row
  {
    unsigned int group;
    double       cosine; ///< between the normals of the group's side and of the row
  };
  std::map<std::pair<std::string, Boundary>, std::vector<unsigned int>> groups_of; // a surface
  for (unsigned int p = 0; p < groups.size(); ++p)
    groups_of[{chosen[p].obstacle ? chosen[p].obstacle->name : "", joined[p].master_surface}]
      .push_back(p);
  std::vector<std::vector<bool>> taken(groups.size());
  for (const auto &[against, of_surface] : groups_of)
    {
      if (of_surface.size() == 1)
        continue;
      std::map<unsigned int, std::vector<Row>> at_node;
      for (const unsigned int p : of_surface)
        {
          const auto                    &slaves = groups[p].rows->slaves();
          const auto                     faces  = faces_of(surface, chosen[p].slave);
          const faces::NodalNormals<dim> normals(surface, faces, shape, positions);
          const auto                     rows = groups[p].rows->rows(positions);
          for (unsigned int i = 0; i < slaves.size(); ++i)
            at_node[slaves[i]].push_back({p, normals.normals()[slaves[i]] * rows[i].normal});
        }
      for (const auto &[node, rows] : at_node)
        {
          auto best = rows.front();
          for (const Row &row : rows)
            if (row.cosine > best.cosine + 1e-9) // of equal ones the first
              best = row;
          for (const Row &row : rows)
            if (row.group != best.group)
              {
                taken[row.group].resize(surface.n_nodes(), false);
                taken[row.group][node] = true;
              }
        }
    }
  return taken;
}

template <int dim>
void Contact<dim>::share_rows(const Field &positions, const faces::HeldDirections<dim> &held)
{
  for (NamedPair &pair : named)
    pair.rows.clear();
  unsigned int row = 0;
  for (unsigned int p = 0; p < groups.size(); ++p)
    for (const PairShares &shares :
         row_shares(joined[p], geometry(p, positions, held), *groups[p].rows))
      {
        double largest = 0.;
        for (const auto &[pair, share] : shares)
          {
            named[pair].rows.emplace_back(row, share);
            if (share > largest)
              {
                largest               = share;
                row_places[row].named = pair;
              }
          }
        ++row;
      }
}

/// Replicated data: the same answer, and the same error, on all ranks.
template <int dim>
void Contact<dim>::check_named_pairs() const
{
  std::vector<bool> has_rows(named.size(), false);
  for (unsigned int p = 0; p < groups.size(); ++p)
    if (!groups[p].rows->slaves().empty())
      for (const auto &part : joined[p].parts)
        has_rows[part.pair] = true;
  for (unsigned int pair = 0; pair < named.size(); ++pair)
    if (!has_rows[pair])
      throw InputError(
        "contact pair '" + named[pair].name() +
        "': no slave node lies opposite to the master within the search distance and angle");
}

/// Groups number their own rows; rows of Contact count through all groups.
template <int dim>
void Contact<dim>::collect_shared_nodes()
{
  shared.clear();
  unsigned int first = 0;
  for (const Group &group : groups)
    {
      for (SharedNode &node : group.rows->shared_nodes())
        {
          for (auto &row : node.rows)
            row.first += first;
          shared.push_back(std::move(node));
        }
      first += group.rows->slaves().size();
    }
}

template <int dim>
void Contact<dim>::measure_pairing(const Field &positions)
{
  const auto paired = rows(positions);
  const auto sizes  = node_face_sizes(surface, positions);
  paired_offsets.clear();
  gaps.assign(groups.size(), {});
  for (unsigned int i = 0; i < paired.size(); ++i)
    {
      const auto &[p, slave, of] = row_places[i];
      paired_offsets.push_back(slave_minus_master(paired[i], positions));
      double gap = paired[i].gap;
      // An obstacle that moves into a body is a load, not a body at the wrong place.
      if (chosen[p].obstacle)
        {
          const dealii::Tensor<1, dim> motion = to_point<dim>(chosen[p].obstacle->displacement);
          gap -= paired[i].normal * motion;
        }
      gaps[p].least   = std::min(gaps[p].least, gap);
      gaps[p].largest = std::max(gaps[p].largest, gap);
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
  if (parameters.gap != "0")
    group.offset = std::make_unique<geometry::Formula<dim>>("Gap", parameters.gap);
  return group;
}

template <int dim>
std::vector<Row<dim>> Contact<dim>::rows(const Field &positions) const
{
  AssertDimension(positions.size(), surface.n_points());
  std::vector<Row<dim>> result;
  for (const Group &group : groups)
    for (Row<dim> &row : group.rows->rows(positions))
      {
        const unsigned int slave = row_places[result.size()].slave;
        if (group.offset)
          // At the slave's position in the design, so that the formula belongs to places, not to
          // the material.
          row.gap += group.offset->value(dealii::Point<dim>(positions[slave]));
        result.push_back(std::move(row));
      }
  return result;
}

template <int dim>
std::vector<Row<dim>> Contact<dim>::row_derivatives(const Field &positions,
                                                    const Field &velocity) const
{
  AssertDimension(positions.size(), surface.n_points());
  AssertDimension(velocity.size(), surface.n_points());
  std::vector<Row<dim>> result;
  for (const Group &group : groups)
    for (Row<dim> &row : group.rows->row_derivatives(positions, velocity))
      {
        const unsigned int slave = row_places[result.size()].slave;
        if (group.offset)
          // d/dt g(x_s(t)) = grad g . V_s
          row.gap += group.offset->gradient(dealii::Point<dim>(positions[slave]), group.step) *
                     velocity[slave];
        result.push_back(std::move(row));
      }
  return result;
}

template <int dim>
typename Contact<dim>::Field Contact<dim>::energy_gradient(const Field               &positions,
                                                           const Field               &displacement,
                                                           const std::vector<double> &forces) const
{
  AssertDimension(positions.size(), surface.n_points());
  AssertDimension(displacement.size(), surface.n_nodes());
  AssertDimension(forces.size(), n_rows());
  Field gradient(surface.n_points());
  auto  first = forces.begin();
  for (const Group &group : groups)
    {
      const auto               &slaves = group.rows->slaves();
      const std::vector<double> of_group(first, first + slaves.size());
      first += slaves.size();
      group.rows->add_energy_gradient(positions, displacement, of_group, gradient);
      if (group.offset)
        for (unsigned int i = 0; i < slaves.size(); ++i)
          // The energy gradient is that of sum_i force_i (sum_b c_b . u_b - gap_i): hence the
          // minus.
          gradient[slaves[i]] -=
            of_group[i] *
            group.offset->gradient(dealii::Point<dim>(positions[slaves[i]]), group.step);
    }
  return gradient;
}

template <int dim>
std::vector<double> Contact<dim>::areas(const Field &positions) const
{
  AssertDimension(positions.size(), surface.n_points());
  std::vector<double> result;
  for (const Group &group : groups)
    {
      const auto of_group = group.rows->areas(positions);
      result.insert(result.end(), of_group.begin(), of_group.end());
    }
  return result;
}

template <int dim>
typename Contact<dim>::Field Contact<dim>::area_gradient(const Field               &positions,
                                                         const std::vector<double> &factors) const
{
  AssertDimension(positions.size(), surface.n_points());
  AssertDimension(factors.size(), n_rows());
  Field gradient(surface.n_points());
  auto  first = factors.begin();
  for (const Group &group : groups)
    {
      const auto last = first + group.rows->slaves().size();
      group.rows->add_area_gradient(positions, {first, last}, gradient);
      first = last;
    }
  return gradient;
}

template <int dim>
std::unique_ptr<PointGaps<dim>>
Contact<dim>::point_gaps(const unsigned int                p,
                         const Field                      &positions,
                         const faces::HeldDirections<dim> &held) const
{
  return std::make_unique<PointGaps<dim>>(geometry(p, positions, held));
}

template <int dim>
std::vector<double> Contact<dim>::slips(const Field                 &positions,
                                        const std::vector<Row<dim>> &rows,
                                        const Field                 &displacement) const
{
  const auto          sizes = node_face_sizes(surface, positions);
  std::vector<double> result;
  for (unsigned int i = 0; i < rows.size(); ++i)
    result.push_back(along(slave_minus_master(rows[i], displacement), rows[i].normal) /
                     sizes[row_places[i].slave]);
  return result;
}

template <int dim>
std::vector<double> Contact<dim>::drifts(const Field                 &positions,
                                         const std::vector<Row<dim>> &rows) const
{
  const auto          sizes = node_face_sizes(surface, positions);
  std::vector<double> result;
  for (unsigned int i = 0; i < rows.size(); ++i)
    {
      const auto offset             = slave_minus_master(rows[i], positions);
      const auto &[pair, slave, of] = row_places[i];
      const auto &off_face          = rows[i].off_face;
      // Where the foot follows the offset is along the normal, but for coordinates that are fixed.
      const auto moved = off_face ? offset : offset - paired_offsets[i];
      // The closest point on an obstacle follows the node, so it cannot drift off.
      result.push_back(chosen[pair].obstacle
                         ? 0.
                         : along(moved, rows[i].normal) / sizes[slave] + off_face.value_or(0.));
    }
  return result;
}

template class Contact<2>;
template class Contact<3>;
} // namespace snug::contact
