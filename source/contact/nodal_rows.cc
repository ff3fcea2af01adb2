#include <snug/base/errors.h>
#include <snug/contact/foot.h>
#include <snug/contact/pair_rows.h>
#include <snug/contact/supported_normals.h>
#include <snug/faces/tributary.h>

#include <map>

namespace snug::contact {
namespace {
/// Normal of a row: n = v/|v|, v = -sum_k w_k n_k.
template <int dim>
struct RowNormal
{
  dealii::Tensor<1, dim> n;
  double                 length; ///< |v|
};

template <int dim>
using SurfaceField = typename mesh::Surface<dim>::Field;

/// Return sum_k w_k field_k.
template <int dim>
dealii::Tensor<1, dim> weighted(const Weights &weights, const SurfaceField<dim> &field)
{
  dealii::Tensor<1, dim> sum;
  for (const auto &point : weights)
    sum += point.second * field[point.first];
  return sum;
}

/// Return the vector from the @p slave to the true surface of the master, by the weights of its
/// points. If @p field is a velocity of the positions, return the derivative of this vector along
/// @p field.
template <int dim>
dealii::Tensor<1, dim>
to_master(const unsigned int slave, const Weights &surface, const SurfaceField<dim> &field)
{
  return weighted<dim>(surface, field) - field[slave];
}

template <int dim>
RowNormal<dim> row_normal(const Weights &masters, const SurfaceField<dim> &nodal_normals)
{
  // Nodal normals point out of the master, and normals of rows point into it.
  const dealii::Tensor<1, dim> v      = -1. * weighted<dim>(masters, nodal_normals);
  const double                 length = v.norm();
  if (!(length > 0.))
    throw TangledMesh("the normals of a contact face cancel: it is folded");
  return {v / length, length};
}

/// Return the row whose coefficients are @p factors times @p n.
template <int dim>
Row<dim> make_row(const std::vector<std::pair<unsigned int, double>> &factors,
                  const dealii::Tensor<1, dim>                       &n,
                  double                                              gap)
{
  Row<dim> row;
  for (const auto &factor : factors)
    row.coefficients.emplace_back(factor.first, factor.second * n);
  row.gap    = gap;
  row.normal = n;
  return row;
}

template <int dim>
class NodalRows : public RowGroup<dim>
{
public:
  using Field = typename RowGroup<dim>::Field;

  /// Find the slave nodes with rows. Slave nodes that hang have no row (project() leaves them out).
  /// They move with their masters, whose rows hold them. A row of a hanging node would be nearly a
  /// combination of the rows of its masters.
  explicit NodalRows(const PairGeometry<dim> &pair)
    : surface(pair.surface), shape(pair.shape), sides(pair.sides), held(pair.held)
  {
    const SearchCriteria<dim> criteria(pair);
    const auto                normals = master_normals(pair.positions);
    for (const Projection<dim> &projection :
         project(surface, sides, shape, pair.positions, normals.normals()))
      {
        const unsigned int slave = projection.slave;
        const double distance    = to_master<dim>(slave, projection.surface, pair.positions).norm();
        const auto   n           = row_normal<dim>(projection.masters, normals.normals()).n;
        // Check the distance on both sides, because a deep overlap is as far away as a wide gap.
        if (pair.taken[slave] || !criteria.are_met(slave, distance, n))
          continue;
        if (faces::is_without_area(surface, shape.degree(), pair.positions[slave]))
          {
            zero_area_nodes.push_back(slave);
            continue;
          }
        feet.emplace_back(surface, shape, projection, pair.positions, normals.normals());
        slave_nodes.push_back(slave);
      }
  }

  const std::vector<unsigned int> &slaves() const override { return slave_nodes; }

  std::vector<DependentMultiplier> dependent_multipliers() const override
  {
    return dependent_on_axis(surface, sides.slave, slave_nodes, zero_area_nodes);
  }

  std::vector<Row<dim>> rows(const Field &positions) const override
  {
    const auto            normals = master_normals(positions);
    std::vector<Row<dim>> result;
    for (const Foot<dim> &foot : feet)
      {
        const auto place = foot.at(positions, normals.normals());
        const auto n     = row_normal<dim>(place.masters, normals.normals()).n;
        // Use the positions of the hanging nodes themselves, because the gap is that of the actual
        // mesh.
        const double gap =
          n * to_master<dim>(foot.paired.slave, place.surface, positions) + foot.paired.softening;
        result.push_back(make_row(factors(foot, 1., place.masters), n, gap));
        result.back().off_face = place.off_face;
      }
    return result;
  }

