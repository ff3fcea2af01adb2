#include <snug/base/assertions.h>
#include <snug/base/errors.h>
#include <snug/contact/contact.h>
#include <snug/contact/ends_inside.h>
#include <snug/faces/nodal_normals.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace snug::contact {
namespace {
/// A side is finer if its faces are smaller by more than this fraction. The choice between equal
/// meshes must not depend on round-off or on a curvature that makes one side a few percent longer.
const double finer_by = 0.1;

/// Maximum ratio, of sizes times moduli, of faces of mortar pairs that count as alike. Beyond this
/// ratio the coarser side is the slave, because its master must be able to follow its multipliers.
/// Measured on rings with 60 and 72 cells: pressures scatter by 90 % if the slave is the finer ring
/// and stiffer by a factor of 200, but by 0.4 % with equal moduli. With equal moduli, a contact of
/// few faces benefits from the greater number of nodes of the finer side.
const double alike = 1.5;

/// Maximum of the same ratio, with the modulus of the slave over that of the master, of a slave
/// that ends inside its master. Measured on a block on a wide one, edges of 1 and 2: the pressures
/// of the slave oscillate by 3 % at a ratio of 3, and by 15 to 31 % at ratios of 230 and 600.
const double alike_at_ends = 5.;

/// Return whether the master of a mortar pair is too coarse for its slave. @p size is the size of
/// the master's faces over that of the slave's, and @p modulus_ratio is the modulus of the slave's
/// body over that of the master's.
bool prefers_coarse_slave(const double size, const double modulus_ratio)
{
  return size > 1. / (1. - finer_by) && size * std::max(modulus_ratio, 1. / modulus_ratio) > alike;
}

/// Make the elastic side the slave of pairs with a rigid face. The rows of a rigid slave could
/// depend on each other, because a coarse master has fewer nodes.
void choose_elastic_slaves(std::vector<JoinedPair> &joined)
{
  for (JoinedPair &of : joined)
    if (const double ratio = of.pair.modulus_ratio; ratio == 0. || std::isinf(ratio))
      {
        if (std::isinf(ratio))
          of.swap_slave_master();
        of.pair.parameters.slave = Slave::first;
      }
}

/// Return the faces of both sides of a pair. The master side of an obstacle is empty.
template <int dim>
PairFaces sides_of(const mesh::Surface<dim> &surface, const Pair &pair)
{
  return {faces_of(surface, pair.slave),
          pair.obstacle ? std::vector<unsigned int>() : faces_of(surface, pair.master)};
}

/// Return the size of the master's faces over that of the slave's faces.
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
} // namespace

template <int dim>
Contact<dim>::Contact(const mesh::Surface<dim>         &surface,
                      const std::vector<Pair>          &pairs,
                      unsigned int                      degree,
                      const Field                      &positions,
                      const faces::HeldDirections<dim> &held,
                      const Position<dim>              &position)
  : placed(surface, position)
  , surface(placed.surface())
  , position(position)
  , shape(degree)
  , joined(join_pairs(this->surface, shape, pairs, placed.to_space(positions)))
{
  const auto x = placed.to_space(positions);
  const auto q = placed.turned(held);
  choose_slaves(x, q);
  named.resize(pairs.size());
  for (const JoinedPair &of : joined)
    for (const auto &part : of.parts)
      {
        const Pair &pair      = pairs[part.pair];
        const bool  exchanged = !pair.slave.has(part.slave);
        named[part.pair]      = {pair.slave,    pair.master, pair.slave_name, pair.master_name,
                                 pair.obstacle, {},          exchanged,       pair.parameters};
        if (exchanged)
          {
            std::swap(named[part.pair].slave_name, named[part.pair].master_name);
            std::swap(named[part.pair].slave, named[part.pair].master);
          }
      }
  for (const Pair &pair : pairs)
    gap_formulas.push_back(
      pair.parameters.gap == "0"
        ? nullptr
        : std::make_shared<const geometry::Formula<dim>>("Gap", pair.parameters.gap));
  make_groups(x, q);
  // A list of boundaries stands for all pairs of one boundary of each side. Remove the pairs
  // without rows, because some of them may be too far apart to touch.
  for (unsigned int p = joined.size(); p-- > 0;)
    if (groups[p].rows->slaves().empty())
      {
        joined.erase(joined.begin() + p);
        chosen.erase(chosen.begin() + p);
        matching_of.erase(matching_of.begin() + p);
        groups.erase(groups.begin() + p);
      }
  number_rows(x, q);
  const auto paired = rows(positions);
  measure_pairing(positions, paired);
  make_tangents(x, q, paired);
}

