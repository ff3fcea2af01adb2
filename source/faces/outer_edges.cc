#include <snug/faces/outer_edges.h>

#include <algorithm>
#include <utility>

namespace snug::faces {
namespace {
/// Points with xi closer than this to 0 or 1 are on the edge.
const double edge_width = 1e-12;

bool at_bound(double x)
{
  return x < edge_width || x > 1. - edge_width;
}
} // namespace

template <int dim>
OuterEdges<dim>::OuterEdges(const mesh::Surface<dim>        &surface,
                            const std::vector<unsigned int> &faces,
                            const FaceShape<dim>            &shape)
  : surface(surface), shape(shape)
{
  // Edges of one face alone are candidates. Faces that share an edge have the same ends of it.
  using Ends = std::pair<unsigned int, unsigned int>;
  std::vector<std::pair<Ends, Edge>> edges;
  for (const unsigned int face : faces)
    for (unsigned int edge = 0; edge < 2 * (dim - 1); ++edge)
      edges.emplace_back(ends_of(face, edge), Edge(face, edge));
  std::sort(edges.begin(), edges.end());
  std::vector<Edge> candidates;
  for (std::size_t i = 0; i < edges.size(); ++i)
    if ((i == 0 || edges[i - 1].first != edges[i].first) &&
        (i + 1 == edges.size() || edges[i + 1].first != edges[i].first))
      candidates.push_back(edges[i].second);
  // Where meshes of different fineness meet, the edge of the coarse face and its halves have
  // different ends, so that each of them is on one face only. Both reach the same masters, which
  // shows that they are not at the end of the side.
  struct Halves
  {
    bool coarse = false, fine = false;
  };
  std::map<std::vector<unsigned int>, Halves> halves;
  for (const auto &[face, edge] : candidates)
    {
      const auto nodes   = edge_nodes(face, edge);
      const bool hanging = std::any_of(nodes.begin(), nodes.end(), [&](const unsigned int node) {
        return !surface.masters(node).empty();
      });
      auto      &half    = halves[edge_masters(nodes)];
      (hanging ? half.fine : half.coarse) = true;
    }
  for (const auto &[face, edge] : candidates)
    {
      const auto nodes = edge_nodes(face, edge);
      const auto half  = halves.at(edge_masters(nodes));
      if (half.coarse && half.fine)
        continue;
      outer.emplace_back(face, edge);
      for (const unsigned int node : nodes)
        outer_at_vertex[node].emplace_back(face, edge);
    }
  // Sort the edges for the binary search of excess().
  std::sort(outer.begin(), outer.end());
}

/// Return the two ends of an edge, the lower first. In 2D an "edge" is a node.
template <int dim>
std::pair<unsigned int, unsigned int> OuterEdges<dim>::ends_of(unsigned int face,
                                                               unsigned int edge) const
{
  const auto                           &nodes = surface.faces()[face].nodes;
  std::pair<unsigned int, unsigned int> ends;
  bool                                  is_first = true;
  for (unsigned int k = 0; k < shape.n_nodes(); ++k)
    if (shape.node(k)[edge / 2] == edge % 2)
      {
        if (std::exchange(is_first, false))
          ends.first = nodes[k];
        ends.second = nodes[k];
      }
  return {std::min(ends.first, ends.second), std::max(ends.first, ends.second)};
}

/// Return the nodes of an edge, sorted, so that two faces give the same result for an edge they
/// share.
template <int dim>
std::vector<unsigned int> OuterEdges<dim>::edge_nodes(unsigned int face, unsigned int edge) const
{
  std::vector<unsigned int> nodes;
  for (unsigned int k = 0; k < shape.n_nodes(); ++k)
    if (shape.node(k)[edge / 2] == edge % 2)
      nodes.push_back(surface.faces()[face].nodes[k]);
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

template <int dim>
std::vector<unsigned int>
OuterEdges<dim>::edge_masters(const std::vector<unsigned int> &nodes) const
{
  std::vector<unsigned int> reached;
  for (const unsigned int node : nodes)
    {
      if (surface.masters(node).empty())
        reached.push_back(node);
      for (const auto &master : surface.masters(node))
        reached.push_back(master.first);
    }
  std::sort(reached.begin(), reached.end());
  reached.erase(std::unique(reached.begin(), reached.end()), reached.end());
  return reached;
}

template <int dim>
double OuterEdges<dim>::excess(unsigned int                              face,
                               const dealii::Point<dim - 1>             &xi,
                               const dealii::Tensor<1, dim>             &offset,
                               const typename mesh::Surface<dim>::Field &positions) const
{
  unsigned int n_bounds = 0, edge = 0;
  for (unsigned int i = 0; i < dim - 1; ++i)
    if (at_bound(xi[i]))
      {
        ++n_bounds;
        edge = 2 * i + (xi[i] > 0.5 ? 1 : 0);
      }
  // The closest point is inside of the face, so the offset is along the normal and nothing ends
  // here.
  if (n_bounds == 0)
    return 0.;
  if (n_bounds < dim - 1)
    {
      const Edge only(face, edge);
      return std::binary_search(outer.begin(), outer.end(), only)
               ? excess_at_edge(only, xi, offset, positions)
               : 0.;
    }
  // Find the corner node nearest to xi; nodes are 1/degree apart.
  unsigned int corner = 0;
  while (!(shape.node(corner).distance(xi) < 0.25 / shape.degree()))
    ++corner;
  const unsigned int vertex = surface.faces()[face].nodes[corner];
  const auto         found  = outer_at_vertex.find(vertex);
  double             result = 0.;
  if (found != outer_at_vertex.end())
    for (const Edge &incident : found->second)
      {
        const auto        &nodes = surface.faces()[incident.first].nodes;
        const unsigned int k     = std::find(nodes.begin(), nodes.end(), vertex) - nodes.begin();
        // At a corner of the side, edges of other faces end as well, so the largest excess counts.
        result = std::max(result, excess_at_edge(incident, shape.node(k), offset, positions));
      }
  return result;
}

template <int dim>
double OuterEdges<dim>::excess_at_edge(const Edge                               &edge,
                                       const dealii::Point<dim - 1>             &xi,
                                       const dealii::Tensor<1, dim>             &offset,
                                       const typename mesh::Surface<dim>::Field &positions) const
{
  const auto values = shape.at(xi);
  // d x/d xi is also the extent of the face along xi, because xi runs from 0 to 1.
  const auto             t = tangents<dim>(values, surface.faces()[edge.first].nodes, positions);
  const unsigned int     across  = edge.second / 2;
  dealii::Tensor<1, dim> outward = t[across];
  if (dim == 3)
    {
      // Take the direction at right angles to the edge within the face, for any angle between its
      // sides.
      const auto &along = t[dim - 2 - across];
      outward -= (outward * along / along.norm_square()) * along;
    }
  if (edge.second % 2 == 0)
    outward *= -1.;
  return offset * outward / (outward.norm() * t[across].norm());
}

template class OuterEdges<2>;
template class OuterEdges<3>;
} // namespace snug::faces
