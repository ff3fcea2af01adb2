#include <snug/base/disjoint_sets.h>
#include <snug/base/errors.h>
#include <snug/contact/joined_pairs.h>
#include <snug/faces/nodal_normals.h>
#include <snug/geometry/face_list.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

namespace snug::contact {
namespace {
void exchange(Pair &pair)
{
  std::swap(pair.slave, pair.master);
  std::swap(pair.slave_name, pair.master_name);
  pair.modulus_ratio = 1. / pair.modulus_ratio;
}

bool are_equal(const PairParameters &a, const PairParameters &b)
{
  const auto all = [](const PairParameters &p) {
    return std::tie(p.method, p.slave, p.search_distance, p.largest_angle, p.gap, p.interference,
                    p.friction, p.friction_coefficient, p.friction_bound);
  };
  return all(a) == all(b);
}

/// Throw an error if two pairs with different entries bring together the same boundaries.
void check_entries(const std::vector<Pair> &pairs, const std::vector<JoinedPair::Part> &parts)
{
  for (const auto &a : parts)
    for (const auto &b : parts)
      if (a.pair < b.pair && a.slave == b.slave && a.master == b.master &&
          pairs[a.pair].obstacle.has_value() == pairs[b.pair].obstacle.has_value() &&
          (!pairs[a.pair].obstacle ||
           pairs[a.pair].obstacle->name == pairs[b.pair].obstacle->name) &&
          !are_equal(pairs[a.pair].parameters, pairs[b.pair].parameters))
        throw bad_entry("Contact/Pairs", pairs[b.pair].name(),
                        "brings together the same faces as '" + pairs[a.pair].name() +
                          "', which has other entries");
}

/// Return the pairs of one boundary of each side.
std::vector<JoinedPair::Part> parts_of(const Pair &pair, const unsigned int index)
{
  std::vector<JoinedPair::Part> parts;
  for (const Boundary &slave : pair.slave.boundaries())
    if (pair.obstacle)
      parts.push_back({slave, {}, index});
    else
      for (const Boundary &master : pair.master.boundaries())
        parts.push_back({slave, master, index});
  return parts;
}

/// Return the parts of all pairs in their order. Pairs whose slave is not chosen yet are exchanged
/// if only then one of their parts joins a part of another pair by can_join(a, b).
template <typename CanJoin>
std::vector<JoinedPair::Part> parts_that_join(std::vector<Pair> &pairs, const CanJoin &can_join)
{
  // Pairs with a fixed slave side come first, because only other pairs can follow them.
  std::vector<unsigned int> order;
  for (const bool fixed : {true, false})
    for (unsigned int p = 0; p < pairs.size(); ++p)
      if ((pairs[p].parameters.slave == Slave::first) == fixed)
        order.push_back(p);
  std::vector<JoinedPair::Part> parts;
  for (const unsigned int p : order)
    {
      const auto joins = [&](const std::vector<JoinedPair::Part> &own) {
        return std::any_of(own.begin(), own.end(), [&](const auto &part) {
          return std::any_of(parts.begin(), parts.end(),
                             [&](const auto &other) { return can_join(part, other); });
        });
      };
      auto own = parts_of(pairs[p], p);
      if (!joins(own) && pairs[p].parameters.slave == Slave::finer && !pairs[p].obstacle)
        {
          exchange(pairs[p]);
          if (const auto exchanged = parts_of(pairs[p], p); joins(exchanged))
            own = exchanged;
          else
            exchange(pairs[p]);
        }
      parts.insert(parts.end(), own.begin(), own.end());
    }
  std::stable_sort(parts.begin(), parts.end(),
                   [](const auto &a, const auto &b) { return a.pair < b.pair; });
  return parts;
}

/// Return "a + b" of the distinct names, in their order.
std::string sum_of(const std::vector<std::string> &names)
{
  std::vector<std::string> different;
  for (const auto &side : names)
    for (const auto &name : geometry::face_list(side))
      if (std::find(different.begin(), different.end(), name) == different.end())
        different.push_back(name);
  std::string result;
  for (const auto &name : different)
    result += (result.empty() ? "" : " + ") + name;
  return result;
}
/// Name the sides by the names of the pairs of the scene.
void name_sides(const std::vector<Pair> &pairs, JoinedPair &joined)
{
  std::vector<std::string> slaves, masters;
  for (const auto &part : joined.parts)
    {
      slaves.push_back(pairs[part.pair].slave_name);
      masters.push_back(pairs[part.pair].master_name);
    }
  joined.pair.slave_name  = sum_of(slaves);
  joined.pair.master_name = sum_of(masters);
}
} // namespace

/// This class finds which boundaries of the pairs continue each other smoothly.
template <int dim>
class SmoothSurfaces
{
public:
  using Field = typename mesh::Surface<dim>::Field;

