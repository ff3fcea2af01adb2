#ifndef snug_contact_node_rows_h
#define snug_contact_node_rows_h

#include <snug/base/assertions.h>
#include <snug/contact/pair_geometry.h>
#include <snug/contact/pair_normals.h>
#include <snug/contact/row_derivatives.h>
#include <snug/faces/point_field.h>
#include <snug/faces/tributary.h>

namespace snug::contact {
/// Slave nodes of a pair: nodes with rows, and nodes without rows that lie opposite to the master
/// with zero tributary area, see faces::nodes_without_area().
struct SlaveNodes
{
  std::vector<unsigned int> with_rows, zero_area;
};

/**
 * This class provides the rows of slave nodes, one row per node. The class @p Formula selects
 * the nodes when it is constructed from a PairGeometry, and defines the row as a function of the
 * positions of points and of the PairNormals. Derivatives are computed by evaluating row() with
 * numbers that carry or record derivatives:
 *   Formula(const PairGeometry<dim> &pair)
 *   SlaveNodes nodes
 *   Row<dim, Number> row(unsigned int i, const faces::PointField<dim, Number> &positions,
 *                        const NormalFields<dim, Number> &normals) const
 */
template <int dim, typename Formula>
class NodeRows : public RowGroup<dim>
{
public:
  using Field = typename RowGroup<dim>::Field;

  explicit NodeRows(const PairGeometry<dim> &pair)
    : surface(pair.surface)
    , shape(pair.shape)
    , sides(pair.sides)
    , has_mean_normals(pair.has_mean_normals())
    , held(pair.held)
    , formula(pair)
    , nodes(formula.nodes)
  {}

  const std::vector<unsigned int> &slaves() const override { return nodes.with_rows; }

  std::vector<DependentMultiplier> dependent_multipliers() const override
  {
    return dependent_without_area(surface, sides.slave, nodes.with_rows, nodes.zero_area);
  }

  std::vector<Row<dim>> rows(const Field &positions) const override
  {
    const auto                           normals = pair_normals(positions);
    const auto                          &values  = normals.values();
    const faces::PointField<dim, double> x(positions), n(values.master), m(values.slave);
    std::vector<Row<dim>>                result;
    for (unsigned int i = 0; i < nodes.with_rows.size(); ++i)
      result.push_back(formula.row(i, x, NormalFields<dim, double>{n, m}));
    return result;
  }

  std::vector<Row<dim>> row_derivatives(const Field &positions,
                                        const Field &velocity) const override
  {
    using Number                                 = faces::Differential<1>;
    const auto                           normals = pair_normals(positions);
    const auto                           slopes  = normals.derivative(velocity);
    const auto                          &values  = normals.values();
    const faces::PointField<dim, Number> x(positions, velocity), n(values.master, slopes.master),
      m(values.slave, slopes.slave);
    std::vector<Row<dim>> result;
    for (unsigned int i = 0; i < nodes.with_rows.size(); ++i)
      result.push_back(derivative_of(formula.row(i, x, NormalFields<dim, Number>{n, m})));
    return result;
  }

  void add_gradient(const Field                       &positions,
                    const std::vector<RowSlopes<dim>> &slopes,
                    Field                             &gradient) const override
  {
    SNUG_ASSERT_EQUAL(slopes.size(), nodes.with_rows.size());
    const auto                        normals = pair_normals(positions);
    typename PairNormals<dim>::Fields of_normals{Field(surface.n_nodes()),
                                                 Field(surface.n_nodes())};
    faces::Recording                  recording;
    for (unsigned int i = 0; i < slopes.size(); ++i)
      {
        if (slopes[i].coefficients.empty())
          continue;
        recording.clear();
        const faces::PointField<dim, faces::Recorded> x(positions, recording),
          n(normals.values().master, recording), m(normals.values().slave, recording);
        add_slopes(formula.row(i, x, NormalFields<dim, faces::Recorded>{n, m}), slopes[i],
                   recording);
        recording.sweep();
        x.add_derivatives(gradient);
        n.add_derivatives(of_normals.master);
        m.add_derivatives(of_normals.slave);
      }
    normals.add_transpose(of_normals, gradient);
  }

  /// Return areas over the whole slave side, also where the master side ends within it. So the
  /// force of a row divided by its area is a mean pressure around its node.
  std::vector<double> areas(const Field &positions) const override
  {
    return tributary_areas(faces::PointField<dim, double>(positions));
  }

  std::vector<double> area_derivatives(const Field &positions, const Field &velocity) const override
  {
    return slopes_of(
      tributary_areas(faces::PointField<dim, faces::Differential<1>>(positions, velocity)));
  }

  void add_area_gradient(const Field               &positions,
                         const std::vector<double> &factors,
                         Field                     &gradient) const override
  {
    faces::add_tributary_gradient<dim>({surface, sides.slave, shape}, nodes.with_rows, positions,
                                       factors, gradient);
  }

private:
  const mesh::Surface<dim>    &surface;
  const faces::FaceShape<dim> &shape;
  PairFaces                    sides; ///< obstacles have no master faces
  bool                         has_mean_normals;
  faces::HeldDirections<dim>   held;
  Formula                      formula;
  const SlaveNodes            &nodes;

  template <typename Number>
  std::vector<Number> tributary_areas(const faces::PointField<dim, Number> &x) const
  {
    return faces::tributary_areas<dim>({surface, sides.slave, shape}, nodes.with_rows, x);
  }

  PairNormals<dim> pair_normals(const Field &positions) const
  {
    return {surface, shape, sides, has_mean_normals, positions, held};
  }
};
} // namespace snug::contact

#endif
