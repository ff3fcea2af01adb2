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

/// The faces of one boundary, replicated, with the faces of this rank among them.
template <int dim>
class ConcentratedLoads<dim>::Place
{
public:
  Place(const mesh::BodyMesh<dim> &mesh, const faces::FaceShape<dim> &shape, const Boundary &where)
    : surface(mesh, {where})
    , shape(shape)
    , own_face(surface.faces().size(), -1)
    , all(own_face.size())
  {
    std::map<std::vector<unsigned int>, unsigned int> of_nodes;
    for (unsigned int f = 0; f < all.size(); ++f)
      of_nodes[surface.faces()[f].nodes] = f;
    for (unsigned int f = 0; f < mesh.boundary_faces().size(); ++f)
      if (const auto &face = mesh.boundary_faces()[f];
          face.body == where.first && face.boundary == where.second)
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

  /// Return the smallest and this face's diagonal [length].
  double size(const unsigned int face) const
  {
    const auto &nodes = surface.faces()[face].nodes;
    const auto &x     = surface.reference_positions();
    return (x[nodes.back()] - x[nodes.front()]).norm();
  }
  double smallest_size() const
  {
    double smallest = size(0);
    for (const unsigned int face : all)
      smallest = std::min(smallest, size(face));
    return smallest;
  }

  typename contact::NearestFace<dim>::Found at(const dealii::Point<dim> &x,
                                               const PlacedForce<dim>   &given) const
  {
    return face_at(surface, *search, x, given.name);
  }

  const mesh::Surface<dim>                         surface;
  const faces::FaceShape<dim>                     &shape;
  std::vector<int>                                 own_face; ///< of this rank, or -1
  std::vector<unsigned int>                        all;
  std::unique_ptr<const contact::NearestFace<dim>> search;
};

template <int dim>
ConcentratedLoads<dim>::ConcentratedLoads(const mesh::BodyMesh<dim>        &mesh,
                                          const std::vector<LoadCase<dim>> &load_cases)
  : mesh(mesh), shape(mesh.degree()), forces(load_cases.size())
{
  std::map<Boundary, std::unique_ptr<Place>> places;
  for (unsigned int c = 0; c < load_cases.size(); ++c)
    for (unsigned int body = 0; body < load_cases[c].bodies.size(); ++body)
      for (const auto &[boundary, load] : load_cases[c].bodies[body].boundaries)
        for (const auto &given : load.concentrated)
          {
            auto &on = places[{body, boundary}];
            if (!on)
              on = std::make_unique<Place>(mesh, shape, Boundary(body, boundary));
            place(given, c, *on);
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
                  const PlacedForce<3>      &given)
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
                            elasticity::ConcentratedForce<3>{shape.at(xi), given.force, piece});
      }
  });
  if (result.empty())
    throw InputError(given.name + ": the boundaries have no common edge");
  return result;
}
} // namespace

template <int dim>
void ConcentratedLoads<dim>::place(const PlacedForce<dim> &given,
                                   const unsigned int      load_case,
                                   const Place            &on)
{
  const auto add = [&](const unsigned int face, const Force &force) {
    if (on.own_face[face] >= 0)
      forces[load_case][static_cast<unsigned int>(on.own_face[face])].push_back(force);
  };
  if constexpr (dim == 3)
    {
      if (given.along)
        {
          const unsigned int       body = on.surface.faces().front().body;
          const mesh::Surface<dim> other(mesh, {{body, *given.along}});
          for (const auto &[face, force] : forces_along_edge(on.surface, other, shape, given))
            add(face, force);
          return;
        }
      if (given.to)
        {
          const auto   line   = *given.to - given.from;
          const double most   = most_pieces;
          const double wanted = pieces_per_face * line.norm() / on.smallest_size();
          const auto   n      = static_cast<unsigned int>(std::ceil(std::min(wanted, most)));
          for (unsigned int i = 0; i < n; ++i)
            {
              const auto found  = on.at(given.from + (i + 0.5) / n * line, given);
              const auto values = shape.at(found.point.xi);
              const auto t      = faces::tangents<dim>(values, on.surface.faces()[found.face].nodes,
                                                       on.surface.reference_positions());
              add(found.face, {values, given.force, coordinates_of(t, line / double(n))});
            }
          return;
        }
    }
  const auto found = on.at(given.from, given);
  add(found.face, {shape.at(found.point.xi), given.force});
}

template class ConcentratedLoads<2>;
template class ConcentratedLoads<3>;
} // namespace snug::state
