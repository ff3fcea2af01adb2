#include <snug/base/errors.h>
#include <snug/contact/node_rows.h>
#include <snug/contact/normal_projection.h>
#include <snug/contact/pair_rows.h>

#include <map>

namespace snug::contact {
namespace {
/// Return sum_k w_k field_k.
template <int dim, typename Number>
dealii::Tensor<1, dim, Number> weighted(const WeightsAs<Number>              &weights,
                                        const faces::PointField<dim, Number> &field)
{
  dealii::Tensor<1, dim, Number> sum;
  for (const auto &point : weights)
    sum += point.second * field[point.first];
  return sum;
}

/// Return the vector from the @p slave to the true surface of the master, by the weights of its
/// points.
template <int dim, typename Number>
dealii::Tensor<1, dim, Number> to_master(const unsigned int                    slave,
                                         const WeightsAs<Number>              &surface,
                                         const faces::PointField<dim, Number> &positions)
{
  return weighted(surface, positions) - positions[slave];
}

/// Return the unit normal of the master at its point with the weights @p masters, into the master.
template <int dim>
dealii::Tensor<1, dim> master_normal(const Weights                           &masters,
                                     const typename PairNormals<dim>::Fields &normals)
{
  return unit_normal<dim, double>(
    -weighted(masters, faces::PointField<dim, double>(normals.master)));
}

/// The formula of nodal rows for NodeRows.
template <int dim>
class NodalRow
{
public:
  /// Find the slave nodes with rows. Slave nodes that hang have no row (project() leaves them out).
  /// They move with their masters, whose rows hold them. A row of a hanging node would be nearly a
  /// combination of the rows of its masters.
  explicit NodalRow(const PairGeometry<dim> &pair) : surface(pair.surface)
  {
    const SearchCriteria<dim>            criteria(pair);
    const PairNormals<dim>               normals(pair);
    const faces::PointField<dim, double> x(pair.positions);
    const auto                           without_area =
      faces::nodes_without_area<dim>({surface, pair.sides.slave, pair.shape}, pair.positions);
    for (const Projection<dim> &projection :
         project(surface, pair.sides, pair.shape, pair.positions, normals.values()))
      {
        const unsigned int slave    = projection.slave;
        const double       distance = to_master(slave, projection.surface, x).norm();
        // Check the distance on both sides, because a deep overlap is as far away as a wide gap.
        if (pair.taken[slave] ||
            !criteria.are_met(slave, distance,
                              master_normal<dim>(projection.masters, normals.values())))
          continue;
        if (without_area[slave])
          {
            nodes.zero_area.push_back(slave);
            continue;
          }
        projections.emplace_back(surface, pair.shape, projection, pair.positions, normals.values());
        nodes.with_rows.push_back(slave);
      }
    projections.shrink_to_fit();
  }

  SlaveNodes nodes;

  template <typename Number>
  Row<dim, Number> row(const unsigned int                    i,
                       const faces::PointField<dim, Number> &positions,
                       const NormalFields<dim, Number>      &normals) const
  {
    const auto      &paired = projections[i].paired;
    const auto       here   = projections[i].at(positions, normals);
    Row<dim, Number> result;
    result.normal = here.normal;
    // Use the positions of the hanging nodes themselves, because the gap is that of the actual
    // mesh.
    result.gap =
      result.normal * to_master(paired.slave, here.surface, positions) + paired.softening;
    result.off_face = here.off_face;
    for (const auto &[node, factor] : factors(paired.slave, here.masters))
      result.coefficients.emplace_back(node, factor * result.normal);
    return result;
  }

private:
  const mesh::Surface<dim>          &surface;
  std::vector<NormalProjection<dim>> projections; ///< one per row

  /// Return the surface nodes of a row, ascending, and their factors of n in the coefficients. The
  /// factor of the slave is 1, the factors of masters are -w_k, and masters that hang are replaced
  /// by their own masters. The map sorts the nodes and merges nodes that are reached twice.
  template <typename Number>
  std::map<unsigned int, Number> factors(const unsigned int       slave,
                                         const WeightsAs<Number> &weights) const
  {
    std::map<unsigned int, Number> factor;
    factor[slave] = 1.;
    for (const auto &node : weights)
      {
        const auto &masters = surface.masters(node.first);
        if (masters.empty())
          factor[node.first] -= node.second;
        for (const auto &master : masters)
          factor[master.first] -= node.second * master.second;
      }
    return factor;
  }
};
} // namespace

template <int dim>
std::unique_ptr<RowGroup<dim>> nodal_rows(const PairGeometry<dim> &pair)
{
  return std::make_unique<NodeRows<dim, NodalRow<dim>>>(pair);
}

template std::unique_ptr<RowGroup<2>> nodal_rows(const PairGeometry<2> &);
template std::unique_ptr<RowGroup<3>> nodal_rows(const PairGeometry<3> &);
} // namespace snug::contact
