#include <snug/faces/tributary.h>
#include <snug/mortar/multiplier_nodes.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

namespace snug::mortar {
namespace {
/// Nodes of which less than this fraction is covered on each of their faces are weak.
const double least_cover = 0.5;

/// Surface nodes that own parts of the multiplier function of a node, with their shares.
using Owners = std::map<unsigned int, double>;

template <int dim>
class MultiplierChoice
{
public:
  using Field = typename mesh::Surface<dim>::Field;

  MultiplierChoice(const mesh::Surface<dim>     &surface,
                   const std::vector<FaceCover> &covers,
                   std::vector<bool>             without_area,
                   const Field                  &positions)
    : surface(surface), without_area(std::move(without_area)), positions(positions)
  {
    collect(covers);
    set_order(covers);
  }

  /// Choose the owners. A held node has no displacement along the normal, so its own row could not
  /// be satisfied. The row of a weak node would nearly repeat that of its neighbour. Held nodes are
  /// treated first, because a weak node may then give its function to the owners of a held node's
  /// function. A held node without free neighbours keeps its row, because the master may still
  /// move.
  void choose(const std::vector<bool> &held)
  {
    std::vector<unsigned int> left;
    for (const unsigned int node : order)
      if (candidates[node].is_weak() || held[node])
        left.push_back(node);
      else
        candidates[node].owners = {{node, 1.}};
    auto weak = std::stable_partition(left.begin(), left.end(), [&](unsigned int node) {
      return !candidates[node].is_weak();
    });
    std::vector<unsigned int> held_nodes(left.begin(), weak);
    left.erase(left.begin(), weak);
    give_away(held_nodes);
    for (const unsigned int node : held_nodes)
      candidates[node].owners = {{node, 1.}};
    // Weak nodes far from good ones are reached in sweeps. Where all nodes are weak, the best is
    // kept.
    while (!left.empty())
      if (!give_away(left))
        {
          const auto best =
            std::max_element(left.begin(), left.end(), [&](unsigned int a, unsigned int b) {
              return candidates[a].covered < candidates[b].covered;
            });
          candidates[*best].owners = {{*best, 1.}};
          left.erase(best);
        }
  }

  MultiplierNodes result() const
  {
    MultiplierNodes                      result;
    std::map<unsigned int, unsigned int> index;
    for (const unsigned int node : order)
      if (candidates.at(node).owners.count(node) > 0)
        {
          index[node] = result.nodes.size();
          result.nodes.push_back(node);
        }
    result.shares.resize(surface.n_nodes());
    for (unsigned int node = 0; node < surface.n_nodes(); ++node)
      {
        std::map<unsigned int, double> shares;
        // The shares of hanging nodes go through their masters to the owners of the masters'
        // functions.
        for (const auto &master : masters(node))
          {
            const auto found = candidates.find(master.first);
            if (found != candidates.end())
              for (const auto &owner : found->second.owners)
                shares[index.at(owner.first)] += master.second * owner.second;
          }
        result.shares[node].assign(shares.begin(), shares.end());
      }
    return result;
  }

private:
  /// A node that does not hang, with its cover.
  struct Candidate
  {
    double                    covered       = 0.; ///< sum over all faces
    double                    best_part     = 0.; ///< maximum of all faces
    double                    largest_whole = 0.;
    bool                      without_area  = false;
    std::vector<unsigned int> neighbours; ///< nodes on the same faces
    Owners                    owners;

    bool is_weak() const
    {
      return without_area || best_part < least_cover || covered < least_cover * largest_whole;
    }
  };

  const mesh::Surface<dim>         &surface;
  const std::vector<bool>           without_area; ///< per surface node
  const Field                      &positions;
  std::vector<unsigned int>         order; ///< candidates in the order of set_order()
  std::map<unsigned int, Candidate> candidates;

  /// Return the node itself with weight 1, or its masters and weights if it hangs.
  Owners masters(unsigned int node) const
  {
    // The function of a hanging node belongs to its masters in the displacement, and so in the
    // rows.
    const auto &of_node = surface.masters(node);
    if (of_node.empty())
      return {{node, 1.}};
    return {of_node.begin(), of_node.end()};
  }

