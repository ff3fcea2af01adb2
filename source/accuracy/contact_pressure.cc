#include <snug/accuracy/contact_pressure.h>
#include <snug/base/assertions.h>
#include <snug/contact/nearest_face.h>
#include <snug/contact/projection.h>
#include <snug/faces/outer_edges.h>

namespace snug::accuracy {
/// The geometry of the slave side of a pair.
template <int dim>
class ContactSides<dim>::SlaveSide
{
public:
  SlaveSide(const mesh::Surface<dim>                 &surface,
            const contact::Pair                      &pair,
            const typename mesh::Surface<dim>::Field &positions,
            const faces::FaceShape<dim>              &shape)
    : surface(surface)
    , positions(positions)
    , shape(shape)
    , edges(surface, contact::faces_of(surface, pair.slave), shape)
    , faces(surface, contact::faces_of(surface, pair.slave), shape, positions)
  {}

  /// Append the shares at the closest point to @p x.
  void add_shares(const dealii::Tensor<1, dim> &x,
                  const unsigned int            pair,
                  std::vector<NodeShare>       &shares) const
  {
    const auto [face, best] = faces.closest(x);
    if (edges.excess(face, best.xi, x - best.position, positions) >= contact::edge_tolerance)
      return;
    const auto values = shape.at(best.xi).value;
    for (unsigned int k = 0; k < values.size(); ++k)
      shares.push_back({pair, surface.faces()[face].nodes[k], values[k], true});
  }

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

double value(const std::vector<NodeShare> &shares, const PairValues &values, const double on_master)
{
  double sum = 0.;
  for (const auto &of : shares)
    sum += (of.on_master ? on_master : 1.) * of.share * values[of.pair][of.node];
  return sum;
}

template <int dim>
ContactSides<dim>::ContactSides(const state::StateSolver<dim>  &solver,
                                const contact::Contact<dim>    &contact,
                                const state::ContactState<dim> &state)
  : solver(solver)
  , contact(contact)
  , positions(contact.placed_surface().to_space(state.surface_positions))
  , shape(solver.mesh().degree())
{
  const auto &surface = contact.placed_surface().surface();
  for (const auto &pair : contact.pairs())
    {
      for (const auto &boundary : pair.slave.boundaries())
        slave_of[boundary].push_back(pairs.size());
      for (const auto &boundary : pair.master.boundaries())
        master_of[boundary].push_back(pairs.size());
      pairs.push_back(std::make_unique<SlaveSide>(surface, pair, positions, shape));
    }
}

template <int dim>
ContactSides<dim>::~ContactSides() = default;

template <int dim>
PairValues ContactSides<dim>::values(const std::vector<double> &of_rows) const
{
  PairValues result;
  if (of_rows.empty())
    return result;
  SNUG_ASSERT_EQUAL(of_rows.size(), contact.n_rows());
  for (unsigned int pair = 0; pair < pairs.size(); ++pair)
    result.push_back(nodal_values(solver, contact, pair, of_rows));
  return result;
}

template <int dim>
bool ContactSides<dim>::is_on(const Face &face) const
{
  const Boundary boundary(face.body, face.boundary);
  return slave_of.count(boundary) > 0 || master_of.count(boundary) > 0;
}

template <int dim>
std::vector<NodeShare> ContactSides<dim>::closest(const unsigned int            pair,
                                                  const dealii::Tensor<1, dim> &x) const
{
  std::vector<NodeShare> result;
  pairs[pair]->add_shares(x, pair, result);
  return result;
}

template <int dim>
std::vector<NodeShare> ContactSides<dim>::shares(const Face                   &face,
                                                 const std::vector<double>    &at_nodes,
                                                 const dealii::Tensor<1, dim> &x) const
{
  const Boundary         boundary(face.body, face.boundary);
  std::vector<NodeShare> result;
  if (const auto slaves = slave_of.find(boundary); slaves != slave_of.end())
    {
      const auto &nodes = solver.mesh().cells()[face.cell].nodes;
      for (unsigned int k = 0; k < nodes.size(); ++k)
        // Functions of nodes off the face vanish on the face.
        if (at_nodes[k] != 0.)
          {
            const unsigned int node = solver.surface().find(solver.mesh().global_node(nodes[k]));
            for (const unsigned int pair : slaves->second)
              result.push_back({pair, node, at_nodes[k], false});
          }
    }
  if (const auto masters = master_of.find(boundary); masters != master_of.end())
    {
      const auto in_space = contact.placement().of_body(face.body).point(x);
      for (const unsigned int pair : masters->second)
        pairs[pair]->add_shares(in_space, pair, result);
    }
  return result;
}

template std::vector<double> nodal_values(const state::StateSolver<2> &,
                                          const contact::Contact<2> &,
                                          unsigned int,
                                          const std::vector<double> &);
template std::vector<double> nodal_values(const state::StateSolver<3> &,
                                          const contact::Contact<3> &,
                                          unsigned int,
                                          const std::vector<double> &);
template class ContactSides<2>;
template class ContactSides<3>;
} // namespace snug::accuracy
