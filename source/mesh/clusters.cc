#include <snug/base/disjoint_sets.h>
#include <snug/base/gather.h>
#include <snug/mesh/clusters.h>
#include <snug/mesh/tearing.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace snug::mesh {
namespace {
/// The box of a subdomain at the reference positions.
template <int dim>
struct Box
{
  unsigned int           subdomain, body;
  dealii::Tensor<1, dim> lower, upper;

  dealii::Tensor<1, dim> centre() const { return 0.5 * (lower + upper); }
};

template <int dim>
using Boxes = std::vector<Box<dim>>;

/// Return whether one centre comes before another one, by @p axis and then by the other axes.
template <int dim>
bool comes_before(const Box<dim> &a, const Box<dim> &b, const unsigned int axis)
{
  const auto at_a = a.centre(), at_b = b.centre();
  if (at_a[axis] != at_b[axis])
    return at_a[axis] < at_b[axis];
  for (unsigned int d = 0; d < dim; ++d)
    if (at_a[d] != at_b[d])
      return at_a[d] < at_b[d];
  return false;
}

/// Return the boxes of the subdomains of all ranks, body by body, in an order that does not depend
/// on the number of ranks. Collective.
template <int dim>
Boxes<dim> boxes_of(const BodyMesh<dim> &mesh, const Tearing &tearing)
{
  std::vector<double> packed;
  for (unsigned int s = 0; s < tearing.subdomains.size(); ++s)
    {
      const auto &subdomain = tearing.subdomains[s];
      packed.push_back(tearing.first_id + s);
      packed.push_back(subdomain.body);
      for (unsigned int d = 0; d < dim; ++d)
        {
          double lower = std::numeric_limits<double>::max(), upper = -lower;
          for (const unsigned int node : subdomain.nodes)
            {
              lower = std::min(lower, mesh.reference_positions()[node][d]);
              upper = std::max(upper, mesh.reference_positions()[node][d]);
            }
          packed.push_back(lower);
          packed.push_back(upper);
        }
    }
  Boxes<dim> boxes;
  for (const auto &of_rank : all_gather(mesh.communicator(), packed))
    for (auto p = of_rank.begin(); p != of_rank.end(); p += 2 + 2 * dim)
      {
        boxes.push_back({static_cast<unsigned int>(p[0]), static_cast<unsigned int>(p[1]), {}, {}});
        for (unsigned int d = 0; d < dim; ++d)
          {
            boxes.back().lower[d] = p[2 + 2 * d];
            boxes.back().upper[d] = p[3 + 2 * d];
          }
      }
  std::stable_sort(boxes.begin(), boxes.end(), [](const auto &a, const auto &b) {
    return a.body != b.body ? a.body < b.body : comes_before(a, b, 0);
  });
  return boxes;
}

/// This class cuts the boxes of one body into slabs, axis by axis.
template <int dim>
class Slabs
{
public:
  using Iterator = typename Boxes<dim>::iterator;

  Slabs(const unsigned int edge, unsigned int first_slab) : edge(edge), n(first_slab) {}

  /// Number the slabs of the boxes in [begin, end), which are cut along @p axis and later axes.
  void divide(Iterator begin, Iterator end, const unsigned int axis)
  {
    if (axis == dim)
      {
        for (auto box = begin; box != end; ++box)
          slab_of.emplace_back(box->subdomain, n);
        ++n;
        return;
      }
    std::sort(begin, end,
              [axis](const auto &a, const auto &b) { return comes_before(a, b, axis); });
    const auto   n_boxes  = static_cast<unsigned int>(end - begin);
    const auto   lengths  = sections(begin, end);
    const auto   wanted   = static_cast<unsigned int>(lengths[axis] / edge + below_half);
    const auto   n_slabs  = std::clamp(wanted, 1u, n_boxes);
    const double each     = static_cast<double>(n_boxes) / n_slabs;
    const double apart    = gap * mean_edge(begin, end, axis);
    unsigned int previous = 0;
    for (unsigned int k = 1; k <= n_slabs; ++k)
      {
        const unsigned int at =
          k == n_slabs ? n_boxes : cut(begin, end, axis, k * each, each, apart);
        if (at > previous)
          divide(begin + previous, begin + at, axis + 1);
        previous = std::max(previous, at);
      }
  }

  unsigned int n_slabs() const { return n; }
  /// Return pairs {subdomain, slab}.
  const std::vector<std::pair<unsigned int, unsigned int>> &slabs() const { return slab_of; }

private:
  /// Half layers are rounded down, so that there are few clusters.
  static constexpr double below_half = 0.4;
  /// A gap between layers is at least this part of the mean edge of a box.
  static constexpr double gap = 0.25;

