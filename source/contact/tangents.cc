#include <snug/base/errors.h>
#include <snug/contact/contact.h>
#include <snug/contact/nearest_face.h>
#include <snug/contact/row_derivatives.h>

#include <deal.II/base/symmetric_tensor.h>

#include <cmath>
#include <optional>
#include <set>
#include <sstream>
#include <tuple>

namespace snug::contact {
namespace {
/// Sine of the angle up to which a direction counts as held or as tangential.
const double least_angle = 1e-6;

/// Shape functions below this value do not count at a point of a face.
const double least_weight = 1e-6;

/// Return those of the @p nodes of a face that have a shape function above @p least, ascending and
/// with hanging nodes replaced by their masters.
template <int dim>
std::vector<unsigned int> nodes_above(const double                     least,
                                      const std::vector<double>       &shape_functions,
                                      const std::vector<unsigned int> &nodes,
                                      const mesh::Surface<dim>        &surface)
{
  std::set<unsigned int> result;
  for (unsigned int k = 0; k < nodes.size(); ++k)
    if (std::abs(shape_functions[k]) > least)
      {
        if (surface.masters(nodes[k]).empty())
          result.insert(nodes[k]);
        for (const auto &master : surface.masters(nodes[k]))
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

/// Return the friction of a pair at the places @p x of the @p nodes.
/// @throws InputError if it is negative or not finite there
template <int dim>
std::vector<RowFriction> frictions_at(const Pair                               &pair,
                                      const std::vector<unsigned int>          &nodes,
                                      const typename mesh::Surface<dim>::Field &x)
{
  const Friction     kind       = pair.parameters.friction;
  const bool         is_coulomb = kind == Friction::Coulomb;
  const std::string &text =
    is_coulomb ? pair.parameters.friction_coefficient : pair.parameters.friction_bound;
  const std::string entry =
    "Pair " + pair.name() + "/" + (is_coulomb ? "Friction coefficient" : "Friction bound");
  const geometry::Formula<dim> formula(entry, text);
  std::vector<RowFriction>     result;
  for (const unsigned int node : nodes)
    {
      const double value = formula.value(dealii::Point<dim>(x[node]));
      if (value < 0.)
        {
          std::ostringstream message;
          message << "must be 0 or above, but is " << value << " at (" << x[node] << ")";
          throw bad_entry(entry, text, message.str());
        }
      result.push_back({kind, is_coulomb ? value : 0., is_coulomb ? 0. : value});
    }
  return result;
}

/// This class makes the frames of the tangential rows of one pair.
template <int dim>
class FrameMaker
{
public:
  explicit FrameMaker(PairGeometry<dim> geometry)
    : pair(std::move(geometry)), on_master(pair.surface.n_nodes(), false)
  {
    if (pair.pair.obstacle)
      return;
    nearest.emplace(pair.surface, pair.sides.master, pair.shape, pair.positions);
    for (const unsigned int face : pair.sides.master)
      for (const unsigned int node : pair.surface.faces()[face].nodes)
        {
          on_master[node] = true;
          for (const auto &master : pair.surface.masters(node))
            on_master[master.first] = true;
        }
  }

  /// Return the frame of the contact row of a @p slave node and the number of its tangents.
  std::pair<TangentFrame<dim>, unsigned int> frame(const unsigned int slave,
                                                   const Row<dim>    &row) const
  {
    std::vector<unsigned int> at_foot, of_face;
    if (nearest)
      {
        const auto  found = nearest->closest(pair.positions[slave]);
        const auto &nodes = pair.surface.faces()[found.face].nodes;
        const auto  shape = pair.shape.at(found.point.xi).value;
        at_foot           = nodes_above(least_weight, shape, nodes, pair.surface);
        of_face           = nodes_above(-1., shape, nodes, pair.surface);
      }
    const auto tangential = free_directions<dim>({row.normal});
    const auto movable = tangential * movable_directions(slave, at_foot, row.normal) * tangential;
    const unsigned int n_tangents = rank_of(movable);
    TangentFrame<dim>  result;
    // If only one direction of the tangent plane is free, it is the first tangent.
    result.reference = largest_column(dim == 3 && n_tangents == 1 ? movable : tangential);
    if (pair.pair.obstacle)
      result.displacement = pair.obstacle_displacement();
    // In axisymmetric sections, rotations are no rigid motions.
    else if (!pair.surface.idealization().is_axisymmetric())
      set_masters(row, of_face, result);
    return {result, n_tangents};
  }

private:
  const PairGeometry<dim>         pair;
  std::optional<NearestFace<dim>> nearest; ///< none for obstacles
  std::vector<bool>               on_master;

  /// Choose the nodes for the couple: those of the row on the master, or those of the face opposite
  /// to the slave node where the former do not spread in all tangential directions, as at nodes
  /// that match.
  void set_masters(const Row<dim>                  &row,
                   const std::vector<unsigned int> &of_face,
                   TangentFrame<dim>               &frame) const
  {
    for (const auto &coefficient : row.coefficients)
      if (on_master[coefficient.first])
        frame.masters.push_back(coefficient.first);
    frame.spread = tangential_spread(row.normal, frame, pair.positions);
    if (frame.spread == dim - 1)
      return;
    frame.masters = of_face;
    frame.spread  = tangential_spread(row.normal, frame, pair.positions);
  }

  /// Return a matrix that is zero in the directions that the slave node and the nodes of the master
  /// opposite to it hold.
  dealii::Tensor<2, dim> movable_directions(const unsigned int               slave,
                                            const std::vector<unsigned int> &opposite,
                                            const dealii::Tensor<1, dim>    &normal) const
  {
    auto result = free_directions<dim>(pair.held[slave]);
    for (const unsigned int node : opposite)
      result += free_directions<dim>(pair.held[node]);
    const dealii::Tensor<1, dim> free_normal = result * normal;
    // The normal row resists the motion along the free part of the normal, which is not along the
    // normal where the slave node is held in a direction at an angle to it.
    if (opposite.empty() && free_normal.norm() > least_angle)
      result -= outer_product(free_normal, free_normal) / free_normal.norm_square();
    return result;
  }
};

/// Return a row as numbers that carry their derivatives.
template <int dim>
Row<dim, faces::Differential<1>> with_derivatives(const Row<dim> &row, const Row<dim> &derivatives)
{
  const auto combined = [](const dealii::Tensor<1, dim> &v, const dealii::Tensor<1, dim> &slope) {
    dealii::Tensor<1, dim, faces::Differential<1>> result;
    for (int d = 0; d < dim; ++d)
      {
        result[d].value    = v[d];
        result[d].slope[0] = slope[d];
      }
    return result;
  };
  Row<dim, faces::Differential<1>> result;
  for (unsigned int k = 0; k < row.coefficients.size(); ++k)
    {
      const auto &[node, c] = row.coefficients[k];
      result.coefficients.emplace_back(node, combined(c, derivatives.coefficients[k].second));
    }
  result.normal = combined(row.normal, derivatives.normal);
  return result;
}

/// Return a row whose coefficients and normal are variables of @p recording.
template <int dim>
Row<dim, faces::Recorded> recorded(const Row<dim> &row, faces::Recording &recording)
{
  const auto variables = [&](const dealii::Tensor<1, dim> &v) {
    dealii::Tensor<1, dim, faces::Recorded> result;
    for (int d = 0; d < dim; ++d)
      result[d] = recording.variable(v[d]);
    return result;
  };
  Row<dim, faces::Recorded> result;
  for (const auto &[node, c] : row.coefficients)
    result.coefficients.emplace_back(node, variables(c));
  result.normal = variables(row.normal);
  return result;
}
} // namespace

/// Make the tangential rows at @p positions in space.
template <int dim>
void Contact<dim>::make_tangents(const Field                      &positions,
                                 const faces::HeldDirections<dim> &held,
                                 const std::vector<Row<dim>>      &paired)
{
  frictions.assign(n_rows(), {});
  frames.assign(n_rows(), {});
  tangent_places.clear();
  unsigned int first = 0;
  for (unsigned int p = 0; p < groups.size(); ++p)
    {
      const auto        &slaves = groups[p].rows->slaves();
      const unsigned int begin  = first;
      first += slaves.size();
      if (!chosen[p].parameters.has_friction())
        continue;
      const auto of_pair =
        frictions_at<dim>(chosen[p], slaves, placed.unmoved().reference_positions());
      const FrameMaker<dim> maker(geometry(p, positions, held));
      for (unsigned int i = 0; i < slaves.size(); ++i)
        {
          const unsigned int row = begin + i;
          frictions[row]         = of_pair[i];
          if (!of_pair[i].resists())
            continue;
          unsigned int n_tangents;
          std::tie(frames[row], n_tangents) = maker.frame(slaves[i], paired[row]);
          for (unsigned int index = 0; index < n_tangents; ++index)
            tangent_places.push_back({row, index});
        }
    }
}

template <int dim>
std::vector<dealii::Tensor<1, dim>>
Contact<dim>::tangent_directions(const std::vector<Row<dim>> &rows) const
{
  std::vector<dealii::Tensor<1, dim>> result;
  for (const auto &[row, index] : tangent_places)
    result.push_back(tangent_direction(frames[row].reference, rows[row].normal, index));
  return result;
}

template <int dim>
ContactForces<dim> Contact<dim>::forces(const std::vector<Row<dim>> &rows,
                                        const std::vector<double>   &of_rows) const
{
  AssertDimension(of_rows.size(), n_rows() + tangent_places.size());
  ContactForces<dim> result{{of_rows.begin(), of_rows.begin() + n_rows()}};
  if (!has_friction())
    return result;
  result.tangential.resize(n_rows());
  const auto directions = tangent_directions(rows);
  for (unsigned int i = 0; i < directions.size(); ++i)
    result.tangential[tangent_places[i].row] += of_rows[n_rows() + i] * directions[i];
  return result;
}

template <int dim>
std::vector<Row<dim>> Contact<dim>::tangent_rows(const Field                 &positions,
                                                 const std::vector<Row<dim>> &rows) const
{
  AssertDimension(rows.size(), n_rows());
  const auto                           in_space = placed.to_space(positions);
  const faces::PointField<dim, double> x(in_space);
  std::vector<Row<dim>>                result;
  for (const auto &[row, index] : tangent_places)
    result.push_back(tangent_row(placed.turned(rows[row]), index, frames[row], x));
  return placed.turned_back(std::move(result));
}

template <int dim>
std::vector<Row<dim>>
Contact<dim>::tangent_row_derivatives(const Field                 &positions,
                                      const Field                 &velocity,
                                      const std::vector<Row<dim>> &rows,
                                      const std::vector<Row<dim>> &derivatives) const
{
  AssertDimension(rows.size(), n_rows());
  AssertDimension(derivatives.size(), n_rows());
  const auto in_space = placed.to_space(positions), motion = placed.turned(velocity);
  const faces::PointField<dim, faces::Differential<1>> x(in_space, motion);
  std::vector<Row<dim>>                                result;
  for (const auto &[row, index] : tangent_places)
    {
      // With the present direction as the reference, the derivative of the frame has no spin.
      auto frame      = frames[row];
      frame.reference = tangent_direction(frame.reference, rows[row].normal, 0);
      result.push_back(derivative_of(
        tangent_row(with_derivatives(placed.turned(rows[row]), placed.turned(derivatives[row])),
                    index, frame, x)));
    }
  return placed.turned_back(std::move(result));
}

/// Add the derivatives of the energy of the tangential @p forces with respect to the contact rows
/// to @p slopes, and those with respect to positions at fixed contact rows to @p gradient. All
/// arguments but the positions are in space.
template <int dim>
void Contact<dim>::add_tangential_slopes(const Field                               &positions,
                                         const Field                               &moved,
                                         const std::vector<dealii::Tensor<1, dim>> &forces,
                                         std::vector<RowSlopes<dim>>               &slopes,
                                         Field                                     &gradient) const
{
  AssertDimension(forces.size(), n_rows());
  const auto       in_space = placed.to_space(positions);
  const auto       values   = rows(positions);
  faces::Recording recording;
  for (unsigned int i = 0; i < forces.size(); ++i)
    {
      if (forces[i].norm_square() == 0.)
        continue;
      recording.clear();
      const faces::PointField<dim, faces::Recorded> x(in_space, recording);
      const auto row = recorded(placed.turned(values[i]), recording);
      // The first derivative of this vector is that of a force that follows the normal.
      const dealii::Tensor<1, dim, faces::Recorded> along =
        forces[i] - (row.normal * forces[i]) * row.normal;
      const auto     tangent = tangent_row(row, along, frames[i], x);
      RowSlopes<dim> of_tangent;
      of_tangent.gap = -1.;
      for (const auto &coefficient : tangent.coefficients)
        of_tangent.coefficients.push_back(moved[coefficient.first]);
      add_slopes(tangent, of_tangent, recording);
      recording.sweep();
      x.add_derivatives(gradient);
      slopes[i].coefficients.resize(row.coefficients.size());
      for (int d = 0; d < dim; ++d)
        {
          for (unsigned int k = 0; k < row.coefficients.size(); ++k)
            slopes[i].coefficients[k][d] += recording.derivative(row.coefficients[k].second[d]);
          slopes[i].normal[d] += recording.derivative(row.normal[d]);
        }
    }
}

#define SNUG_INSTANTIATE(dim)                                                                     \
  template void Contact<dim>::make_tangents(const mesh::Surface<dim>::Field &,                    \
                                            const faces::HeldDirections<dim> &,                   \
                                            const std::vector<Row<dim>> &);                       \
  template std::vector<dealii::Tensor<1, dim>> Contact<dim>::tangent_directions(                  \
    const std::vector<Row<dim>> &) const;                                                         \
  template ContactForces<dim>    Contact<dim>::forces(const std::vector<Row<dim>> &,              \
                                                      const std::vector<double> &) const;         \
  template std::vector<Row<dim>> Contact<dim>::tangent_rows(const mesh::Surface<dim>::Field &,    \
                                                            const std::vector<Row<dim>> &) const; \
  template std::vector<Row<dim>> Contact<dim>::tangent_row_derivatives(                           \
    const mesh::Surface<dim>::Field &, const mesh::Surface<dim>::Field &,                         \
    const std::vector<Row<dim>> &, const std::vector<Row<dim>> &) const;                          \
  template void Contact<dim>::add_tangential_slopes(const mesh::Surface<dim>::Field &,            \
                                                    const mesh::Surface<dim>::Field &,            \
                                                    const std::vector<dealii::Tensor<1, dim>> &,  \
                                                    std::vector<RowSlopes<dim>> &,                \
                                                    mesh::Surface<dim>::Field &) const;
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::contact