/// Choose the slaves and the methods of the joined pairs. A side that ends inside the other one is
/// the slave, because a face of a slave that the master covers in part shares its force badly among
/// its nodes. The choices are made once, because a design that changes which side is finer must not
/// exchange the sides, or the kind of the rows, in a new contact search.
template <int dim>
void Contact<dim>::choose_slaves(const Field &positions, const faces::HeldDirections<dim> &held)
{
  // Store whether the sides of a pair of the scene are exchanged. The choice holds for all joined
  // pairs that contain this pair, because the force of the pair is the force on one side.
  std::map<unsigned int, bool> exchanged;
  choose_elastic_slaves(joined);
  for (JoinedPair &of : joined)
    {
      Pair      &pair         = of.pair;
      bool       is_exchanged = false;
      const auto known    = std::find_if(of.parts.begin(), of.parts.end(), [&](const auto &part) {
        return exchanged.count(part.pair) > 0;
      });
      const auto exchange = [&]() {
        of.swap_slave_master();
        is_exchanged = !is_exchanged;
      };
      if (known != of.parts.end() && exchanged[known->pair])
        exchange();
      bool may_exchange =
        pair.parameters.slave == Slave::finer && !pair.obstacle && known == of.parts.end();
      chosen.push_back(pair);
      const auto geometry_of_pair = [&]() {
        chosen.back() = pair;
        return geometry(chosen.size() - 1, positions, held);
      };
      const auto is_good_end = [&]() {
        return relative_size(surface, positions, pair) * pair.modulus_ratio <= alike_at_ends &&
               ends_inside(geometry_of_pair());
      };
      if (may_exchange)
        {
          const bool of_slave = is_good_end();
          exchange();
          const bool of_master = is_good_end();
          if (of_slave || !of_master)
            exchange();
          may_exchange = of_slave == of_master;
        }
      if (may_exchange && relative_size(surface, positions, pair) < 1. - finer_by)
        exchange();
      matching_of.emplace_back();
      bool matches = true; // the nodes of both sides
      for (unsigned int side = 0; side < 2 && !pair.obstacle; ++side)
        {
          exchange();
          matching_of.back() = matching<dim>(geometry_of_pair());
          matches            = matches && matching_of.back().complete();
        }
      if (!pair.parameters.method)
        pair.parameters.method = matches ? Method::nodal : Method::mortar;
      if (may_exchange && pair.parameters.method == Method::mortar &&
          prefers_coarse_slave(relative_size(surface, positions, pair), pair.modulus_ratio))
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
  const Pair &pair = chosen[p];
  return {surface,
          shape,
          pair,
          sides_of(surface, pair),
          positions,
          held,
          std::move(taken),
          position.of_body(pair.slave.body()),
          position.of_obstacle(pair.obstacle ? pair.obstacle->name : "")};
}

template <int dim>
void Contact<dim>::pair(const Field &positions, const faces::HeldDirections<dim> &held)
{
  const auto x = placed.to_space(positions);
  const auto q = placed.turned(held);
  make_groups(x, q);
  number_rows(x, q);
  const auto paired = rows(positions);
  measure_pairing(positions, paired);
  make_tangents(x, q, paired);
}

template <int dim>
void Contact<dim>::number_rows(const Field &positions, const faces::HeldDirections<dim> &held)
{
  row_places.clear();
  for (unsigned int p = 0; p < groups.size(); ++p)
    for (const unsigned int slave : groups[p].rows->slaves())
      // The index of a row is its position in this list of all groups.
      row_places.push_back({p, slave});
  share_rows(positions, held);
  check_named_pairs(positions);
  collect_dependent_multipliers();
}

template <int dim>
void Contact<dim>::make_groups(const Field &positions, const faces::HeldDirections<dim> &held)
{
  SNUG_ASSERT_EQUAL(held.size(), surface.n_nodes());
  groups.clear();
  for (unsigned int p = 0; p < chosen.size(); ++p)
    groups.push_back(make_group(geometry(p, positions, held)));
  auto taken = contested_nodes(positions);
  for (unsigned int p = 0; p < chosen.size(); ++p)
    if (!taken[p].empty())
      groups[p] = make_group(geometry(p, positions, held, std::move(taken[p])));
}

/// Return, for each group, the slave nodes that have a row against the same surface in another
/// group whose side faces this surface better. Two such rows would be nearly equal and W = B D^-1
/// B' singular. An empty list means that there are no such nodes.
template <int dim>
std::vector<std::vector<bool>> Contact<dim>::contested_nodes(const Field &positions) const
{
  struct Row
  {
    unsigned int group;
    double       cosine; ///< between the normals of the group's side and of the row
  };
  std::map<std::pair<std::string, Boundary>, std::vector<unsigned int>> groups_of; // per surface
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
            if (row.cosine > best.cosine + 1e-9) // the first of equal rows
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
  gap_shares = shares_of_rows([](const PairParameters &of) { return of.gap; });
  for (Shares &shares : gap_shares)
    shares.erase(std::remove_if(shares.begin(), shares.end(),
                                [&](const auto &share) { return !gap_formulas[share.first]; }),
                 shares.end());
}

/// Check replicated data, so that all ranks reach the same answer and throw the same error.
template <int dim>
void Contact<dim>::check_named_pairs(const Field &positions) const
{
  std::vector<bool> has_rows(named.size(), false);
  for (unsigned int p = 0; p < groups.size(); ++p)
    if (!groups[p].rows->slaves().empty())
      for (const auto &part : joined[p].parts)
        has_rows[part.pair] = true;
  // In a position of its own, another pair may carry the load, like the next teeth of a gear.
  const bool may_miss = !(position == Position<dim>()) &&
                        std::find(has_rows.begin(), has_rows.end(), true) != has_rows.end();
  for (unsigned int pair = 0; pair < named.size(); ++pair)
    if (!has_rows[pair] && !may_miss)
      {
        const NamedPair &of = named[pair];
        throw InputError(
          "contact pair '" + of.name() +
          "': no slave node lies opposite to the master within the search distance and angle: " +
          places_of_sides<dim>(
            surface, shape, {of.slave, of.master, of.slave_name, of.master_name, {}, of.obstacle},
            positions));
      }
}

#define SNUG_INSTANTIATE(dim)                                                                \
  template Contact<dim>::Contact(const mesh::Surface<dim> &, const std::vector<Pair> &,      \
                                 unsigned int, const mesh::Surface<dim>::Field &,            \
                                 const faces::HeldDirections<dim> &, const Position<dim> &); \
  template void              Contact<dim>::pair(const mesh::Surface<dim>::Field &,           \
                                                const faces::HeldDirections<dim> &);         \
  template PairGeometry<dim> Contact<dim>::geometry(unsigned int,                            \
                                                    const mesh::Surface<dim>::Field &,       \
                                                    const faces::HeldDirections<dim> &,      \
                                                    std::vector<bool>) const;
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::contact