  static double mean_edge(Iterator begin, Iterator end, const unsigned int axis)
  {
    double sum = 0.;
    for (auto box = begin; box != end; ++box)
      sum += box->upper[axis] - box->lower[axis];
    return sum / static_cast<double>(end - begin);
  }

  /// Return the lengths of the range along the axes in edges of a box. Their product is the number
  /// of boxes also where the boxes overlap or leave a part of the range empty.
  static std::array<double, dim> sections(Iterator begin, Iterator end)
  {
    std::array<double, dim> result;
    double                  product = 1.;
    for (unsigned int d = 0; d < dim; ++d)
      {
        double lower = std::numeric_limits<double>::max(), upper = -lower;
        for (auto box = begin; box != end; ++box)
          {
            lower = std::min(lower, box->lower[d]);
            upper = std::max(upper, box->upper[d]);
          }
        const double mean = mean_edge(begin, end, d);
        result[d]         = mean > 0. ? (upper - lower) / mean : 1.;
        product *= result[d];
      }
    const double factor = std::pow(static_cast<double>(end - begin) / product, 1. / dim);
    for (double &length : result)
      length *= factor;
    return result;
  }

  /// Return the number of boxes before a cut: @p wanted, or the nearest number within a quarter of
  /// a slab at which consecutive centres are @p apart.
  static unsigned int cut(Iterator           begin,
                          Iterator           end,
                          const unsigned int axis,
                          const double       wanted,
                          const double       each,
                          const double       apart)
  {
    double       least = 0.25 * each + 1e-9;
    unsigned int best  = static_cast<unsigned int>(std::lround(wanted));
    for (unsigned int i = 1; i < static_cast<unsigned int>(end - begin); ++i)
      if (std::abs(i - wanted) < least - 1e-9 &&
          begin[i].centre()[axis] - begin[i - 1].centre()[axis] > apart)
        {
          least = std::abs(i - wanted);
          best  = i;
        }
    return best;
  }