  void collect(const std::vector<FaceCover> &covers)
  {
    for (const FaceCover &cover : covers)
      {
        const auto &nodes = surface.faces()[cover.face].nodes;
        Owners      covered, whole;
        for (unsigned int k = 0; k < nodes.size(); ++k)
          for (const auto &master : cover.functions[k])
            {
              covered[master.first] += master.second * cover.covered[k];
              whole[master.first] += master.second * cover.whole[k];
              candidates[master.first];
            }
        for (const auto &node : covered)
          {
            // Functions of degree 2 may have an integral of zero or less at corners in 3D. Such a
            // node is judged by the sum over its faces alone.
            Candidate   &candidate = candidates[node.first];
            const double most      = whole[node.first];
            candidate.without_area = without_area[node.first];
            candidate.covered += node.second;
            candidate.largest_whole = std::max(candidate.largest_whole, most);
            if (most > 0.)
              candidate.best_part = std::max(candidate.best_part, node.second / most);
            for (const auto &other : covered)
              {
                if (other.first != node.first)
                  candidate.neighbours.push_back(other.first);
              }
          }
      }
  }

  /// Order the candidates as the faces name them, then candidates that only hanging nodes reach by
  /// position. So the order does not depend on the numbering of nodes.
  void set_order(const std::vector<FaceCover> &covers)
  {
    std::set<unsigned int> left;
    for (const auto &candidate : candidates)
      left.insert(candidate.first);
    for (const FaceCover &cover : covers)
      for (const unsigned int node : surface.faces()[cover.face].nodes)
        if (left.erase(node) > 0)
          order.push_back(node);
    const auto named = order.size();
    order.insert(order.end(), left.begin(), left.end());
    std::sort(order.begin() + named, order.end(), [&](unsigned int a, unsigned int b) {
      const auto &x = positions[a], &y = positions[b];
      return std::lexicographical_compare(x.begin_raw(), x.end_raw(), y.begin_raw(), y.end_raw());
    });
  }

  /// Return the mean of the owners of the nearest neighbours among @p eligible, which is sorted;
  /// empty if there are no such neighbours.
  Owners owners_of_nearest(unsigned int node, const std::vector<unsigned int> &eligible) const
  {
    // Distances that differ by less than this factor count as equal. On symmetric meshes a node
    // gives equal shares to all its nearest neighbours, because otherwise the pressure would lose
    // the symmetry of the mesh.
    const double              equal   = 1. + 1e-6;
    double                    nearest = std::numeric_limits<double>::max();
    std::vector<unsigned int> found;
    const auto                distance = [&](unsigned int other) {
      return (positions[other] - positions[node]).norm();
    };
    for (const unsigned int other : candidates.at(node).neighbours)
      if (std::binary_search(eligible.begin(), eligible.end(), other))
        {
          found.push_back(other);
          nearest = std::min(nearest, distance(other));
        }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    found.erase(std::remove_if(found.begin(), found.end(),
                               [&](unsigned int other) {
                                 return distance(other) > equal * nearest;
                               }),
                found.end());
    Owners result;
    for (const unsigned int other : found)
      for (const auto &owner : candidates.at(other).owners)
        result[owner.first] += owner.second / found.size();
    return result;
  }

  /// Give all nodes of @p left with neighbours that have owners the same owners. Return false if
  /// there are no such nodes. All shares of a sweep are computed before any is assigned, because
  /// the result must not depend on the order.
  bool give_away(std::vector<unsigned int> &left)
  {
    std::vector<unsigned int> settled;
    for (const auto &candidate : candidates)
      if (!candidate.second.owners.empty())
        settled.push_back(candidate.first);
    std::map<unsigned int, Owners> given;
    for (const unsigned int node : left)
      {
        const Owners owners = owners_of_nearest(node, settled);
        if (!owners.empty())
          given[node] = owners;
      }
    for (const auto &entry : given)
      {
        candidates[entry.first].owners = entry.second;
        left.erase(std::find(left.begin(), left.end(), entry.first));
      }
    return !given.empty();
  }
};

} // namespace

template <int dim>
MultiplierNodes choose_multiplier_nodes(const mesh::Surface<dim>                 &surface,
                                        const std::vector<FaceCover>             &covers,
                                        const std::vector<bool>                  &held,
                                        const faces::FaceShape<dim>              &shape,
                                        const typename mesh::Surface<dim>::Field &positions)
{
  std::vector<unsigned int> faces;
  for (const FaceCover &cover : covers)
    faces.push_back(cover.face);
  MultiplierChoice<dim> choice(surface, covers,
                               faces::nodes_without_area<dim>({surface, faces, shape}, positions),
                               positions);
  choice.choose(held);
  return choice.result();
}

#define SNUG_INSTANTIATE(dim)                                                      \
  template MultiplierNodes choose_multiplier_nodes(const mesh::Surface<dim> &,     \
                                                   const std::vector<FaceCover> &, \
                                                   const std::vector<bool> &,      \
                                                   const faces::FaceShape<dim> &,  \
                                                   const mesh::Surface<dim>::Field &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::mortar
