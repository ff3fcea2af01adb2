#include <snug/accuracy/contact_pressure.h>
#include <snug/base/assertions.h>
#include <snug/contact/nearest_face.h>
#include <snug/contact/projection.h>
#include <snug/faces/outer_edges.h>

namespace snug::accuracy {
/// Nodal pressures of one pair and, for its master side, the geometry of the slave side.
template <int dim>
class ContactPressure<dim>::SlaveSide
{
public:
  SlaveSide(const mesh::Surface<dim>                 &surface,
            const contact::Pair                      &pair,
            const typename mesh::Surface<dim>::Field &positions,
            const faces::FaceShape<dim>              &shape,
            std::vector<double>                       nodal)
    : nodal(std::move(nodal))
    , surface(surface)
    , positions(positions)
    , shape(shape)
    , edges(surface, contact::faces_of(surface, pair.slave), shape)
    , faces(surface, contact::faces_of(surface, pair.slave), shape, positions)
  {}

  double at(const dealii::Tensor<1, dim> &x) const
  {
    const auto [face, best] = faces.closest(x);
    if (edges.excess(face, best.xi, x - best.position, positions) >= contact::edge_tolerance)
      return 0.;
    const auto values = shape.at(best.xi).value;
    double     sum    = 0.;
    for (unsigned int k = 0; k < values.size(); ++k)
      sum += values[k] * nodal[surface.faces()[face].nodes[k]];
    return sum;
  }

  const std::vector<double> nodal; ///< per surface node

private:
  const mesh::Surface<dim>                 &surface;
  const typename mesh::Surface<dim>::Field &positions;
  const faces::FaceShape<dim>              &shape;
  const faces::OuterEdges<dim>              edges;
  const contact::NearestFace<dim>           faces;
};

/// Set the rows first, then the nodes for which the rows act, then the hanging nodes, because each
/// step may need the values of the steps before.
template <int dim>
std::vector<double> nodal_values(const state::StateSolver<dim> &solver,
                                 const contact::Contact<dim>   &contact,
                                 const unsigned int             pair,
                                 const std::vector<double>     &of_rows)
{
  const auto         &surface = solver.surface();
  std::vector<double> values(surface.n_nodes(), 0.);
  std::vector<bool>   has_row(values.size(), false);
  for (unsigned int i = 0; i < of_rows.size(); ++i)
    if (contact.places()[i].pair == pair)
      {
        values[contact.places()[i].slave]  = of_rows[i];
        has_row[contact.places()[i].slave] = true;
      }
  for (const auto &shared : contact.dependent_multipliers())
    if (!has_row[shared.node])
      for (const auto &[row, share] : shared.rows)
        if (contact.places()[row].pair == pair)
          values[shared.node] += share * of_rows[row];
  for (unsigned int node = 0; node < values.size(); ++node)
    if (!surface.masters(node).empty())
      {
        values[node] = 0.;
        for (const auto &[master, weight] : surface.masters(node))
          values[node] += weight * values[master];
      }
  return values;
}

template <int dim>
ContactPressure<dim>::ContactPressure(const state::StateSolver<dim>  &solver,
                                      const contact::Contact<dim>    &contact,
                                      const state::ContactState<dim> &state,
                                      const std::vector<double>      &of_rows)
  : solver(solver)
  , contact(contact)
  , positions(contact.placed_surface().to_space(state.surface_positions))
  , shape(solver.mesh().degree())
{
  const auto &surface = contact.placed_surface().surface();
  SNUG_ASSERT_EQUAL(of_rows.size(), contact.n_rows());
  for (const auto &pair : contact.pairs())
    {
      for (const auto &boundary : pair.slave.boundaries())
        slave_of[boundary].push_back(pairs.size());
      for (const auto &boundary : pair.master.boundaries())
        master_of[boundary].push_back(pairs.size());
      pairs.push_back(
        std::make_unique<SlaveSide>(surface, pair, positions, shape,
                                    nodal_values(solver, contact, pairs.size(), of_rows)));
    }
}

template <int dim>
ContactPressure<dim>::~ContactPressure() = default;

template <int dim>
bool ContactPressure<dim>::is_on(const Face &face) const
{
  const Boundary boundary(face.body, face.boundary);
  return slave_of.count(boundary) > 0 || master_of.count(boundary) > 0;
}

template <int dim>
double ContactPressure<dim>::on_slave_side(const unsigned int            pair,
                                           const dealii::Tensor<1, dim> &x) const
{
  return pairs[pair]->at(x);
}

template <int dim>
double ContactPressure<dim>::value(const Face                   &face,
                                   const std::vector<double>    &at_nodes,
                                   const dealii::Tensor<1, dim> &x,
                                   const double                  on_master) const
{
  const Boundary boundary(face.body, face.boundary);
  double         sum = 0.;
  if (const auto slaves = slave_of.find(boundary); slaves != slave_of.end())
    {
      const auto &nodes = solver.mesh().cells()[face.cell].nodes;
      for (unsigned int k = 0; k < nodes.size(); ++k)
        {
          // Functions of nodes off the face vanish on the face.
          const unsigned int node = solver.surface().find(solver.mesh().global_node(nodes[k]));
          if (node < solver.surface().n_nodes())
            for (const unsigned int pair : slaves->second)
              sum += at_nodes[k] * pairs[pair]->nodal[node];
        }
    }
  if (const auto masters = master_of.find(boundary); masters != master_of.end())
    for (const unsigned int pair : masters->second)
      sum += on_master * pairs[pair]->at(contact.placement().of_body(face.body).point(x));
  return sum;
}

template std::vector<double> nodal_values(const state::StateSolver<2> &,
                                          const contact::Contact<2> &,
                                          unsigned int,
                                          const std::vector<double> &);
template std::vector<double> nodal_values(const state::StateSolver<3> &,
                                          const contact::Contact<3> &,
                                          unsigned int,
                                          const std::vector<double> &);
template class ContactPressure<2>;
template class ContactPressure<3>;
} // namespace snug::accuracy
