#ifndef snug_contact_row_group_h
#define snug_contact_row_group_h

#include <snug/mesh/surface.h>

#include <optional>
#include <utility>
#include <vector>

namespace snug::contact {
/**
 * One row of non-penetration, sum_a c_a . u_a <= gap [length]. Its c_a
 * have no units, so its multiplier is a force: -c_a times it acts on
 * node a.
 */
template <int dim>
struct Row
{
  /// surface nodes, ascending, none of them hanging, and c_a
  std::vector<std::pair<unsigned int, dealii::Tensor<1, dim>>> coefficients;
  double                                                       gap = 0.;
  /// unit normal into the master; -force * normal acts on the slave side
  dealii::Tensor<1, dim> normal;
  /// of a foot that follows: how far it has left its face, in parts of it
  std::optional<double> off_face = {};
};

/// A slave node without a row of its own: the rows that act for it, and
/// their shares, which sum to 1, less where rows are out of reach.
struct SharedNode
{
  unsigned int                                 node; ///< of the surface
  std::vector<std::pair<unsigned int, double>> rows;
};

/**
 * The rows of one contact pair as functions of the positions of the
 * surface nodes (hanging ones included). Which nodes a row reaches is
 * decided by the constructor of a group and stays; coefficients, gaps and
 * areas follow the positions. Rows may share nodes with each other and
 * with those of other groups.
 *
 * Everything is known to all ranks. What takes long, the integrals of mortar
 * rows, is shared out (shared_work()): all functions of positions are
 * collective. They throw TangledMesh where a normal vanishes or a position is
 * not finite.
 */
template <int dim>
class RowGroup
{
public:
  using Field = typename mesh::Surface<dim>::Field;

  virtual ~RowGroup() = default;

  /// The slave node each row stands for: where its force, pressure and gap
  /// are shown. None hangs; their order does not depend on the ranks.
  virtual const std::vector<unsigned int> &slaves() const = 0;

  /// Nodes that others' rows act for; none hangs.
  virtual std::vector<SharedNode> shared_nodes() const { return {}; }

  virtual std::vector<Row<dim>> rows(const Field &positions) const = 0;

  /// Derivatives of the rows along @p velocity, exact: coefficients,
  /// gap and normal of each Row hold the derivatives (same nodes).
  virtual std::vector<Row<dim>> row_derivatives(const Field &positions,
                                                const Field &velocity) const = 0;

  /**
   * gradient_a += d/dX_a sum_i force_i (sum_b c_ib . u_b - gap_i), the
   * contact part of the energy gradient, for all surface nodes: hanging
   * ones count as independent positions.
   */
  virtual void add_energy_gradient(const Field               &positions,
                                   const Field               &displacement,
                                   const std::vector<double> &forces,
                                   Field                     &gradient) const = 0;

  /// Tributary slave area of each row [length^2]: force / area is a
  /// pressure.
  virtual std::vector<double> areas(const Field &positions) const = 0;

  /// gradient_a += d/dX_a sum_i factors_i areas_i, hanging nodes as above.
  virtual void add_area_gradient(const Field               &positions,
                                 const std::vector<double> &factors,
                                 Field                     &gradient) const = 0;
};
} // namespace snug::contact

#endif
