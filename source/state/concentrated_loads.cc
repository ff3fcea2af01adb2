#include <snug/base/errors.h>
#include <snug/state/boundary_point.h>
#include <snug/state/concentrated_loads.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace snug::state {
namespace {
/// Pieces of a line per smallest face, and their maximum number.
const double       pieces_per_face = 8.;
const unsigned int most_pieces     = 20000;

/// Return xi' with sum_a (xi' . grad N_a) X_a = d for the projection d of @p along into the face.
dealii::Tensor<1, 2> coordinates_of(const std::array<dealii::Tensor<1, 3>, 2> &t,
                                    const dealii::Tensor<1, 3>                &along)
{
  dealii::Tensor<2, 2> gram;
  dealii::Tensor<1, 2> products;
  for (unsigned int i = 0; i < 2; ++i)
    {
      products[i] = t[i] * along;
      for (unsigned int j = 0; j < 2; ++j)
        gram[i][j] = t[i] * t[j];
    }
  return invert(gram) * products;
}
} // namespace

/// This class holds all faces of one boundary on each rank, and knows which of them belong to the
/// rank.
template <int dim>
class ConcentratedLoads<dim>::LoadedBoundary
{
public:
  LoadedBoundary(const mesh::BodyMesh<dim>   &mesh,
                 const faces::FaceShape<dim> &shape,
                 const Boundary              &boundary)
    : surface(mesh, {boundary})
    , shape(shape)
    , own_face(surface.faces().size(), -1)
    , all(own_face.size())
  {
    std::map<std::vector<unsigned int>, unsigned int> of_nodes;
    for (unsigned int f = 0; f < all.size(); ++f)
      of_nodes[surface.faces()[f].nodes] = f;
    for (unsigned int f = 0; f < mesh.boundary_faces().size(); ++f)
      if (const auto &face = mesh.boundary_faces()[f];
          face.body == boundary.first && face.boundary == boundary.second)
        {
          std::vector<unsigned int> nodes;
          for (const unsigned int node : face.nodes)
            nodes.push_back(surface.find(mesh.global_node(node)));
          own_face[of_nodes.at(nodes)] = static_cast<int>(f);
        }
    std::iota(all.begin(), all.end(), 0);
    search = std::make_unique<contact::NearestFace<dim>>(surface, all, shape,
                                                         surface.reference_positions());
  }

  /// Return the diagonal of a face [length].
  double size(const unsigned int face) const
  {
    const auto &nodes = surface.faces()[face].nodes;
    const auto &x     = surface.reference_positions();
    return (x[nodes.back()] - x[nodes.front()]).norm();
  }

  /// Return the minimum diagonal of the faces [length].
  double smallest_size() const
  {
    double smallest = size(0);
    for (const unsigned int face : all)
      smallest = std::min(smallest, size(face));
    return smallest;
  }

  /// Return the face closest to @p x and the coordinates there. @throws InputError if @p x is not
  /// on the boundary.
  typename contact::NearestFace<dim>::Found at(const dealii::Point<dim> &x,
                                               const PlacedForce<dim>   &placed) const
  {
    return face_at(surface, *search, x, placed.entry);
  }

  const mesh::Surface<dim>     surface;
  const faces::FaceShape<dim> &shape;
  std::vector<int>             own_face; ///< index among the faces of this rank, or -1
  std::vector<unsigned int>    all;
  std::unique_ptr<const contact::NearestFace<dim>> search;
};

template <int dim>
ConcentratedLoads<dim>::ConcentratedLoads(const mesh::BodyMesh<dim>        &mesh,
                                          const std::vector<LoadCase<dim>> &load_cases)
  : mesh(mesh), shape(mesh.degree()), forces(load_cases.size())
{
  std::map<Boundary, std::unique_ptr<LoadedBoundary>> loaded;
  for (unsigned int c = 0; c < load_cases.size(); ++c)
    for (unsigned int body = 0; body < load_cases[c].bodies.size(); ++body)
      for (const auto &[boundary, load] : load_cases[c].bodies[body].boundaries)
        for (const auto &placed : load.concentrated)
          {
            auto &loaded_boundary = loaded[{body, boundary}];
            if (!loaded_boundary)
              loaded_boundary =
                std::make_unique<LoadedBoundary>(mesh, shape, Boundary(body, boundary));
            add(placed, c, *loaded_boundary);
          }
}

template <int dim>
const typename ConcentratedLoads<dim>::Forces &
ConcentratedLoads<dim>::on_face(const unsigned int load_case, const unsigned int face) const
{
  static const Forces none;
  const auto          found = forces[load_case].find(face);
  return found == forces[load_case].end() ? none : found->second;
}

