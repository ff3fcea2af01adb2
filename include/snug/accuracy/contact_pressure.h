#ifndef snug_accuracy_contact_pressure_h
#define snug_accuracy_contact_pressure_h

#include <snug/state/state_solver.h>

#include <map>
#include <memory>
#include <vector>

namespace snug::accuracy {
/// Values at all surface nodes of what is given for the rows of a pair: that of the row, or of
/// those that act for the node, or interpolated at hanging nodes; 0 elsewhere.
template <int dim>
std::vector<double> nodal_values(const state::StateSolver<dim> &solver,
                                 unsigned int                   pair,
                                 const std::vector<double>     &of_rows);

/**
 * The pressure of contact rows as a function on both sides of their pairs
 * [force / length^2]: on a slave side that of the rows at its nodes and between them
 * as the shape functions say, 0 at nodes without one; on a master side that of the closest point of
 * the slave side, and 0 beyond its end. Any numbers per row may stand for the pressures.
 */
template <int dim>
class ContactPressure
{
public:
  using Face = typename mesh::BodyMesh<dim>::Face;

  /// @p of_rows: in the order of the contact rows; positions of the local nodes.
  /// The solver must outlive this. Collective.
  ContactPressure(const state::StateSolver<dim>             &solver,
                  const typename mesh::BodyMesh<dim>::Field &positions,
                  const std::vector<double>                 &of_rows);
  ~ContactPressure();

  /// Whether a face lies on a side of a pair.
  bool is_on(const Face &face) const;

  /// At the point @p x of a face, at which the shape functions of the nodes of its cell are
  /// @p shape.
  double
  value(const Face &face, const std::vector<double> &shape, const dealii::Tensor<1, dim> &x) const;

  /// Of a pair, at the point of its slave side closest to @p x; 0 beyond its end.
  double on_slave_side(unsigned int pair, const dealii::Tensor<1, dim> &x) const;

private:
  class SlaveSide;
  using Boundary = std::pair<unsigned int, unsigned int>; ///< of a body

  const state::StateSolver<dim>          &solver;
  typename mesh::Surface<dim>::Field      positions;
  faces::FaceShape<dim>                   shape;
  std::vector<std::unique_ptr<SlaveSide>> pairs;

  std::map<Boundary, std::vector<unsigned int>> slave_of, master_of; ///< pairs
};
} // namespace snug::accuracy

#endif
