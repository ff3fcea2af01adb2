#include <snug/geometry/block_geometry.h>

#include <deal.II/base/array_view.h>

#include <deal.II/grid/manifold.h>

namespace snug::geometry {
namespace {
/// Return the vertices of an edge, from the lower to the upper end in the coordinates of the block.
template <int dim>
Vertices edge_of(const Vertices &block, unsigned int edge)
{
  using Info = dealii::GeometryInfo<dim>;
  return {block[Info::line_to_cell_vertices(edge, 0)], block[Info::line_to_cell_vertices(edge, 1)]};
}

/// Return the multilinear weights of the vertices of a cell at @p u.
/// Manifolds use the same weights, because get_new_point() computes a weighted mean of points.
template <int dim>
std::vector<double> weights(const dealii::Point<dim> &u)
{
  std::vector<double> result;
  result.reserve(1u << dim);
  for (unsigned int v = 0; v < dealii::GeometryInfo<dim>::vertices_per_cell; ++v)
    result.push_back(dealii::GeometryInfo<dim>::d_linear_shape_function(u, v));
  return result;
}

/// A point of the grids of blocks, given by vertices of a block and their weights. The weights are
/// multiplied by the numbers of cells of all axes at whose ends the point does not lie. All blocks
/// with the point have the same vertices and weights.
/// The weights are integers, so that they are compared without a tolerance. This comparison
/// requires the same number of cells along the axes that neighbours share.
using GridPoint = std::vector<std::pair<unsigned int, unsigned int>>;

template <int dim>
GridPoint grid_point(const Vertices                      &block,
                     const std::array<unsigned int, dim> &place,
                     const std::array<unsigned int, dim> &n)
{
  GridPoint result;
  for (unsigned int v = 0; v < block.size(); ++v)
    {
      // On a side of the block only the vertices of the side have nonzero weights.
      unsigned int weight = 1;
      for (unsigned int d = 0; d < dim; ++d)
        if (place[d] == 0 || place[d] == n[d])
          weight *= (place[d] == 0) == ((v >> d & 1) == 0);
        else
          weight *= (v >> d & 1) == 1 ? place[d] : n[d] - place[d];
      if (weight > 0)
        result.emplace_back(block[v], weight);
    }
  std::sort(result.begin(), result.end());
  return result;
}
} // namespace

template <int dim>
BlockGeometry<dim>::BlockGeometry(std::shared_ptr<const BlockMesh<dim>> block_mesh)
  : mesh(std::move(block_mesh))
  , is_curved(mesh->blocks.size(), false)
  , on_curve(mesh->vertices.size(), false)
  , bounds(bounds_of(*mesh))
{
  using Info = dealii::GeometryInfo<dim>;
  // Edges of curved faces are stored separately, because blocks that have only such an edge must
  // follow the edge as well. Otherwise the mesh would have gaps. An edge of two curved faces lies
  // on the surface that is found first, and the other face bends to the edge, see face_position().
  for (const Vertices &block : mesh->blocks)
    for (const unsigned int f : Info::face_indices())
      {
        if (mesh->surfaces.empty())
          break;
        const Vertices face  = face_of<dim>(block, f);
        const auto     found = mesh->boundaries.find(sorted(face));
        if (found == mesh->boundaries.end() || mesh->surfaces.count(found->second) == 0)
          continue;
        Manifold *surface    = mesh->surfaces.at(found->second).get();
        curved[sorted(face)] = surface;
        if (dim == 3)
          for (unsigned int e = 0; e < 4; ++e)
            curved.emplace(sorted(edge_of<2>(face, e)), surface);
      }
  for (const auto &entry : curved)
    for (const unsigned int vertex : entry.first)
      on_curve[vertex] = true;
  for (const auto &entry : mesh->pieces)
    for (const unsigned int vertex : entry.first)
      on_curve[vertex] = true;
  for (unsigned int b = 0; b < is_curved.size(); ++b)
    for (unsigned int e = 0; e < Info::lines_per_cell; ++e)
      {
        const Vertices edge = edge_of<dim>(mesh->blocks[b], e);
        if (may_curve(edge))
          is_curved[b] =
            is_curved[b] || curved.count(sorted(edge)) > 0 || mesh->pieces.count(sorted(edge)) > 0;
      }
}

template <int dim>
typename BodyGeometry<dim>::CoarseMesh BlockGeometry<dim>::coarse_mesh() const
{
  using Info = dealii::GeometryInfo<dim>;
  SNUG_ASSERT(this->has_all_cells(), "the mesh lacks blocks");
  typename BodyGeometry<dim>::CoarseMesh result;
  std::map<GridPoint, unsigned int>      numbers;
  const unsigned int                     none = static_cast<unsigned int>(-1);
  std::vector<unsigned int>              of_vertex(mesh->vertices.size(), none);
  std::vector<bool>                      at_boundary(mesh->vertices.size(), false);
  for (const auto &face : mesh->boundaries)
    for (const unsigned int vertex : face.first)
      at_boundary[vertex] = true;
  const auto &n = mesh->cells;
  for (unsigned int b = 0; b < mesh->blocks.size(); ++b)
    for (unsigned int c = 0; c < cells_per_block(); ++c)
      {
        const auto index = multi_index(c, n);
        Vertices   cell(Info::vertices_per_cell);
        for (unsigned int v = 0; v < cell.size(); ++v)
          {
            // Bit d of v is 1 at the upper end of axis d.
            auto  place = index;
            Point u;
            for (unsigned int d = 0; d < dim; ++d)
              {
                place[d] += v >> d & 1;
                u[d] = static_cast<double>(place[d]) / n[d];
              }
            const auto point = grid_point<dim>(mesh->blocks[b], place, n);
            // Most points of imported meshes are vertices of blocks.
            unsigned int &number = point.size() == 1 ? of_vertex[point[0].first]
                                                     : numbers.emplace(point, none).first->second;
            if (number == none)
              {
                // The first block sets the vertex, which is equal up to round-off in other blocks.
                number = result.vertices.size();
                result.vertices.push_back(block_position(b, u));
              }
            cell[v] = number;
          }
        result.cells.push_back(cell);
        for (const unsigned int f : Info::face_indices())
          // Only cells at this side of the block have boundary faces there.
          if (index[f / 2] == (f % 2 == 1 ? n[f / 2] - 1 : 0))
            {
              const auto face = face_of<dim>(mesh->blocks[b], f);
              if (!std::all_of(face.begin(), face.end(),
                               [&](const unsigned int vertex) { return at_boundary[vertex]; }))
                continue;
              const auto found = mesh->boundaries.find(sorted(face));
              if (found != mesh->boundaries.end())
                result.boundary_faces.emplace_back(face_of<dim>(cell, f), found->second);
            }
      }
  return result;
}

template <int dim>
unsigned int BlockGeometry<dim>::known_surface(const unsigned int coarse_cell,
                                               const unsigned int face) const
{
  const auto         index   = multi_index(coarse_cell % cells_per_block(), mesh->cells);
  const unsigned int d       = face / 2;
  const Vertices    &block   = mesh->blocks[block_of(coarse_cell)];
  const auto         found   = mesh->known.find(sorted(face_of<dim>(block, face)));
  const bool         at_side = index[d] == (face % 2 == 1 ? mesh->cells[d] - 1 : 0);
  return at_side && found != mesh->known.end() ? found->second : this->no_surface;
}

template <int dim>
dealii::Point<dim> BlockGeometry<dim>::position(const MeshPoint<dim> &point) const
{
  const auto index = multi_index(point.cell % cells_per_block(), mesh->cells);
  Point      u;
  for (unsigned int d = 0; d < dim; ++d)
    u[d] = (index[d] + point.unit[d]) / mesh->cells[d];
  return block_position(block_of(point.cell), u);
}

template <int dim>
dealii::Point<dim> BlockGeometry<dim>::interpolated(const Vertices            &vertices,
                                                    const std::vector<double> &weights,
                                                    Manifold                  *manifold) const
{
  Point result;
  if (manifold == nullptr)
    {
      for (unsigned int i = 0; i < vertices.size(); ++i)
        result += weights[i] * mesh->vertices[vertices[i]];
      return result;
    }
  std::vector<Point> points;
  for (const unsigned int vertex : vertices)
    points.push_back(mesh->vertices[vertex]);
  return manifold->get_new_point(dealii::make_array_view(points), dealii::make_array_view(weights));
}

template <int dim>
std::unique_ptr<dealii::Point<dim>>
BlockGeometry<dim>::piece_position(const Vertices            &vertices,
                                   const std::vector<double> &weights) const
{
  if (!may_curve(vertices))
    return nullptr;
  const Vertices key   = sorted(vertices);
  const auto     found = mesh->pieces.find(key);
  if (found == mesh->pieces.end())
    return nullptr;
  dealii::Point<2> at;
  for (unsigned int i = 0; i < key.size(); ++i)
    at += weights[std::find(vertices.begin(), vertices.end(), key[i]) - vertices.begin()] *
          found->second.at[i];
  return std::make_unique<Point>(found->second.patch->position(at));
}

/// The coordinate t increases from the first to the second vertex.
template <int dim>
dealii::Point<dim> BlockGeometry<dim>::edge_position(const Vertices &vertices, double t) const
{
  if (const auto x = piece_position(vertices, {1. - t, t}))
    return *x;
  const auto found = may_curve(vertices) ? curved.find(sorted(vertices)) : curved.end();
  return interpolated(vertices, {1. - t, t}, found == curved.end() ? nullptr : found->second);
}

template <int dim>
dealii::Point<dim> BlockGeometry<dim>::face_position(const Vertices         &vertices,
                                                     const dealii::Point<2> &u) const
{
  if (const auto x = piece_position(vertices, weights<2>(u)))
    return *x;
  const auto found = may_curve(vertices) ? curved.find(sorted(vertices)) : curved.end();
  Manifold  *own   = found == curved.end() ? nullptr : found->second;
  // In a Coons patch each vertex is counted by two edges, so the bilinear interpolation of the
  // vertices is subtracted once. A face on a surface of its own starts from this surface instead.
  Point result = (own == nullptr ? -1. : 1.) * interpolated(vertices, weights<2>(u), own);
  for (unsigned int e = 0; e < 4; ++e)
    {
      // Edges 0 and 1 of a face are parallel to the second tangent, edges 2 and 3 to the first.
      const unsigned int normal = e / 2;
      const double       w = e % 2 == 1 ? u[normal] : 1. - u[normal], t = u[1 - normal];
      const Vertices     edge = edge_of<2>(vertices, e);
      if (own == nullptr)
        result += w * edge_position(edge, t);
      else if (curved.at(sorted(edge)) != own)
        // The edge lies on the surface of another boundary. The face is corrected by the
        // difference, so that the face meets blocks that have only the edge.
        result += w * (edge_position(edge, t) - interpolated(edge, {1. - t, t}, own));
    }
  return result;
}

// BlockGeometry states the formula.
template <>
dealii::Point<2> BlockGeometry<2>::block_position(unsigned int            block,
                                                  const dealii::Point<2> &u) const
{
  const Vertices &vertices = mesh->blocks[block];
  // Spherical shells set inside, in which layers are spheres and radii are straight.
  if (mesh->inside || !is_curved[block])
    return interpolated(vertices, weights<2>(u), mesh->inside.get());
  return face_position(vertices, u);
}

template <>
dealii::Point<3> BlockGeometry<3>::block_position(unsigned int            block,
                                                  const dealii::Point<3> &u) const
{
  const Vertices &vertices = mesh->blocks[block];
  if (mesh->inside || !is_curved[block])
    return interpolated(vertices, weights<3>(u), mesh->inside.get());
  const auto on_face = [&](unsigned int f) {
    // The tangents of the faces of deal.II are y z, z x, x y.
    const dealii::Point<2> t(u[(f / 2 + 1) % 3], u[(f / 2 + 2) % 3]);
    return face_position(face_of<3>(vertices, f), t);
  };
  // Most evaluated points lie on faces, where a single face gives the same result as the full sum.
  for (unsigned int f = 0; f < 6; ++f)
    if (u[f / 2] == f % 2)
      return on_face(f);
  // The sum over faces counts edges twice. After subtraction of the edges, vertices are not counted
  // at all, so the vertices are added: x = faces - edges + vertices.
  const auto side   = [&](unsigned int d, unsigned int s) { return s == 1 ? u[d] : 1. - u[d]; };
  Point      result = interpolated(vertices, weights<3>(u), nullptr);
  for (unsigned int f = 0; f < 6; ++f)
    result += side(f / 2, f % 2) * on_face(f);
  for (unsigned int d = 0; d < 3; ++d)
    for (unsigned int k = 0; k < 4; ++k)
      {
        const unsigned int a = (d + 1) % 3, b = (d + 2) % 3;
        // first is the lower end of the edge along axis d; the upper end has bit d set.
        const unsigned int first = (k & 1) << a | (k >> 1) << b;
        result -= side(a, k & 1) * side(b, k >> 1) *
                  edge_position({vertices[first], vertices[first | 1 << d]}, u[d]);
      }
  return result;
}

template class BlockGeometry<2>;
template class BlockGeometry<3>;
} // namespace snug::geometry