  SmoothSurfaces(const mesh::Surface<dim>    &surface,
                 const faces::FaceShape<dim> &shape,
                 const std::vector<Pair>     &pairs,
                 const Field                 &positions)
    : boundaries(boundaries_of(pairs)), surfaces(boundaries.size())
  {
    std::vector<Field> normals;
    for (const Boundary &boundary : boundaries)
      {
        const auto faces = faces_of(surface, boundary);
        normals.push_back(faces::NodalNormals<dim>(surface, faces, shape, positions).normals());
      }
    const double least_cosine = std::cos(smooth_meeting / 180. * dealii::numbers::PI);
    for (unsigned int i = 0; i < boundaries.size(); ++i)
      for (unsigned int j = i + 1; j < boundaries.size(); ++j)
        // Normals are zero at nodes that do not belong to the boundary.
        for (unsigned int node = 0; node < surface.n_nodes(); ++node)
          if (normals[i][node] * normals[j][node] > least_cosine)
            {
              meetings.insert({i, j});
              surfaces.join(i, j);
              break;
            }
  }

  /// Return whether the boundaries are the same or share nodes and meet smoothly at a shared node.
  bool meet(const Boundary &a, const Boundary &b) const
  {
    const auto [i, j] = std::minmax({index(a), index(b)});
    return i == j || meetings.count({i, j}) > 0;
  }

  Boundary surface_of(const Boundary &boundary) const
  {
    return boundaries[surfaces.find(index(boundary))];
  }

private:
  const std::vector<Boundary>                     boundaries;
  DisjointSets                                    surfaces;
  std::set<std::pair<unsigned int, unsigned int>> meetings;

  unsigned int index(const Boundary &boundary) const
  {
    return std::lower_bound(boundaries.begin(), boundaries.end(), boundary) - boundaries.begin();
  }
};

unsigned int JoinedPair::pair_of(const Boundary &slave, const Boundary &master) const
{
  const auto find = [this](const auto &is_wanted) {
    return std::find_if(parts.begin(), parts.end(), is_wanted);
  };
  auto found = find([&](const Part &part) { return part.slave == slave && part.master == master; });
  if (found == parts.end())
    found = find([&](const Part &part) { return part.slave == slave; });
  if (found == parts.end())
    found = find([&](const Part &part) { return part.master == master; });
  return found == parts.end() ? parts.front().pair : found->pair;
}

PairParameters joined_parameters(const PairParameters &a, const PairParameters &b)
{
  PairParameters result = a;
  if (!a.method || b.method == Method::mortar)
    result.method = b.method;
  if (b.slave == Slave::first)
    result.slave = b.slave;
  // A search distance of 0 means no limit.
  result.search_distance = std::min(a.search_distance, b.search_distance) == 0.
                             ? 0.
                             : std::max(a.search_distance, b.search_distance);
  result.largest_angle   = std::max(a.largest_angle, b.largest_angle);
  if (!a.has_friction())
    {
      result.friction             = b.friction;
      result.friction_coefficient = b.friction_coefficient;
      result.friction_bound       = b.friction_bound;
    }
  return result;
}

void JoinedPair::swap_slave_master()
{
  exchange(pair);
  for (Part &part : parts)
    std::swap(part.slave, part.master);
  std::swap(slave_surface, master_surface);
}

template <int dim>
std::vector<JoinedPair> join_pairs(const mesh::Surface<dim>                 &surface,
                                   const faces::FaceShape<dim>              &shape,
                                   std::vector<Pair>                         pairs,
                                   const typename mesh::Surface<dim>::Field &positions)
{
  const SmoothSurfaces<dim> smooth(surface, shape, pairs, positions);
  const auto                can_join = [&](const JoinedPair::Part &a, const JoinedPair::Part &b) {
    const auto &obstacle = pairs[a.pair].obstacle, &other = pairs[b.pair].obstacle;
    if (!obstacle != !other || !smooth.meet(a.slave, b.slave))
      return false;
    return obstacle ? obstacle->name == other->name
                                   : smooth.surface_of(a.master) == smooth.surface_of(b.master);
  };
  const auto parts = parts_that_join(pairs, can_join);
  check_entries(pairs, parts);
  DisjointSets unions(parts.size());
  for (unsigned int i = 0; i < parts.size(); ++i)
    for (unsigned int j = i + 1; j < parts.size(); ++j)
      if (can_join(parts[i], parts[j]))
        unions.join(i, j);
  std::map<unsigned int, JoinedPair> joined; // keyed by the first part
  for (unsigned int i = 0; i < parts.size(); ++i)
    {
      const auto &part           = parts[i];
      const auto [place, is_new] = joined.try_emplace(unions.find(i));
      JoinedPair &of             = place->second;
      if (is_new)
        {
          of.pair       = pairs[part.pair];
          of.pair.slave = of.pair.master = {};
          of.slave_surface               = smooth.surface_of(part.slave);
          if (!of.pair.obstacle)
            of.master_surface = smooth.surface_of(part.master);
        }
      of.pair.parameters = joined_parameters(of.pair.parameters, pairs[part.pair].parameters);
      of.pair.slave.add(part.slave);
      if (!of.pair.obstacle)
        of.pair.master.add(part.master);
      of.parts.push_back(part);
    }
  std::vector<JoinedPair> result;
  for (auto &[first, of] : joined)
    {
      name_sides(pairs, of);
      result.push_back(std::move(of));
    }
  return result;
}

#define SNUG_INSTANTIATE(dim)                                                                   \
  template std::vector<JoinedPair> join_pairs(const mesh::Surface<dim> &,                       \
                                              const faces::FaceShape<dim> &, std::vector<Pair>, \
                                              const mesh::Surface<dim>::Field &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::contact
