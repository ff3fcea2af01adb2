#ifndef snug_accuracy_contact_pressure_h
#define snug_accuracy_contact_pressure_h

#include <snug/state/state_solver.h>

#include <map>
#include <memory>
#include <vector>

namespace snug::accuracy {
/// Return values at all surface nodes from the values @p of_rows of the rows of a pair. A node
/// takes the value of its row, or of the rows that act for the node. Hanging nodes take
/// interpolated values, all other nodes take 0.
template <int dim>
std::vector<double> nodal_values(const state::StateSolver<dim> &solver,
                                 const contact::Contact<dim>   &contact,
                                 unsigned int                   pair,
                                 const std::vector<double>     &of_rows);

/**
 * The pressure of contact rows as a function on both sides of their pairs [force / length^2]. On a
 * slave side it interpolates the pressures of the rows at its nodes by the shape functions, with 0
 * at nodes without a row. On a master side it is the pressure at the closest point of the slave
 * side, and 0 beyond the end of the slave side. The values per row need not be pressures.
 */
template <int dim>
class ContactPressure
{
public:
  using Face = typename mesh::BodyMesh<dim>::Face;

  /// @p of_rows are in the order of the rows of @p contact, in the geometry of @p state. References
  /// must outlive this object. Collective.
  ContactPressure(const state::StateSolver<dim>  &solver,
                  const contact::Contact<dim>    &contact,
                  const state::ContactState<dim> &state,
                  const std::vector<double>      &of_rows);
  ~ContactPressure();

  /// Return whether a face lies on a side of a pair.
  bool is_on(const Face &face) const;

  /// Return the value at the point @p x of a face. @p shape are the shape functions of the nodes
  /// of its cell at the point. Values on the master side have the factor @p on_master, which is -1
  /// for components of tractions on the slave side.
  double value(const Face                   &face,
               const std::vector<double>    &shape,
               const dealii::Tensor<1, dim> &x,
               double                        on_master = 1.) const;

  /// Return the value of a pair at the point of its slave side closest to @p x in space; 0 beyond
  /// the end of the slave side.
  double on_slave_side(unsigned int pair, const dealii::Tensor<1, dim> &x) const;

private:
  class SlaveSide;
  using Boundary = std::pair<unsigned int, unsigned int>; ///< body and boundary

  const state::StateSolver<dim>          &solver;
  const contact::Contact<dim>            &contact;
  typename mesh::Surface<dim>::Field      positions; ///< in space
  faces::FaceShape<dim>                   shape;
  std::vector<std::unique_ptr<SlaveSide>> pairs;

  std::map<Boundary, std::vector<unsigned int>> slave_of, master_of; ///< indices of pairs
};
} // namespace snug::accuracy

#endif
