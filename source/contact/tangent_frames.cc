#include <snug/contact/tangent_frames.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace snug::contact {
namespace {
/// Sine of the angle up to which a direction counts as held or as tangential.
const double least_angle = 1e-6;

/// Shape functions and coefficients of rows below this value do not count.
const double least_shape_function = 1e-6;

/// Return @p nodes, ascending and with hanging nodes replaced by their masters.
template <int dim>
std::vector<unsigned int> without_hanging(const std::vector<unsigned int> &nodes,
                                          const mesh::Surface<dim>        &surface)
{
  std::set<unsigned int> result;
  for (const unsigned int node : nodes)
    {
      if (surface.masters(node).empty())
        result.insert(node);
      for (const auto &master : surface.masters(node))
        result.insert(master.first);
    }
  return {result.begin(), result.end()};
}

/// Return the projection to the directions that @p held leaves free.
template <int dim>
dealii::Tensor<2, dim> free_directions(const std::vector<dealii::Tensor<1, dim>> &held)
{
  dealii::Tensor<2, dim> result = dealii::unit_symmetric_tensor<dim>();
  for (const auto &q : held)
    result -= outer_product(q, q);
  return result;
}

/// Return the number of eigenvalues of a positive semidefinite @p matrix of rank dim - 1 or less
/// that are not round-off.
template <int dim>
unsigned int rank_of(const dealii::Tensor<2, dim> &matrix)
{
  const double least = least_angle * least_angle, sum = trace(matrix);
  if (!(sum > least))
    return 0;
  // In 3D, the sum of the products of two eigenvalues is that of the two largest ones.
  const double product = 0.5 * (sum * sum - trace(matrix * matrix));
  return dim == 3 && product > least * sum ? 2 : 1;
}

/// Return the direction of the largest column of a positive semidefinite matrix, the first of equal
/// ones.
template <int dim>
dealii::Tensor<1, dim> largest_column(const dealii::Tensor<2, dim> &matrix)
{
  unsigned int largest = 0;
  for (int d = 1; d < dim; ++d)
    if (matrix[d][d] > matrix[largest][largest] * (1. + 1e-6))
      largest = d;
  return matrix[largest] / matrix[largest].norm();
}

} // namespace

template <int dim>
TangentFrames<dim>::TangentFrames(PairGeometry<dim> geometry) : pair(std::move(geometry))
{
  if (pair.pair.obstacle)
    return;
  nearest.emplace(pair.surface, pair.sides.master, pair.shape, pair.positions);
  of_slave  = faces_at_nodes(pair.sides.slave);
  of_master = faces_at_nodes(pair.sides.master);
}

template <int dim>
typename TangentFrames<dim>::FacesAtNodes
TangentFrames<dim>::faces_at_nodes(const std::vector<unsigned int> &side) const
{
  FacesAtNodes result(pair.surface.n_nodes());
  for (const unsigned int face : side)
    for (const unsigned int node : pair.surface.faces()[face].nodes)
      {
        result[node].push_back(face);
        for (const auto &master : pair.surface.masters(node))
          result[master.first].push_back(face);
      }
  return result;
}

template <int dim>
std::vector<bool> TangentFrames<dim>::rely_on_master(const std::vector<unsigned int> &slaves,
                                                     const Row<dim>                  *rows) const
{
  struct Choice
  {
    double       coefficient;
    unsigned int row, node;
  };
  std::vector<Choice> choices;
  for (unsigned int i = 0; i < slaves.size(); ++i)
    {
      Choice best{0., i, 0};
      for (const auto &[node, c] : rows[i].coefficients)
        if (nearest && !of_master[node].empty() && std::abs(c * rows[i].normal) > best.coefficient)
          best = {std::abs(c * rows[i].normal), i, node};
      if (!pair.held[slaves[i]].empty() && best.coefficient > 0.)
        choices.push_back(best);
    }
  std::stable_sort(choices.begin(), choices.end(),
                   [](const auto &a, const auto &b) { return a.coefficient > b.coefficient; });
  std::vector<bool> result(slaves.size(), false), serves(pair.surface.n_nodes(), false);
  for (const Choice &choice : choices)
    {
      result[choice.row]  = !serves[choice.node];
      serves[choice.node] = true;
    }
  return result;
}

