#include <snug/accuracy/sharp_edges.h>
#include <snug/base/gather.h>
#include <snug/contact/pair_geometry.h>
#include <snug/faces/nodal_normals.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace snug::accuracy {
namespace {
/// Cosines of the angle between the normals of two faces. Above smooth_cosine there is no edge
/// between them. Below right_angle_cosine the interior angle of the edge is at most a right angle.
constexpr double smooth_cosine = 0.8, right_angle_cosine = 0.05;
/// An edge is under pressure if its pressure is above this multiple of the mean. The multiple is
/// below 1, because a coarse mesh does not show the growth of the pressure, and rows at the edge
/// of a master have areas that extend beyond the edge.
constexpr double pressing = 0.5;
/// A slave node is at an edge if a node of the edge is closer than this multiple of its face size.
constexpr double near_edge = 0.6;

/// A face beside a side, at a node that they share.
template <int dim>
struct FaceBeside
{
  unsigned int           node;            ///< node of the surface
  dealii::Tensor<1, dim> normal, inwards; ///< unit normal; from the node to the middle of the face

  template <typename Archive>
  void serialize(Archive &archive, const unsigned int /*version*/)
  {
    archive & node;
    archive & normal;
    archive & inwards;
  }
};

/// This class finds the edges of contact sides at the positions of a state.
template <int dim>
class EdgeFinder
{
public:
  EdgeFinder(const state::StateSolver<dim> &solver, const state::ContactState<dim> &state)
    : solver(solver)
    , surface(solver.surface())
    , shape(solver.mesh().degree())
    , local(state.positions)
    , x(state.surface_positions)
  {}

  /// Return the surface nodes of the sharp edges of a side. @p is_mirrored states that the other
  /// side is an obstacle, which acts as a plane of symmetry. Collective.
  std::vector<unsigned int> nodes(const contact::Side &side, const bool is_mirrored) const
  {
    const faces::NodalNormals<dim> normals(surface, contact::faces_of(surface, side), shape, x);
    std::vector<unsigned int>      result;
    for (const auto &of_rank : all_gather(solver.mesh().communicator(), faces_beside(side)))
      for (const auto &face : of_rank)
        {
          const auto  &own    = normals.normals()[face.node];
          const double cosine = own * face.normal;
          if (cosine < smooth_cosine && !(is_mirrored && cosine < right_angle_cosine) &&
              own * face.inwards < 0.) // otherwise the edge is concave
            result.push_back(face.node);
        }
    return result;
  }

  const typename mesh::Surface<dim>::Field &positions() const { return x; }

private:
  const state::StateSolver<dim>           &solver;
  const mesh::Surface<dim>                &surface;
  const faces::FaceShape<dim>              shape;
  const mesh::Field<dim>                  &local;
  const typename mesh::Surface<dim>::Field x;

  /// Return the faces of this rank beside a side.
  std::vector<FaceBeside<dim>> faces_beside(const contact::Side &side) const
  {
    const auto       &mesh = solver.mesh();
    std::vector<bool> is_on_side(surface.n_nodes(), false);
    for (const unsigned int face : contact::faces_of(surface, side))
      for (const unsigned int node : surface.faces()[face].nodes)
        is_on_side[node] = true;
    std::vector<FaceBeside<dim>> result;
    for (const auto &face : mesh.boundary_faces())
      if (face.body == side.body() && !contact::is_on(face, side))
        {
          const auto normal = normal_of(face);
          if (goes_on(face, normal))
            continue;
          dealii::Tensor<1, dim> middle;
          for (const unsigned int node : face.nodes)
            middle += local[node] / (1. * face.nodes.size());
          for (const unsigned int node : face.nodes)
            if (const unsigned int found = surface.find(mesh.global_node(node));
                found < surface.n_nodes() && is_on_side[found])
              result.push_back({found, normal, middle - local[node]});
        }
    return result;
  }

  dealii::Tensor<1, dim> normal_of(const typename mesh::BodyMesh<dim>::Face &face) const
  {
    const unsigned int           p = solver.mesh().degree(), n = face.nodes.size();
    const dealii::Tensor<1, dim> t1 = local[face.nodes[p]] - local[face.nodes[0]];
    dealii::Tensor<1, dim>       normal;
    if constexpr (dim == 2)
      normal = dealii::Point<dim>(t1[1], -t1[0]);
    else
      normal = dealii::cross_product_3d(t1, local[face.nodes[n - p - 1]] - local[face.nodes[0]]);
    return normal / normal.norm();
  }

