#include <snug/geometry/block_quality.h>
#include <snug/mesh_file/curved_blocks.h>

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace snug::mesh_file {
namespace {
using Corners = std::vector<unsigned int>;
using geometry::sorted;

Corners corners_of(const MeshFile::Element &cell, const Corners &local)
{
  Corners result;
  for (const unsigned int corner : local)
    result.push_back(cell.corners[corner]);
  return result;
}

/// Return the edges of a face, each in ascending order; a line has one edge.
std::vector<Corners> edges_of(const Corners &face)
{
  std::vector<Corners> result;
  for (unsigned int i = 0; i < (face.size() == 2 ? 1 : face.size()); ++i)
    result.push_back(sorted({face[i], face[(i + 1) % face.size()]}));
  return result;
}

/// This class adds pieces to a mesh, and moves the middles of split elements.
template <int dim>
class Curving
{
public:
  Curving(geometry::BlockMesh<dim>  &mesh,
          const SplitCells          &cells,
          const BodySurface<dim>    &surface,
          const CurvedBoundary<dim> &boundary)
    : mesh(mesh), cells(cells), surface(surface), boundary(boundary)
  {
    std::vector<bool> is_end(surface.points.size(), false);
    for (const auto &curve : boundary.curves)
      for (const unsigned int end : curve.first)
        is_end[end] = true;
    for (const auto &cell : cells.cells)
      if (std::any_of(cell.corners.begin(), cell.corners.end(),
                      [&](const unsigned int corner) { return is_end[corner]; }))
        near.push_back(&cell);
  }

  void add_pieces()
  {
    for (const auto &curve : boundary.curves)
      {
        const Corners &edge = curve.first;
        if (cells.split == nullptr)
          add(edge, curve.second, {{edge[0], {0., 0.}}, {edge[1], {1., 0.}}});
        else
          for (const unsigned int end : {0, 1})
            {
              const unsigned int middle = cells.split->middle(edge);
              add({edge[end], middle}, curve.second,
                  {{edge[end], {double(end), 0.}}, {middle, {0.5, 0.}}});
            }
      }
    for (unsigned int f = 0; f < surface.facets.size() && dim == 3; ++f)
      if (boundary.patches[f])
        add_facet(f);
  }

  /// Move the middles of split elements to the straight edges and facets or, if @p curved, to the
  /// true surface.
  void place_middles(const bool curved)
  {
    if (cells.split == nullptr)
      return;
    for (const MeshFile::Element *cell : near)
      {
        std::set<Corners> edges;
        for (const auto &local : faces_of(cell->shape))
          {
            const Corners face = corners_of(*cell, local);
            const auto    own  = edges_of(face);
            edges.insert(own.begin(), own.end());
            for (const Corners &edge : own)
              place(edge, {edge}, curved ? 1. : 0.);
            // These are the weights of the middle nodes of a quadratic element at its centre.
            if (dim == 3)
              place(face, {own.begin(), own.end()}, curved ? face.size() == 3 ? 4. / 9. : 0.5 : 0.);
          }
        place(cell->corners, edges,
              !curved                     ? 0.
              : dim == 3                  ? 0.25
              : cell->corners.size() == 3 ? 4. / 9.
                                          : 0.5);
      }
    if (curved)
      for (const auto &centre : centres)
        mesh.vertices[centre.first] = centre.second.first->position(centre.second.second);
  }

private:
  using Patch      = std::shared_ptr<geometry::Patch<dim>>;
  using Coordinate = std::map<unsigned int, dealii::Point<2>>;

  geometry::BlockMesh<dim>              &mesh;
  const SplitCells                      &cells;
  const BodySurface<dim>                &surface;
  const CurvedBoundary<dim>             &boundary;
  std::vector<const MeshFile::Element *> near; ///< all cells with curved edges, and some others
  /// middle of a curved facet -> patch and coordinates
  std::map<unsigned int, std::pair<Patch, dealii::Point<2>>> centres;

  void add(const Corners &vertices, const Patch &patch, const Coordinate &at)
  {
    typename geometry::BlockMesh<dim>::Piece piece{patch, {}};
    const Corners                            key = sorted(vertices);
    for (const unsigned int vertex : key)
      piece.at.push_back(at.at(vertex));
    // emplace() keeps existing pieces, because edges of a facet are already pieces of its curves.
    mesh.pieces.emplace(key, piece);
  }

  void add_facet(const unsigned int f)
  {
    const Corners    &corners = surface.facets[f].corners;
    const std::size_t n       = corners.size();
    Coordinate        at;
    dealii::Point<2>  centre;
    for (unsigned int i = 0; i < n; ++i)
      {
        const auto own = geometry::FacetPatch::corner(i, n);
        at[corners[i]] = own;
        centre += own / double(n);
        if (cells.split != nullptr)
          at[cells.split->middle({corners[i], corners[(i + 1) % n]})] =
            dealii::Point<2>(0.5 * (own + geometry::FacetPatch::corner((i + 1) % n, n)));
      }
    if (cells.split != nullptr)
      {
        const unsigned int middle = cells.split->middle(corners);
        at[middle]                = centre;
        centres[middle]           = {boundary.patches[f], centre};
      }
    const auto shape = n == 3 ? ElementShape::triangle : ElementShape::quadrilateral;
    for (const Corners &part : cells.parts({shape, corners, {}, 0, 0}))
      {
        add(part, boundary.patches[f], at);
        if (cells.split != nullptr)
          for (const unsigned int v : {1, 2}) // edge middles; vertex 3 is the centre
            add({part[v], part[3]}, boundary.patches[f], at);
      }
  }

  /// Place the middle of @p corners at their mean plus @p weight times the offsets of the edges.
  void place(const Corners &corners, const std::set<Corners> &edges, const double weight)
  {
    dealii::Point<dim> sum;
    for (const unsigned int corner : sorted(corners))
      sum += mesh.vertices[corner];
    sum /= double(corners.size());
    if (weight > 0.)
      for (const Corners &edge : edges)
        {
          const auto found = boundary.curves.find(edge);
          if (found != boundary.curves.end())
            sum += weight * found->second->offset(0.5);
        }
    mesh.vertices[cells.split->middle(corners)] = sum;
  }
};
/// Return points of the true surface: the middles of the curves at the boundary and of the facets.
template <int dim>
std::vector<dealii::Point<dim>> surface_points(const BodySurface<dim>    &surface,
                                               const CurvedBoundary<dim> &boundary)
{
  std::vector<dealii::Point<dim>> result;
  for (unsigned int f = 0; f < surface.facets.size(); ++f)
    {
      for (const Corners &edge : surface.edges(f))
        if (const auto found = boundary.curves.find(edge); found != boundary.curves.end())
          result.push_back(found->second->position({0.5, 0.}));
      if (dim == 3 && boundary.patches[f])
        result.push_back(boundary.patches[f]->position(surface.facets[f].corners.size() == 3
                                                         ? dealii::Point<2>(1. / 3., 1. / 3.)
                                                         : dealii::Point<2>(0.5, 0.5)));
    }
  return result;
}

/// Return the warning for the curves that were moved towards straight ones. Curves inside the body
/// do not change the surface.
template <int dim>
std::string straightening_warning(const std::size_t                      n_patches,
                                  const std::vector<dealii::Point<dim>> &before,
                                  const std::vector<dealii::Point<dim>> &after,
                                  const std::vector<dealii::Point<dim>> &vertices)
{
  double distance = 0., size = 0.;
  for (unsigned int i = 0; i < before.size(); ++i)
    distance = std::max(distance, before[i].distance(after[i]));
  for (const auto &vertex : vertices)
    size = std::max(size, vertex.distance(vertices.front()));
  std::ostringstream text;
  text
    << std::setprecision(2) << n_patches
    << " curved edges and faces were moved towards straight ones, because the cells beside these "
       "edges and faces would be too thin: maximum distance from the true surface "
    << distance << " (" << 100. * distance / size
    << " % of the size of the body); smaller elements keep the true surface";
  return text.str();
}
} // namespace

template <int dim>
void curve_blocks(geometry::BlockMesh<dim> &mesh,
                  const SplitCells         &cells,
                  const BodySurface<dim>   &surface,
                  const SurfaceShapes<dim> &shapes,
                  std::vector<std::string> &warnings)
{
  const CurvedBoundary<dim> boundary(surface, shapes);
  if (boundary.curves.empty())
    return;
  std::copy(surface.points.begin(), surface.points.end(), mesh.vertices.begin());
  Curving<dim> curving(mesh, cells, surface, boundary);
  curving.place_middles(false);
  std::map<unsigned int, double> least; ///< blocks with curves -> scaled Jacobian when straight
  curving.add_pieces();
  std::vector<bool> is_curved(mesh.vertices.size(), false);
  for (const auto &piece : mesh.pieces)
    for (const unsigned int vertex : piece.first)
      is_curved[vertex] = true;
  for (unsigned int b = 0; b < mesh.blocks.size(); ++b)
    if (std::count_if(mesh.blocks[b].begin(), mesh.blocks[b].end(),
                      [&](const unsigned int vertex) { return is_curved[vertex]; }) > 1)
      least[b] = geometry::least_scaled_jacobian<dim>(mesh.vertices, mesh.blocks[b], {});
  std::set<geometry::Patch<dim> *> straightened;
  curving.place_middles(true);
  const auto on_surface = surface_points(surface, boundary);
  // After 20 turns curves are straight up to a millionth of their initial offset.
  for (unsigned int turn = 0; turn < 20; ++turn)
    {
      std::set<geometry::Patch<dim> *> thin;
      for (const auto &block : least)
        if (geometry::least_scaled_jacobian(mesh.vertices, mesh.blocks[block.first], mesh.pieces) <
            0.2 * block.second)
          for (const Corners &part : geometry::edges_and_faces<dim>(mesh.blocks[block.first]))
            if (mesh.pieces.count(part) > 0)
              thin.insert(mesh.pieces.at(part).patch.get());
      if (thin.empty())
        break;
      for (const auto &patch : thin)
        patch->scale *= 0.5;
      straightened.insert(thin.begin(), thin.end());
      curving.place_middles(true);
    }
  if (!straightened.empty())
    warnings.push_back(straightening_warning<dim>(straightened.size(), on_surface,
                                                  surface_points(surface, boundary),
                                                  surface.points));
  mesh.known_surfaces = shapes.known();
  for (unsigned int f = 0; f < surface.facets.size(); ++f)
    if (boundary.is_on_known(f))
      {
        const auto &corners = surface.facets[f].corners;
        const auto  shape   = corners.size() == 2   ? ElementShape::line
                              : corners.size() == 3 ? ElementShape::triangle
                                                    : ElementShape::quadrilateral;
        for (const Corners &part : cells.parts({shape, corners, {}, 0, 0}))
          mesh.known[sorted(part)] = shapes.of_facet(f).known_index;
      }
}

template void curve_blocks(geometry::BlockMesh<2> &,
                           const SplitCells &,
                           const BodySurface<2> &,
                           const SurfaceShapes<2> &,
                           std::vector<std::string> &);
template void curve_blocks(geometry::BlockMesh<3> &,
                           const SplitCells &,
                           const BodySurface<3> &,
                           const SurfaceShapes<3> &,
                           std::vector<std::string> &);
} // namespace snug::mesh_file
