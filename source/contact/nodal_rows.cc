#include <snug/base/errors.h>
#include <snug/contact/pair_rows.h>
#include <snug/contact/projection.h>
#include <snug/contact/supported_normals.h>
#include <snug/faces/tributary.h>

#include <algorithm>
#include <map>

namespace snug::contact {
namespace {
/// n = v/|v|, v = -sum_k w_k n_k
template <int dim>
struct RowNormal
{
  dealii::Tensor<1, dim> n;
  double                 length; ///< |v|
};

template <int dim>
using SurfaceField = typename mesh::Surface<dim>::Field;

/// sum_k w_k field_k
template <int dim>
dealii::Tensor<1, dim> weighted(const Projection::Weights &weights, const SurfaceField<dim> &field)
{
  dealii::Tensor<1, dim> sum;
  for (const auto &point : weights)
    sum += point.second * field[point.first];
  return sum;
}

/// From the slave to the true surface of the master, or its derivative.
template <int dim>
dealii::Tensor<1, dim> to_master(const Projection &projection, const SurfaceField<dim> &field)
{
  return weighted<dim>(projection.surface, field) - field[projection.slave];
}

template <int dim>
RowNormal<dim> row_normal(const Projection &projection, const SurfaceField<dim> &nodal_normals)
{
  // Nodal normals point out of the master; those of rows into it.
  const dealii::Tensor<1, dim> v      = -1. * weighted<dim>(projection.masters, nodal_normals);
  const double                 length = v.norm();
  if (!(length > 0.))
    throw TangledMesh("the normals of a contact face cancel: it is folded");
  return {v / length, length};
}

/// The row whose coefficients are @p factors times @p n.
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

  /// Slave nodes that hang have no row (project() leaves them out): they move with their masters,
  /// whose rows hold them, and a row of their own would be nearly a combination of those.
  explicit NodalRows(const PairGeometry<dim> &pair)
    : surface(pair.surface), shape(pair.shape), sides(pair.sides), held(pair.held)
  {
    const Opposition<dim> opposition(pair);
    const auto            normals = master_normals(pair.positions);
    for (const Projection &projection :
         project(surface, sides, shape, pair.positions, normals.normals()))
      {
        const unsigned int slave    = projection.slave;
        const double       distance = to_master<dim>(projection, pair.positions).norm();
        const auto         n        = row_normal<dim>(projection, normals.normals()).n;
        // The distance counts on both sides: a deep overlap is as far away as a wide gap.
        if (pair.taken[slave] || !opposition.holds(slave, distance, n))
          continue;
        if (faces::is_without_area(surface, shape.degree(), pair.positions[slave]))
          {
            idle.push_back(slave);
            continue;
          }
        found.push_back(projection);
        slave_nodes.push_back(slave);
      }
    resolve_hanging();
  }

  const std::vector<unsigned int> &slaves() const override { return slave_nodes; }

  /// Where a node is without an area, on the axis, the parabola through the other nodes of the face
  /// that is level there has (4 p_1 - p_2) / 3.
  std::vector<SharedNode> shared_nodes() const override
  {
    std::map<unsigned int, unsigned int> rows_of;
    for (unsigned int i = 0; i < slave_nodes.size(); ++i)
      rows_of[slave_nodes[i]] = i;
    std::vector<SharedNode> result;
    for (const unsigned int f : sides.slave)
      for (const unsigned int node : idle)
        {
          auto nodes = surface.faces()[f].nodes;
          if (nodes.back() == node)
            std::reverse(nodes.begin(), nodes.end());
          if (nodes.front() == node && nodes.size() == 3 && rows_of.count(nodes[1]) > 0 &&
              rows_of.count(nodes[2]) > 0)
            result.push_back({node, {{rows_of[nodes[1]], 4. / 3.}, {rows_of[nodes[2]], -1. / 3.}}});
        }
    return result;
  }