  const unsigned int                                 edge;
  unsigned int                                       n;
  std::vector<std::pair<unsigned int, unsigned int>> slab_of;
};

/// Return the slab of every global subdomain.
template <int dim>
std::vector<unsigned int>
slabs_of(Boxes<dim> boxes, const unsigned int n_subdomains, const unsigned int edge)
{
  std::vector<unsigned int> result(n_subdomains, 0);
  unsigned int              first = 0;
  for (auto begin = boxes.begin(); begin != boxes.end();)
    {
      const auto end =
        std::find_if(begin, boxes.end(), [&](const auto &box) { return box.body != begin->body; });
      Slabs<dim> slabs(edge, first);
      slabs.divide(begin, end, 0);
      for (const auto &[subdomain, slab] : slabs.slabs())
        result[subdomain] = slab;
      first = slabs.n_slabs();
      begin = end;
    }
  return result;
}

/// Global subdomain -> global nodes that a subdomain shares with it.
using SharedNodes = std::map<unsigned int, std::vector<unsigned int>>;

/// Return the nodes that the subdomains of this rank share with other subdomains. Collective.
template <int dim>
std::vector<SharedNodes> shared_nodes(const BodyMesh<dim> &mesh, const Tearing &tearing)
{
  using dealii::Utilities::MPI::some_to_some;
  // pairs {node, subdomain} for the owner of the node
  std::map<unsigned int, std::vector<unsigned int>> out;
  for (unsigned int s = 0; s < tearing.subdomains.size(); ++s)
    for (const unsigned int node : tearing.subdomains[s].nodes)
      {
        auto &message = out[mesh.owner(node)];
        message.insert(message.end(), {mesh.global_node(node), tearing.first_id + s});
      }
  std::map<unsigned int, std::vector<std::pair<unsigned int, unsigned int>>> copies; // {id, rank}
  for (const auto &[rank, message] : some_to_some(mesh.communicator(), out))
    for (std::size_t i = 0; i < message.size(); i += 2)
      copies[message[i]].emplace_back(message[i + 1], rank);
  // triples {subdomain, other subdomain, node} for the rank of the subdomain
  std::map<unsigned int, std::vector<unsigned int>> back;
  for (const auto &[node, of_node] : copies)
    for (const auto &[subdomain, rank] : of_node)
      for (const auto &[other, of_other] : of_node)
        if (other != subdomain)
          back[rank].insert(back[rank].end(), {subdomain, other, node});
  std::vector<SharedNodes> result(tearing.subdomains.size());
  for (const auto &[rank, message] : some_to_some(mesh.communicator(), back))
    for (std::size_t i = 0; i < message.size(); i += 3)
      result[message[i] - tearing.first_id][message[i + 1]].push_back(message[i + 2]);
  for (auto &of_subdomain : result)
    for (auto &[other, nodes] : of_subdomain)
      std::sort(nodes.begin(), nodes.end());
  return result;
}

/// Return whether the motions of @p points determine a rigid motion: in space three points that are
/// not on a line, in the plane two points, and in sections of bodies of revolution one.
template <int dim>
bool determine_motion(const Field<dim> &points, const Idealization &idealization)
{
  if (idealization.is_axisymmetric())
    return !points.empty();
  const auto farthest = [&](const auto &distance) {
    return *std::max_element(points.begin(), points.end(), [&](const auto &a, const auto &b) {
      return distance(a) < distance(b);
    });
  };
  const auto   far    = farthest([&](const auto &x) { return (x - points.front()).norm(); });
  const double length = (far - points.front()).norm();
  if (dim == 2 || length == 0.)
    return length > 0.;
  const auto along    = (far - points.front()) / length;
  const auto off_line = [&](const auto &x) {
    const auto offset = x - points.front();
    return (offset - (offset * along) * along).norm();
  };
  const double least = 1e-4; // of the length, so that the motions are well conditioned
  return off_line(farthest(off_line)) > least * length;
}

/// Return the pairs (a < b) of subdomains of all ranks that share a face. Collective.
template <int dim>
std::vector<std::pair<unsigned int, unsigned int>>
face_neighbours(const BodyMesh<dim>            &mesh,
                const Tearing                  &tearing,
                const std::vector<SharedNodes> &shared)
{
  std::vector<unsigned int> mine;
  for (unsigned int s = 0; s < shared.size(); ++s)
    for (const auto &[other, nodes] : shared[s])
      {
        Field<dim> points;
        for (const unsigned int node : nodes)
          points.push_back(mesh.reference_positions()[mesh.local_node(node)]);
        if (tearing.first_id + s < other && determine_motion(points, mesh.idealization()))
          mine.insert(mine.end(), {tearing.first_id + s, other});
      }
  std::vector<std::pair<unsigned int, unsigned int>> pairs;
  for (const auto &of_rank : all_gather(mesh.communicator(), mine))
    for (std::size_t i = 0; i < of_rank.size(); i += 2)
      pairs.emplace_back(of_rank[i], of_rank[i + 1]);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// Return the pieces of the slabs that faces join, numbered in the order of their first subdomains.
std::vector<unsigned int>
joined_pieces(const std::vector<unsigned int>                          &slabs,
              const std::vector<std::pair<unsigned int, unsigned int>> &neighbours)
{
  DisjointSets pieces(static_cast<unsigned int>(slabs.size()));
  for (const auto &[a, b] : neighbours)
    if (slabs[a] == slabs[b])
      pieces.join(a, b);
  std::vector<unsigned int> result;
  unsigned int              n = 0;
  for (unsigned int s = 0; s < slabs.size(); ++s)
    result.push_back(pieces.find(s) == s ? n++ : result[pieces.find(s)]);
  return result;
}
} // namespace

template <int dim>
Clusters find_clusters(const BodyMesh<dim> &mesh, const Tearing &tearing, const unsigned int edge)
{
  Clusters result;
  result.is_chosen = edge > 0;
  if (edge == 1 || (edge == 0 && tearing.n_global <= most_single_clusters))
    return result;
  const auto boxes      = boxes_of(mesh, tearing);
  const auto shared     = shared_nodes(mesh, tearing);
  const auto neighbours = face_neighbours(mesh, tearing, shared);
  for (unsigned int by = std::max(edge, 2u);; ++by)
    {
      result.of_subdomain = joined_pieces(slabs_of(boxes, tearing.n_global, by), neighbours);
      const auto n = *std::max_element(result.of_subdomain.begin(), result.of_subdomain.end()) + 1;
      // A model of many separate parts keeps one cluster per part.
      if (edge > 0 || n <= most_clusters || by * by > tearing.n_global)
        break;
    }
  result.joints.resize(shared.size());
  for (unsigned int s = 0; s < shared.size(); ++s)
    for (const auto &[other, nodes] : shared[s])
      {
        const unsigned int id = tearing.first_id + s;
        if (result.of_subdomain[other] != result.of_subdomain[id] ||
            !std::binary_search(neighbours.begin(), neighbours.end(),
                                std::pair(std::min(id, other), std::max(id, other))))
          continue;
        result.joints[s].push_back({other, {}});
        const auto &all = tearing.subdomains[s].nodes;
        for (const unsigned int node : nodes)
          result.joints[s].back().nodes.push_back(static_cast<unsigned int>(
            std::lower_bound(all.begin(), all.end(), mesh.local_node(node)) - all.begin()));
      }
  return result;
}

template Clusters find_clusters(const BodyMesh<2> &, const Tearing &, unsigned int);
template Clusters find_clusters(const BodyMesh<3> &, const Tearing &, unsigned int);
} // namespace snug::mesh
