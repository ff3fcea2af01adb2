#include <snug/mesh_file/curved_boundary.h>
#include <snug/mesh_file/smooth_surface.h>

#include <cmath>

namespace snug::mesh_file {
using geometry::sorted;

namespace {
unsigned int other(const std::vector<unsigned int> &edge, const unsigned int node)
{
  return edge[0] == node ? edge[1] : edge[0];
}
} // namespace

template <int dim>
CurvedBoundary<dim>::CurvedBoundary(const BodySurface<dim>   &the_surface,
                                    const SurfaceShapes<dim> &the_shapes)
  : surface(the_surface), shapes(the_shapes)
{
  find_chains();
  std::set<Corners> edges;
  for (unsigned int f = 0; f < surface.facets.size(); ++f)
    for (const Corners &edge : surface.edges(f))
      edges.insert(edge);
  // Edges in the interior of the body may have middles as well.
  for (const auto &middle : surface.middles)
    if (middle.first.size() == 2)
      edges.insert(middle.first);
  for (const Corners &edge : edges)
    add_curve(edge);
  for (unsigned int f = 0; f < surface.facets.size(); ++f)
    patches.push_back(patch(f));
}

template <int dim>
void CurvedBoundary<dim>::find_chains()
{
  if (dim == 2)
    for (unsigned int f = 0; f < surface.facets.size(); ++f)
      for (const unsigned int node : surface.facets[f].corners)
        chains[node].push_back(sorted(surface.facets[f].corners));
  for (const auto &ridge : surface.ridges)
    if (ridge.second.is_feature && dim == 3)
      for (const unsigned int node : ridge.first)
        chains[node].push_back(ridge.first);
}

/// Return the edge that continues @p edge smoothly behind @p node, or null if there is none.
template <int dim>
const std::vector<unsigned int> *CurvedBoundary<dim>::next(const Corners     &edge,
                                                           const unsigned int node) const
{
  const auto &at = chains.at(node);
  if (at.size() != 2)
    return nullptr;
  const Corners &result = at[at[0] == edge ? 1 : 0];
  if (dim == 2)
    return surface.ridges.at({node}).is_feature ? nullptr : &result;
  const Vector a = surface.points[node] - surface.points[other(edge, node)];
  const Vector b = surface.points[other(result, node)] - surface.points[node];
  return a * b > std::cos(M_PI / 6.) * a.norm() * b.norm() ? &result : nullptr;
}

template <int dim>
std::vector<unsigned int> CurvedBoundary<dim>::facets_of(const Corners &edge) const
{
  if (dim == 3)
    {
      const auto found = surface.ridges.find(edge);
      return found == surface.ridges.end() ? Corners() : found->second.facets;
    }
  const auto at = surface.facets_at.find(edge[0]);
  if (at != surface.facets_at.end())
    for (const unsigned int f : at->second)
      if (sorted(surface.facets[f].corners) == edge)
        return {f};
  return {};
}

/// Return whether all facets at @p edge are plane.
template <int dim>
bool CurvedBoundary<dim>::is_straight(const Corners &edge) const
{
  const auto at = facets_of(edge);
  return std::all_of(at.begin(), at.end(), [&](const unsigned int f) {
    return surface.is_flat[f] || shapes.of_facet(f).kind == Kind::plane;
  });
}

/// Return the next nodes of the chain behind @p node along @p edge, at most 3 and up to a plane
/// region.
template <int dim>
std::vector<dealii::Point<dim>> CurvedBoundary<dim>::walk(const Corners *edge,
                                                          unsigned int   node) const
{
  std::vector<Point> result;
  while (edge != nullptr && result.size() < 3 && !is_straight(*edge))
    {
      node = other(*edge, node);
      result.push_back(surface.points[node]);
      edge = next(*edge, node);
    }
  return result;
}

/// Return the unit tangent of the chain at @p node, along @p edge.
template <int dim>
dealii::Tensor<1, dim> CurvedBoundary<dim>::tangent(const Corners     &edge,
                                                    const unsigned int node) const
{
  const Point   &x    = surface.points[node];
  const Corners *back = next(edge, node);
  if (back != nullptr && is_straight(*back))
    return (x - surface.points[other(*back, node)]) /
           x.distance(surface.points[other(*back, node)]);
  if (is_straight(edge))
    return (surface.points[other(edge, node)] - x) / x.distance(surface.points[other(edge, node)]);
  return curve_tangent(walk(back, node), x, walk(&edge, node));
}

/// Return the unit normal of a smooth part at a node, or 0 at the tip of a cone.
template <int dim>
dealii::Tensor<1, dim> CurvedBoundary<dim>::normal(const unsigned int part, const unsigned int node)
{
  const auto entry = normals.emplace(std::make_pair(part, node), Vector());
  Vector    &n     = entry.first->second;
  if (!entry.second)
    return n;
  Vector                 mean;
  std::set<unsigned int> near, nodes;
  for (const unsigned int f : surface.facets_at.at(node))
    if (surface.part_of[f] == part)
      {
        mean += surface.normal(f);
        if (surface.is_flat[f])
          n += surface.normal(f);
        near.insert(surface.facets[f].corners.begin(), surface.facets[f].corners.end());
      }
  if (n.norm() > 0.)
    return n /= n.norm();
  mean /= mean.norm();
  // There is no normal at the tip of a cone, where edges begin straight.
  for (const unsigned int f : surface.facets_at.at(node))
    if (surface.part_of[f] == part && surface.normal(f) * mean < std::cos(M_PI / 6.))
      return n;
  for (const unsigned int k : near)
    for (const unsigned int f : surface.facets_at.at(k))
      if (surface.part_of[f] == part && !surface.is_flat[f])
        nodes.insert(surface.facets[f].corners.begin(), surface.facets[f].corners.end());
  nodes.erase(node);
  std::vector<Point> neighbours;
  for (const unsigned int k : nodes)
    neighbours.push_back(surface.points[k]);
  if constexpr (dim == 3)
    n = surface_normal(surface.points[node], neighbours, mean);
  return n;
}

template <int dim>
std::array<dealii::Tensor<1, dim>, 2>
CurvedBoundary<dim>::coefficients(const Corners                            &edge,
                                  const geometry::GeometryConstraints<dim> &constraints)
{
  const auto at = facets_of(edge);
  if (constraints.first)
    return surface.quadratic(edge);
  const auto has = [&](const Kind kind) {
    return std::any_of(at.begin(), at.end(),
                       [&](const unsigned int f) { return shapes.of_facet(f).kind == kind; });
  };
  const bool smooth = has(Kind::smooth), known = has(Kind::known);
  if (!smooth && !known)
    return surface.quadratic(edge);
  if (!known && is_straight(edge))
    return {};
  // Within one shape, straight edges are projected on the shape.
  if (constraints.surfaces.size() == 1 && constraints.planes.empty() && !smooth &&
      !has(Kind::quadratic))
    return {};
  const Vector chord = surface.points[edge[1]] - surface.points[edge[0]];
  const bool   within =
    dim == 3 && at.size() == 2 && surface.part_of[at[0]] == surface.part_of[at[1]];
  std::array<Vector, 2> t;
  for (unsigned int i = 0; i < 2; ++i)
    if (within)
      {
        const Vector n = normal(surface.part_of[at[0]], edge[i]);
        t[i]           = chord - (chord * n) * n;
        t[i] /= t[i].norm();
      }
    else
      t[i] = (i == 0 ? 1. : -1.) * tangent(edge, edge[i]);
  auto c = cubic<dim>(chord, t[0], t[1]);
  for (auto &own : c)
    for (const auto &n : constraints.planes)
      own -= (own * n) * n;
  return c;
}

template <int dim>
void CurvedBoundary<dim>::add_curve(const Corners &edge)
{
  const auto at = facets_of(edge);
  // All edges of facets are straight, also next to other shapes.
  for (const unsigned int f : at)
    if (shapes.of_facet(f).kind == Kind::facets)
      return;
  const Point &a = surface.points[edge[0]], &b = surface.points[edge[1]];
  auto         on    = shapes.constraints(at);
  const auto   found = surface.middles.find(edge);
  const Point  middle =
    found == surface.middles.end() ? Point(0.5 * (a + b)) : surface.points[found->second];
  on.first     = shapes.projection(at, middle);
  const auto c = coefficients(edge, on);
  // The edge is straight up to rounding.
  if (!on.first && on.surfaces.empty() &&
      std::max(c[0].norm(), c[1].norm()) < 1e-12 * a.distance(b))
    return;
  curves[edge] = std::make_shared<geometry::Curve<dim>>(a, b, c, on);
}

template <>
std::shared_ptr<geometry::Patch<2>> CurvedBoundary<2>::patch(const unsigned int facet) const
{
  const auto found = curves.find(sorted(surface.facets[facet].corners));
  return found == curves.end() ? nullptr : found->second;
}

template <>
std::shared_ptr<geometry::Patch<3>> CurvedBoundary<3>::patch(const unsigned int facet) const
{
  const auto &shape   = shapes.of_facet(facet);
  const auto &corners = surface.facets[facet].corners;
  const auto  result  = std::make_shared<geometry::FacetPatch>();
  bool        curved  = shape.kind == Kind::known || shape.kind == Kind::exact;
  for (unsigned int i = 0; i < corners.size(); ++i)
    {
      result->corners.push_back(surface.points[corners[i]]);
      const Corners edge  = sorted({corners[i], corners[(i + 1) % corners.size()]});
      const auto    found = curves.find(edge);
      result->sides.emplace_back();
      if (found == curves.end())
        continue;
      result->sides.back() = {found->second, edge[0] != corners[i]};
      curved               = true;
    }
  if (shape.kind == Kind::known)
    result->surface =
      std::make_shared<geometry::KnownSurface<3>>(shapes.known()[shape.known_index]);
  else if (shape.kind == Kind::exact)
    result->surface = shape.projection;
  const auto middle = surface.middles.find(sorted(corners));
  if (corners.size() == 4 && middle != surface.middles.end() &&
      (shape.kind == Kind::quadratic || shape.kind == Kind::plane))
    {
      const auto bubble =
        surface.points[middle->second] - result->position(dealii::Point<2>(0.5, 0.5));
      if (bubble.norm() > 1e-12 * result->corners[0].distance(result->corners[2]))
        {
          result->bubble = bubble;
          curved         = true;
        }
    }
  return curved ? result : nullptr;
}

template <>
bool CurvedBoundary<2>::is_on_known(const unsigned int facet) const
{
  return shapes.of_facet(facet).kind == Kind::known && patches[facet] &&
         patches[facet]->scale == 1.;
}

template <>
bool CurvedBoundary<3>::is_on_known(const unsigned int facet) const
{
  if (shapes.of_facet(facet).kind != Kind::known || patches[facet]->scale != 1.)
    return false;
  // Edges may be off the surface where a neighbour is faceted or touches at a small angle.
  const auto &patch = dynamic_cast<const geometry::FacetPatch &>(*patches[facet]);
  const auto &known = shapes.known()[shapes.of_facet(facet).known_index];
  return patch.gap() <= 1e-12 * patch.corners[0].distance(known.centre);
}

template class CurvedBoundary<2>;
template class CurvedBoundary<3>;
} // namespace snug::mesh_file