  /// Return whether a face is on a plane of symmetry or on the axis, beyond which the body
  /// continues.
  bool goes_on(const typename mesh::BodyMesh<dim>::Face &face,
               const dealii::Tensor<1, dim>             &normal) const
  {
    const auto &supports = solver.model().supports;
    return (solver.mesh().idealization().is_axisymmetric() && normal[0] < -0.9) ||
           std::any_of(supports.begin(), supports.end(), [&](const auto &support) {
             return support.body == face.body && support.boundary == face.boundary &&
                    std::abs(normal * support.component.direction(local[face.nodes[0]], normal)) >
                      0.9;
           });
  }
};

/// The active rows of a joined pair.
template <int dim>
struct PairRows
{
  std::vector<unsigned int> rows;
  double                    mean = 0.; ///< mean of their pressure
};

template <int dim>
PairRows<dim> rows_of(const unsigned int              pair,
                      const state::StateSolver<dim>  &solver,
                      const state::ContactState<dim> &state)
{
  PairRows<dim> result;
  double        force = 0., area = 0.;
  const auto   &places = solver.contact(state.load_case).places();
  for (unsigned int i = 0; i < places.size(); ++i)
    if (const auto &point = state.contact[i]; places[i].pair == pair && point.active)
      {
        result.rows.push_back(i);
        force += point.force;
        area += point.area;
      }
  result.mean = area > 0. ? force / area : 0.;
  return result;
}
} // namespace

template <int dim>
std::vector<SharpEdge> sharp_edges(const state::StateSolver<dim>  &solver,
                                   const state::ContactState<dim> &state)
{
  const EdgeFinder<dim>  finder(solver, state);
  const auto            &contact = solver.contact(state.load_case);
  const auto             x       = contact.placed_surface().to_space(finder.positions());
  const auto             sizes   = contact::node_face_sizes(solver.surface(), x);
  const auto            &joined  = contact.joined_pairs();
  std::vector<SharpEdge> result;
  for (unsigned int p = 0; p < joined.size(); ++p)
    {
      const auto &pair        = joined[p].pair;
      const auto  of          = rows_of(p, solver, state);
      const auto  slave_nodes = finder.nodes(pair.slave, pair.obstacle.has_value());
      const std::vector<unsigned int> master_nodes =
        pair.obstacle ? std::vector<unsigned int>() : finder.nodes(pair.master, false);
      std::vector<unsigned int> at_slave_edge, at_master_edge;
      double                    largest  = pressing * of.mean;
      bool                      of_slave = false;
      for (const unsigned int row : of.rows)
        {
          const unsigned int node       = contact.places()[row].slave;
          const auto         is_at_edge = [&](const std::vector<unsigned int> &edge) {
            return std::any_of(edge.begin(), edge.end(), [&](const unsigned int other) {
              return (x[node] - x[other]).norm() <= near_edge * sizes[node];
            });
          };
          const bool at_slave = is_at_edge(slave_nodes), at_master = is_at_edge(master_nodes);
          if (at_slave == at_master) // both sides end at the edge, as one body would
            continue;
          (at_slave ? at_slave_edge : at_master_edge).push_back(row);
          if (state.contact[row].pressure > largest)
            {
              largest  = state.contact[row].pressure;
              of_slave = at_slave;
            }
        }
      if (largest > pressing * of.mean)
        result.push_back({p, of_slave ? at_slave_edge : at_master_edge,
                          "the pressure of '" + pair.name() + "' at a sharp edge of " +
                            (of_slave ? pair.slave_name : pair.master_name) +
                            " is unbounded under mesh refinement"});
    }
  return result;
}

template std::vector<SharpEdge> sharp_edges(const state::StateSolver<2> &,
                                            const state::ContactState<2> &);
template std::vector<SharpEdge> sharp_edges(const state::StateSolver<3> &,
                                            const state::ContactState<3> &);
} // namespace snug::accuracy