  std::vector<Row<dim>> row_derivatives(const Field &positions,
                                        const Field &velocity) const override
  {
    const auto            normals     = master_normals(positions);
    const auto            derivatives = normals.derivative(velocity);
    std::vector<Row<dim>> result;
    for (const Foot<dim> &foot : feet)
      {
        const unsigned int           slave  = foot.paired.slave;
        const auto                   place  = foot.at(positions, normals.normals());
        const auto                   slopes = place.slopes(velocity, derivatives);
        const auto                   normal = row_normal<dim>(place.masters, normals.normals());
        const dealii::Tensor<1, dim> dv     = -1. * (weighted<dim>(place.masters, derivatives) +
                                                 weighted<dim>(slopes.masters, normals.normals()));
        const auto   dn   = faces::unit_vector_derivative(normal.n, normal.length, dv);
        const double dgap = dn * to_master<dim>(slave, place.surface, positions) +
                            normal.n * (to_master<dim>(slave, place.surface, velocity) +
                                        weighted<dim>(slopes.surface, positions));
        result.push_back(make_row(factors(foot, 1., place.masters), dn, dgap));
        // Coefficients are factor n: differentiate n above and the factor here. Both lists have the
        // same nodes.
        const auto by_weights = factors(foot, 0., slopes.masters);
        for (unsigned int b = 0; b < by_weights.size(); ++b)
          result.back().coefficients[b].second += by_weights[b].second * normal.n;
      }
    return result;
  }

  void add_energy_gradient(const Field               &positions,
                           const Field               &displacement,
                           const std::vector<double> &forces,
                           Field                     &gradient) const override
  {
    AssertDimension(forces.size(), feet.size());
    const auto normals = master_normals(positions);
    Field      normal_gradients(surface.n_nodes());
    for (unsigned int i = 0; i < feet.size(); ++i)
      {
        const unsigned int slave  = feet[i].paired.slave;
        const auto         place  = feet[i].at(positions, normals.normals());
        const auto         normal = row_normal<dim>(place.masters, normals.normals());
        // derivative of n . (sum_b factor_b u_b - x_m + x_s) with respect to n
        dealii::Tensor<1, dim> n_gradient = -1. * to_master<dim>(slave, place.surface, positions);
        for (const auto &factor : factors(feet[i], 1., place.masters))
          n_gradient += factor.second * displacement[factor.first];
        // The derivative of a unit vector is symmetric and serves as its own transpose.
        const auto v_gradient =
          forces[i] * faces::unit_vector_derivative(normal.n, normal.length, n_gradient);
        // Differentiate with respect to the positions in the gap, at fixed displacements.
        gradient[slave] += forces[i] * normal.n;
        std::vector<double> by_masters, by_surface;
        for (const auto &point : place.surface)
          {
            gradient[point.first] -= forces[i] * point.second * normal.n;
            by_surface.push_back(-forces[i] *
                                 (normal.n * (positions[point.first] - positions[slave])));
          }
        for (const auto &master : place.masters)
          {
            normal_gradients[master.first] -= master.second * v_gradient;
            by_masters.push_back(-forces[i] * (normal.n * moved(master.first, displacement)) -
                                 v_gradient * normals.normals()[master.first]);
          }
        place.add_transpose(by_masters, by_surface, gradient, normal_gradients);
      }
    normals.add_transpose(normal_gradients, gradient);
  }

  /// Return areas over the whole slave side, also where the master side ends within it. So the
  /// force of a row divided by its area is a mean pressure around its node.
  std::vector<double> areas(const Field &positions) const override
  {
    return faces::tributary_areas<dim>({surface, sides.slave, shape}, slave_nodes, positions);
  }

  void add_area_gradient(const Field               &positions,
                         const std::vector<double> &factors,
                         Field                     &gradient) const override
  {
    faces::add_tributary_gradient<dim>({surface, sides.slave, shape}, slave_nodes, positions,
                                       factors, gradient);
  }

private:
  const mesh::Surface<dim>    &surface;
  const faces::FaceShape<dim> &shape;
  PairFaces                    sides;
  faces::HeldDirections<dim>   held;
  std::vector<Foot<dim>>       feet; ///< one per row
  std::vector<unsigned int>    slave_nodes;
  std::vector<unsigned int>
    zero_area_nodes; ///< slave nodes opposite to the master, but without an area

  /// Return the surface nodes of a row, ascending, and their factors of n in the coefficients. The
  /// factor of the slave is @p of_slave, the factors of masters are -w_k, and masters that hang are
  /// replaced by their own masters. The map sorts the nodes and merges nodes that are reached
  /// twice.
  std::vector<std::pair<unsigned int, double>>
  factors(const Foot<dim> &foot, const double of_slave, const Weights &weights) const
  {
    std::map<unsigned int, double> factor;
    factor[foot.paired.slave] = of_slave;
    for (const auto &node : weights)
      {
        const auto &masters = surface.masters(node.first);
        if (masters.empty())
          factor[node.first] -= node.second;
        for (const auto &master : masters)
          factor[master.first] -= node.second * master.second;
      }
    return {factor.begin(), factor.end()};
  }

  /// Return the displacement of a node, interpolated from its masters if the node hangs.
  dealii::Tensor<1, dim> moved(const unsigned int node, const Field &displacement) const
  {
    const auto &masters = surface.masters(node);
    return masters.empty() ? displacement[node] : weighted<dim>(masters, displacement);
  }

  SupportedNormals<dim> master_normals(const Field &positions) const
  {
    return {surface, sides.master, shape, positions, held};
  }
};
} // namespace

template <int dim>
std::unique_ptr<RowGroup<dim>> nodal_rows(const PairGeometry<dim> &pair)
{
  return std::make_unique<NodalRows<dim>>(pair);
}

template std::unique_ptr<RowGroup<2>> nodal_rows(const PairGeometry<2> &);
template std::unique_ptr<RowGroup<3>> nodal_rows(const PairGeometry<3> &);
} // namespace snug::contact