template <int dim>
typename TangentFrames<dim>::Tangents
TangentFrames<dim>::tangents(const unsigned int slave,
                             const Row<dim>    &row,
                             const bool         relies_on_master) const
{
  const auto tangential = free_directions<dim>({row.normal});
  const auto movable =
    tangential *
    movable_directions(slave, relies_on_master ? nodes_at_foot(slave) : std::vector<unsigned int>(),
                       row.normal) *
    tangential;
  Tangents result{{}, rank_of(movable)};
  auto     of_any_node = free_directions<dim>(pair.held[slave]);
  for (const unsigned int node : nodes_at_foot(slave))
    of_any_node += free_directions<dim>(pair.held[node]);
  // A direction that is left out although a node is free there depends on other rows.
  if (rank_of(tangential * of_any_node * tangential) == result.n_free)
    result.n_held = dim - 1 - result.n_free;
  auto &frame = result.frame;
  // If only one direction of the tangent plane is free, it is the first tangent.
  frame.reference = largest_column(dim == 3 && result.n_free == 1 ? movable : tangential);
  if (pair.pair.obstacle)
    frame.displacement = pair.obstacle_displacement();
  // In axisymmetric sections, rotations are no rigid motions.
  else if (!pair.surface.idealization().is_axisymmetric())
    for (const FacesAtNodes *side : {&of_slave, &of_master})
      add_couple(row, *side, frame);
  return result;
}

/// Return the nodes with shape functions at the foot of a slave node; none for obstacles.
template <int dim>
std::vector<unsigned int> TangentFrames<dim>::nodes_at_foot(const unsigned int slave) const
{
  if (!nearest)
    return {};
  const auto                found = nearest->closest(pair.positions[slave]);
  const auto               &nodes = pair.surface.faces()[found.face].nodes;
  const auto                shape = pair.shape.at(found.point.xi).value;
  std::vector<unsigned int> result;
  for (unsigned int k = 0; k < nodes.size(); ++k)
    if (std::abs(shape[k]) > least_shape_function)
      result.push_back(nodes[k]);
  return without_hanging(result, pair.surface);
}

/// Add the part of the couple on one side: patches around the nodes of the row on this side.
template <int dim>
void TangentFrames<dim>::add_couple(const Row<dim>     &row,
                                    const FacesAtNodes &side,
                                    TangentFrame<dim>  &frame) const
{
  std::vector<CouplePatch> patches;
  for (const auto &[node, c] : row.coefficients)
    {
      if (side[node].empty() || std::abs(c * row.normal) <= least_shape_function)
        continue;
      std::vector<unsigned int> around;
      for (const unsigned int face : side[node])
        {
          const auto &nodes = pair.surface.faces()[face].nodes;
          around.insert(around.end(), nodes.begin(), nodes.end());
        }
      CouplePatch patch{node, without_hanging(around, pair.surface)};
      patch.spread = tangential_spread(row.normal, frame.reference, patch.nodes, pair.positions);
      if (patch.spread > 0)
        patches.push_back(std::move(patch));
    }
  if (!patches.empty())
    frame.couple.push_back(std::move(patches));
}

/// Return a matrix that is zero in the directions that the slave node and the nodes of the master
/// opposite to it hold.
template <int dim>
dealii::Tensor<2, dim>
TangentFrames<dim>::movable_directions(const unsigned int               slave,
                                       const std::vector<unsigned int> &opposite,
                                       const dealii::Tensor<1, dim>    &normal) const
{
  auto result = free_directions<dim>(pair.held[slave]);
  for (const unsigned int node : opposite)
    result += free_directions<dim>(pair.held[node]);
  const dealii::Tensor<1, dim> free_normal = result * normal;
  // The normal row resists the motion along the free part of the normal, which is not along the
  // normal where the slave node is held in a direction at an angle to it.
  if (!nearest && free_normal.norm() > least_angle)
    result -= outer_product(free_normal, free_normal) / free_normal.norm_square();
  return result;
}

template class TangentFrames<2>;
template class TangentFrames<3>;
} // namespace snug::contact