  std::vector<Row<dim>> rows(const Field &positions) const override
  {
    const auto            normals = master_normals(positions);
    std::vector<Row<dim>> result;
    for (unsigned int i = 0; i < found.size(); ++i)
      {
        const auto n = row_normal<dim>(found[i], normals.normals()).n;
        // With the positions of the hanging nodes themselves: the gap is that of the mesh as it is.
        const double gap = n * to_master<dim>(found[i], positions) + found[i].relief;
        result.push_back(make_row(factors[i], n, gap));
      }
    return result;
  }

  std::vector<Row<dim>> row_derivatives(const Field &positions,
                                        const Field &velocity) const override
  {
    const auto            normals     = master_normals(positions);
    const auto            derivatives = normals.derivative(velocity);
    std::vector<Row<dim>> result;
    for (unsigned int i = 0; i < found.size(); ++i)
      {
        const auto                  &projection = found[i];
        const auto                   normal     = row_normal<dim>(projection, normals.normals());
        const dealii::Tensor<1, dim> dv = -1. * weighted<dim>(projection.masters, derivatives);
        // Weights are frozen, so only the nodal normals change v.
        const auto   dn   = faces::unit_vector_derivative(normal.n, normal.length, dv);
        const double dgap = dn * to_master<dim>(projection, positions) +
                            normal.n * to_master<dim>(projection, velocity);
        result.push_back(make_row(factors[i], dn, dgap));
      }
    return result;
  }

  void add_energy_gradient(const Field               &positions,
                           const Field               &displacement,
                           const std::vector<double> &forces,
                           Field                     &gradient) const override
  {
    AssertDimension(forces.size(), found.size());
    const auto normals = master_normals(positions);
    Field      normal_gradients(surface.n_nodes());
    for (unsigned int i = 0; i < found.size(); ++i)
      {
        const auto &projection = found[i];
        const auto  normal     = row_normal<dim>(projection, normals.normals());
        // d/dn of n . (sum_b factor_b u_b - x_m + x_s)
        dealii::Tensor<1, dim> n_gradient = -1. * to_master<dim>(projection, positions);
        for (const auto &factor : factors[i])
          n_gradient += factor.second * displacement[factor.first];
        // The derivative of a unit vector is symmetric and serves as its own transpose.
        const auto v_gradient =
          forces[i] * faces::unit_vector_derivative(normal.n, normal.length, n_gradient);
        // By the positions in the gap; displacements are fixed.
        gradient[projection.slave] += forces[i] * normal.n;
        for (const auto &point : projection.surface)
          gradient[point.first] -= forces[i] * point.second * normal.n;
        for (const auto &master : projection.masters)
          normal_gradients[master.first] -= master.second * v_gradient;
      }
    normals.add_transpose(normal_gradients, gradient);
  }

  /// Over the whole slave side, also where the master side ends within it: the force of a row
  /// divided by this area is a mean pressure around its node.
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
  std::vector<Projection>      found;
  std::vector<unsigned int>    slave_nodes;
  std::vector<unsigned int>    idle; ///< slave nodes opposite to the master, but without an area
  /// of each row: surface nodes, ascending, and their factors of n in the
  /// coefficients: 1 (slave) or -w (masters, none hanging)
  std::vector<std::vector<std::pair<unsigned int, double>>> factors;

  /// factors: 1 at the slave, -w_k at the masters, those that hang replaced by their own masters.
  /// The map merges nodes that are reached twice and sorts them.
  void resolve_hanging()
  {
    for (const Projection &projection : found)
      {
        std::map<unsigned int, double> factor;
        factor[projection.slave] = 1.;
        for (const auto &node : projection.masters)
          {
            const auto &masters = surface.masters(node.first);
            if (masters.empty())
              factor[node.first] -= node.second;
            for (const auto &master : masters)
              factor[master.first] -= node.second * master.second;
          }
        factors.emplace_back(factor.begin(), factor.end());
      }
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