namespace {
/// Return the nodes of the coarsest edge that contains the edge with @p nodes: masters stand for
/// hanging nodes.
template <int dim>
std::set<unsigned int> whole_edge(const mesh::Surface<dim>        &surface,
                                  const std::vector<unsigned int> &nodes)
{
  std::set<unsigned int> result;
  for (const unsigned int node : nodes)
    {
      if (surface.masters(node).empty())
        result.insert(surface.global_node(node));
      for (const auto &master : surface.masters(node))
        result.insert(surface.global_node(master.first));
    }
  return result;
}

/// Call visit(face, side, nodes) for each edge of the faces of a surface. Side s of axis d is 2d +
/// s.
template <typename Visit>
void for_each_edge(const mesh::Surface<3>    &surface,
                   const faces::FaceShape<3> &shape,
                   const Visit               &visit)
{
  for (unsigned int face = 0; face < surface.faces().size(); ++face)
    for (unsigned int side = 0; side < 4; ++side)
      {
        std::vector<unsigned int> nodes;
        for (unsigned int a = 0; a < shape.n_nodes(); ++a)
          if (shape.node(a)[side / 2] == side % 2)
            nodes.push_back(surface.faces()[face].nodes[a]);
        visit(face, side, nodes);
      }
}

/// Return the forces along the common edge of two surfaces, by face of the first one.
std::vector<std::pair<unsigned int, elasticity::ConcentratedForce<3>>>
forces_along_edge(const mesh::Surface<3>    &surface,
                  const mesh::Surface<3>    &other,
                  const faces::FaceShape<3> &shape,
                  const PlacedForce<3>      &placed)
{
  std::set<std::set<unsigned int>> edges;
  for_each_edge(other, shape, [&](unsigned int, unsigned int, const auto &nodes) {
    edges.insert(whole_edge<3>(other, nodes));
  });
  std::vector<std::pair<unsigned int, elasticity::ConcentratedForce<3>>> result;
  for_each_edge(surface, shape, [&](unsigned int face, unsigned int side, const auto &nodes) {
    if (edges.count(whole_edge<3>(surface, nodes)) == 0)
      return;
    for (const auto &point : mesh::lagrange_gauss_points<1>(shape.degree()))
      {
        dealii::Point<2> xi;
        xi[side / 2]     = side % 2;
        xi[1 - side / 2] = point.point[0];
        dealii::Tensor<1, 2> piece;
        piece[1 - side / 2] = point.weight;
        result.emplace_back(face,
                            elasticity::ConcentratedForce<3>{shape.at(xi), placed.force, piece});
      }
  });
  if (result.empty())
    throw bad_entry(placed.entry.first, placed.entry.second, "the boundaries have no common edge");
  return result;
}
} // namespace

template <int dim>
void ConcentratedLoads<dim>::add(const PlacedForce<dim> &placed,
                                 const unsigned int      load_case,
                                 const LoadedBoundary   &boundary)
{
  const auto add_to_face = [&](const unsigned int face, const Force &force) {
    if (boundary.own_face[face] >= 0)
      forces[load_case][static_cast<unsigned int>(boundary.own_face[face])].push_back(force);
  };
  if constexpr (dim == 3)
    {
      if (placed.along)
        {
          const unsigned int       body = boundary.surface.faces().front().body;
          const mesh::Surface<dim> other(mesh, {{body, *placed.along}});
          for (const auto &[face, force] :
               forces_along_edge(boundary.surface, other, shape, placed))
            add_to_face(face, force);
          return;
        }
      if (placed.to)
        {
          const auto   line   = *placed.to - placed.from;
          const double most   = most_pieces;
          const double wanted = pieces_per_face * line.norm() / boundary.smallest_size();
          const auto   n      = static_cast<unsigned int>(std::ceil(std::min(wanted, most)));
          for (unsigned int i = 0; i < n; ++i)
            {
              const auto nearest = boundary.at(placed.from + (i + 0.5) / n * line, placed);
              const auto values  = shape.at(nearest.point.xi);
              const auto t =
                faces::tangents<dim>(values, boundary.surface.faces()[nearest.face].nodes,
                                     boundary.surface.reference_positions());
              add_to_face(nearest.face,
                          {values, placed.force, coordinates_of(t, line / double(n))});
            }
          return;
        }
    }
  const auto nearest = boundary.at(placed.from, placed);
  add_to_face(nearest.face, {shape.at(nearest.point.xi), placed.force});
}

template class ConcentratedLoads<2>;
template class ConcentratedLoads<3>;
} // namespace snug::state
