#include <snug/contact/joined_pairs.h>
#include <snug/contact/nearest_face.h>
#include <snug/contact/opposite_faces.h>
#include <snug/faces/tributary.h>
#include <snug/mortar/mortar_coupling.h>
#include <snug/mortar/mortar_face.h>

#include <algorithm>
#include <set>

namespace snug::contact {
namespace {
template <typename Face>
Boundary boundary_of(const Face &face)
{
  return {face.body, face.boundary};
}

/// Tributary areas of the slave nodes, split among the pairs of the scene.
template <int dim>
class SharedAreas
{
public:
  SharedAreas(const JoinedPair &joined, const PairGeometry<dim> &geometry)
    : joined(joined), geometry(geometry), areas(geometry.surface.n_nodes())
  {
    const bool by_master =
      std::any_of(joined.parts.begin(), joined.parts.end(), [&](const auto &part) {
        return std::any_of(joined.parts.begin(), joined.parts.end(), [&](const auto &other) {
          return part.slave == other.slave && part.pair != other.pair;
        });
      });
    if (by_master)
      add_opposite();
    else
      for (const unsigned int face : geometry.sides.slave)
        add(face,
            {{joined.pair_of(boundary_of(geometry.surface.faces()[face]), {}), integrals(face)}});
    // A hanging node gives its area to its masters, like its force.
    for (unsigned int node = 0; node < areas.size(); ++node)
      for (const auto &[master, weight] : geometry.surface.masters(node))
        for (const auto &[pair, area] : areas[node])
          areas[master][pair] += weight * area;
  }

  const PairShares &at(const unsigned int node) const { return areas[node]; }

private:
  using OfPairs = std::map<unsigned int, std::vector<double>>; ///< by pair, per node of a face

  const JoinedPair        &joined;
  const PairGeometry<dim> &geometry;
  std::vector<PairShares>  areas; ///< per surface node [length^2]

  std::vector<double> integrals(const unsigned int face) const
  {
    return faces::shape_integrals(geometry.surface, face, geometry.shape, geometry.positions);
  }

  void add(const unsigned int face, const OfPairs &of_pairs)
  {
    const auto &nodes = geometry.surface.faces()[face].nodes;
    for (const auto &[pair, values] : of_pairs)
      for (unsigned int k = 0; k < nodes.size(); ++k)
        areas[nodes[k]][pair] += values[k];
  }

  /// Split the areas by the integrals over the parts of a slave face opposite to each master face.
  /// A part without an opposite face goes to the pair of the nearest master face.
  void add_opposite()
  {
    const auto                          &surface = geometry.surface;
    const MortarNormals<dim>             normals(geometry);
    const auto                           at_positions = normals.at(geometry.positions);
    const auto                           opposite     = opposite_faces(geometry, normals);
    const faces::PointField<dim, double> x(geometry.positions), n(at_positions.normals());
    const mortar::SegmentQuadrature<dim> quadrature(geometry.shape.degree(),
                                                    surface.idealization());
    const NearestFace<dim>               nearest(surface, geometry.sides.master, geometry.shape,
                                                 geometry.positions);
    for (unsigned int i = 0; i < geometry.sides.slave.size(); ++i)
      {
        const unsigned int face    = geometry.sides.slave[i];
        const auto         pair_at = [&](const unsigned int master) {
          return joined.pair_of(boundary_of(surface.faces()[face]),
                                        boundary_of(surface.faces()[master]));
        };
        dealii::Tensor<1, dim> centre;
        for (const unsigned int node : surface.faces()[face].nodes)
          centre += geometry.positions[node] / double(surface.faces()[face].nodes.size());
        const unsigned int     beside = pair_at(nearest.closest(centre).face);
        std::set<unsigned int> reached{beside};
        for (const unsigned int master : opposite[i])
          reached.insert(pair_at(master));
        OfPairs of_pairs{{beside, integrals(face)}};
        if (reached.size() > 1)
          for (const unsigned int master : opposite[i])
            if (const unsigned int pair = pair_at(master); pair != beside)
              {
                const auto part =
                  mortar::integrate<dim, double>(quadrature, normals.slave_face(face, x, n),
                                                 {mortar::mortar_face(surface, geometry.shape,
                                                                      master, x)});
                auto &own = of_pairs[pair];
                own.resize(part.slave.size());
                for (unsigned int k = 0; k < own.size(); ++k)
                  {
                    own[k] += part.slave[k];
                    of_pairs[beside][k] -= part.slave[k];
                  }
              }
        add(face, of_pairs);
      }
  }
};
} // namespace

template <int dim>
std::vector<PairShares>
row_shares(const JoinedPair &joined, const PairGeometry<dim> &geometry, const RowGroup<dim> &group)
{
  const auto        &slaves = group.slaves();
  const unsigned int first  = joined.parts.front().pair;
  if (std::all_of(joined.parts.begin(), joined.parts.end(),
                  [first](const auto &part) { return part.pair == first; }))
    return std::vector<PairShares>(slaves.size(), {{first, 1.}});
  const SharedAreas<dim>  areas(joined, geometry);
  std::vector<PairShares> result;
  for (const unsigned int slave : slaves)
    result.push_back(areas.at(slave));
  // Add the areas of nodes without a row, whose multiplier functions belong to the rows.
  for (const auto &shared : group.dependent_multipliers())
    for (const auto &[row, share] : shared.rows)
      for (const auto &[pair, area] : areas.at(shared.node))
        result[row][pair] += share * area;
  for (PairShares &shares : result)
    {
      double sum = 0.;
      for (const auto &[pair, area] : shares)
        sum += area;
      for (auto &[pair, area] : shares)
        // Nodes on the axis of revolution have no area at degree 2, so their shares are equal.
        area = sum > 0. ? area / sum : 1. / double(shares.size());
    }
  return result;
}

#define SNUG_INSTANTIATE(dim)                                                                \
  template std::vector<PairShares> row_shares(const JoinedPair &, const PairGeometry<dim> &, \
                                              const RowGroup<dim> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::contact
