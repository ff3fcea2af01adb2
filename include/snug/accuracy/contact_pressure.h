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

/// The share of a slave node of a pair in the value at a point.
struct NodeShare
{
  unsigned int pair, node;
  double       share;
  bool         on_master; ///< whether the point lies on the master side
};

/// Values at all surface nodes for each pair.
using PairValues = std::vector<std::vector<double>>;

/// Return the sum of the shares times the values. Values on a master side have the factor
/// @p on_master, which is -1 for components of tractions on the slave side.
double value(const std::vector<NodeShare> &shares, const PairValues &values, double on_master = 1.);

/**
 * The sides of contact pairs, on which values of contact rows are functions. On a slave side they
 * interpolate the values of the rows at its nodes by the shape functions, with 0 at nodes without a
 * row. On a master side the value is that at the closest point of the slave side, and 0 beyond the
 * end of the slave side. A point is searched for only once, whatever the number of functions.
 */
template <int dim>
class ContactSides
{
public:
  using Face = typename mesh::BodyMesh<dim>::Face;

  /// Use the geometry of @p state. References must outlive this object. Collective.
  ContactSides(const state::StateSolver<dim>  &solver,
               const contact::Contact<dim>    &contact,
               const state::ContactState<dim> &state);
  ~ContactSides();

  /// Return the values at the nodes of all pairs from values in the order of the contact rows,
  /// which need not be pressures; none from no values.
  PairValues values(const std::vector<double> &of_rows) const;

  /// Return whether a face lies on a side of a pair.
  bool is_on(const Face &face) const;

  /// Return the shares of the nodes at the point @p x of a face. @p shape are the shape functions
  /// of the nodes of its cell at the point.
  std::vector<NodeShare>
  shares(const Face &face, const std::vector<double> &shape, const dealii::Tensor<1, dim> &x) const;

  /// Return the shares at the point of the slave side of a pair closest to @p x in space; none
  /// beyond the end of the slave side.
  std::vector<NodeShare> closest(unsigned int pair, const dealii::Tensor<1, dim> &x) const;

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
