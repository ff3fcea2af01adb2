#ifndef snug_contact_row_group_h
#define snug_contact_row_group_h

#include <snug/mesh/surface.h>

#include <optional>
#include <utility>
#include <vector>

namespace snug::contact {
/**
 * One row of non-penetration, sum_a c_a . u_a <= gap [length]. The coefficients c_a have no units,
 * so the multiplier of the row is a force: -c_a times the multiplier acts on node a.
 */
template <int dim, typename Number = double>
struct Row
{
  /// surface nodes, ascending and without hanging nodes, and c_a
  std::vector<std::pair<unsigned int, dealii::Tensor<1, dim, Number>>> coefficients;
  Number                                                               gap = 0.;
  /// unit normal into the master; -force * normal acts on the slave side
  dealii::Tensor<1, dim, Number> normal;
  /// only for a moving foot point: distance off its face, as a fraction of the face
  std::optional<double> off_face = {};
};

/// Derivatives of a scalar with respect to the numbers of a Row.
template <int dim>
struct RowSlopes
{
  /// in the order of Row::coefficients; empty: the scalar does not depend on the row
  std::vector<dealii::Tensor<1, dim>> coefficients;
  double                              gap = 0.;
  dealii::Tensor<1, dim>              normal;
};

/// A slave node without a row of its own, with the rows that act for it and their shares. The
/// shares sum to 1, or to less where rows are out of reach.
struct DependentMultiplier
{
  unsigned int                                 node; ///< surface node
  std::vector<std::pair<unsigned int, double>> rows;
};

/**
 * This class is the interface of the rows of one contact pair as functions of the positions of the
 * surface nodes (hanging nodes included). The constructor of a group decides which nodes a row
 * couples, and this choice stays. Coefficients, gaps and areas follow the positions. Rows may share
 * nodes with each other and with rows of other groups.
 *
 * All ranks know all data. The expensive integrals of mortar rows are distributed over the ranks
 * (shared_work()), so all functions of positions are collective. All functions of positions throw
 * TangledMesh where a normal vanishes or a position is not finite.
 */
template <int dim>
class RowGroup
{
public:
  using Field = typename mesh::Surface<dim>::Field;

  virtual ~RowGroup() = default;

  /// Return the slave node of each row, at which the force, pressure and gap of the row are shown.
  /// No slave node hangs, and the order of the slave nodes does not depend on the ranks.
  virtual const std::vector<unsigned int> &slaves() const = 0;

  /// Return the nodes for which rows of other nodes act. None of these nodes hangs.
  virtual std::vector<DependentMultiplier> dependent_multipliers() const { return {}; }

  virtual std::vector<Row<dim>> rows(const Field &positions) const = 0;

  /// Return the exact derivatives of the rows along @p velocity. The coefficients, gap and normal
  /// of each Row hold the derivatives, for the same nodes as in rows().
  virtual std::vector<Row<dim>> row_derivatives(const Field &positions,
                                                const Field &velocity) const = 0;

  /// Add d/dX of a scalar for all points X of the surface. @p slopes are the derivatives of the
  /// scalar with respect to the rows. Hanging nodes count as independent positions.
  virtual void add_gradient(const Field                       &positions,
                            const std::vector<RowSlopes<dim>> &slopes,
                            Field                             &gradient) const = 0;

  /// Return the tributary slave area of each row [length^2]; force / area is a pressure.
  virtual std::vector<double> areas(const Field &positions) const = 0;

  /// Return the derivatives of the areas along @p velocity.
  virtual std::vector<double> area_derivatives(const Field &positions,
                                               const Field &velocity) const = 0;

  /// Add gradient_a += d/dX_a sum_i factors_i areas_i. Hanging nodes count as independent
  /// positions.
  virtual void add_area_gradient(const Field               &positions,
                                 const std::vector<double> &factors,
                                 Field                     &gradient) const = 0;
};
} // namespace snug::contact

#endif
