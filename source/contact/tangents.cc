#include <snug/base/assertions.h>
#include <snug/base/errors.h>
#include <snug/contact/contact.h>
#include <snug/contact/row_derivatives.h>
#include <snug/contact/tangent_frames.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <tuple>

namespace snug::contact {
namespace {
/// Sine of the angle up to which normals are parallel.
const double least_angle_of_normals = 1e-6;

/// The friction formula of a pair of the scene.
template <int dim>
class FrictionFormula
{
public:
  explicit FrictionFormula(const NamedPair &pair)
    : is_coulomb(pair.parameters.friction == Friction::Coulomb)
    , text(pair.parameters.resistance())
    , entry("Pair " + pair.name() + "/" + (is_coulomb ? "Friction coefficient" : "Friction bound"))
    , formula(entry, text)
  {}

  /// Return the friction at @p x.
  /// @throws InputError if it is negative or not finite there
  RowFriction at(const dealii::Tensor<1, dim> &x) const
  {
    const double value = formula.value(dealii::Point<dim>(x));
    if (value < 0.)
      {
        std::ostringstream message;
        message << "must be 0 or above, but is " << value << " at (" << x << ")";
        throw bad_entry(entry, text, message.str());
      }
    return {is_coulomb ? value : 0., is_coulomb ? 0. : value};
  }

private:
  const bool                   is_coulomb;
  const std::string            text, entry;
  const geometry::Formula<dim> formula;
};

/// Return the rows of each slave node of obstacles with different normals.
template <int dim>
std::map<unsigned int, std::vector<unsigned int>>
obstacle_rows_at_nodes(const std::vector<RowPlace> &places,
                       const std::vector<Pair>     &pairs,
                       const std::vector<Row<dim>> &rows)
{
  std::map<unsigned int, std::vector<unsigned int>> result;
  for (unsigned int i = 0; i < places.size(); ++i)
    {
      auto      &of_node  = result[places[i].slave];
      const auto parallel = [&](const unsigned int other) {
        return 1. - std::abs(rows[other].normal * rows[i].normal) <
               least_angle_of_normals * least_angle_of_normals;
      };
      if (pairs[places[i].pair].obstacle && std::none_of(of_node.begin(), of_node.end(), parallel))
        of_node.push_back(i);
    }
  return result;
}

/// Let the first tangent of @p frame be along the obstacles with the normals @p a and @p b, unless
/// the supports determine the only tangent. Return whether it is.
template <int dim>
bool share_first_tangent(const dealii::Tensor<1, dim> &a,
                         const dealii::Tensor<1, dim> &b,
                         const unsigned int            n_tangents,
                         TangentFrame<dim>            &frame)
{
  if constexpr (dim == 3)
    {
      const auto along = cross_product_3d(a, b) / cross_product_3d(a, b).norm();
      if (n_tangents == 2)
        frame.reference = along;
      return std::abs(frame.reference * along) > 1. - least_angle_of_normals;
    }
  return false;
}

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

template <int dim>
void Contact<dim>::make_frictions()
{
  std::vector<std::optional<FrictionFormula<dim>>> formulas(named.size());
  for (unsigned int pair = 0; pair < named.size(); ++pair)
    if (named[pair].parameters.has_friction())
      formulas[pair].emplace(named[pair]);
  const auto shares = shares_of_rows([](const PairParameters &of) {
    return std::tie(of.friction, of.friction_coefficient, of.friction_bound);
  });
  frictions.assign(n_rows(), {});
  for (unsigned int row = 0; row < n_rows(); ++row)
    for (const auto &[pair, share] : shares[row])
      if (formulas[pair])
        {
          const auto of_pair =
            formulas[pair]->at(placed.unmoved().reference_positions()[row_places[row].slave]);
          frictions[row].coefficient += share * of_pair.coefficient;
          frictions[row].bound += share * of_pair.bound;
        }
}

/// Make the tangential rows at @p positions in space.
template <int dim>
void Contact<dim>::make_tangents(const Field                      &positions,
                                 const faces::HeldDirections<dim> &held,
                                 const std::vector<Row<dim>>      &paired)
{
  make_frictions();
  frames.assign(n_rows(), {});
  tangent_places.clear();
  others.assign(n_rows(), {});
  const auto   at_nodes = obstacle_rows_at_nodes(row_places, chosen, paired);
  unsigned int first    = 0;
  for (unsigned int p = 0; p < groups.size(); ++p)
    {
      const auto        &slaves = groups[p].rows->slaves();
      const unsigned int begin  = first;
      first += slaves.size();
      if (!chosen[p].parameters.has_friction())
        continue;
      const TangentFrames<dim> maker(geometry(p, positions, held));
      const auto               rely_on_master = maker.rely_on_master(slaves, &paired[begin]);
      for (unsigned int i = 0; i < slaves.size(); ++i)
        {
          const unsigned int row = begin + i;
          if (!frictions[row].resists())
            continue;
          auto [frame, n_free, n_held] = maker.tangents(slaves[i], paired[row], rely_on_master[i]);
          const auto &at_node          = at_nodes.at(slaves[i]);
          if (at_node.size() > 1)
            n_held = 0;
          if (at_node.size() > 2)
            n_free = 0;
          else if (at_node.size() == 2)
            others[row] = {at_node[at_node[0] == row],
                           share_first_tangent(paired[at_node[0]].normal, paired[at_node[1]].normal,
                                               n_free, frame)};
          frames[row] = std::move(frame);
          for (unsigned int index = 0; index < n_free + n_held; ++index)
            tangent_places.push_back({row, index, index >= n_free});
        }
    }
}

template <int dim>
std::vector<dealii::Tensor<1, dim>>
Contact<dim>::tangent_directions(const std::vector<Row<dim>> &rows) const
{
  std::vector<dealii::Tensor<1, dim>> result;
  for (const Tangent &of : tangent_places)
    result.push_back(tangent_direction(frames[of.row].reference, rows[of.row].normal, of.index));
  return result;
}

template <int dim>
ContactForces<dim> Contact<dim>::forces(const std::vector<Row<dim>> &rows,
                                        const std::vector<double>   &of_rows) const
{
  SNUG_ASSERT_EQUAL(of_rows.size(), n_rows() + tangent_places.size());
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
  SNUG_ASSERT_EQUAL(rows.size(), n_rows());
  const auto                           in_space = placed.to_space(positions);
  const faces::PointField<dim, double> x(in_space);
  std::vector<Row<dim>>                result;
  for (const Tangent &of : tangent_places)
    result.push_back(tangent_row(placed.turned(rows[of.row]), of.index, frames[of.row], x));
  return placed.turned_back(std::move(result));
}

template <int dim>
std::vector<Row<dim>>
Contact<dim>::tangent_row_derivatives(const Field                 &positions,
                                      const Field                 &velocity,
                                      const std::vector<Row<dim>> &rows,
                                      const std::vector<Row<dim>> &derivatives) const
{
  SNUG_ASSERT_EQUAL(rows.size(), n_rows());
  SNUG_ASSERT_EQUAL(derivatives.size(), n_rows());
  const auto in_space = placed.to_space(positions), motion = placed.turned(velocity);
  const faces::PointField<dim, faces::Differential<1>> x(in_space, motion);
  std::vector<Row<dim>>                                result;
  for (const Tangent &of : tangent_places)
    {
      const unsigned int row = of.row;
      // With the present direction as the reference, the derivative of the frame has no spin.
      auto frame      = frames[row];
      frame.reference = tangent_direction(frame.reference, rows[row].normal, 0);
      result.push_back(derivative_of(
        tangent_row(with_derivatives(placed.turned(rows[row]), placed.turned(derivatives[row])),
                    of.index, frame, x)));
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
  SNUG_ASSERT_EQUAL(forces.size(), n_rows());
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
