#ifndef snug_state_reference_points_h
#define snug_state_reference_points_h

#include <snug/mesh/tearing.h>
#include <snug/state/gluing_rows.h>
#include <snug/state/ties.h>

#include <optional>

namespace snug::state {
/**
 * This class provides the rows of B on the rigid motions of reference points. The motion of a point
 * p has the unknowns q = (U, L theta) with a length L of the bodies,
 *   u(x) = R(x) q = U + theta x (x - p),
 * in sections of revolution the translation along the axis alone. They are the unknowns of a
 * subdomain without stiffness (feti::SubdomainSystem). A node a of a face that follows the point
 * has the rows u_a - R(x_a) q = 0. A contact row of an obstacle that follows the point gets the
 * motion of the obstacle at the slave nodes, c . (u - R q) <= gap. Both have the entries
 *   -sum_a R(x_a)' c_a
 * on q.
 *
 * A bolt is cut across its shank, and both sides of the cut are tied. The rows of the tied pair get
 * the same entries with the nodes a of the slave side, where R q = q_1 n with the mean normal n of
 * this side. The other unknowns are held. The side moves by q_1 into the other one, which shortens
 * the bolt, and the force on q_1 is its tension. All data are replicated.
 */
template <int dim>
class ReferencePoints
{
public:
  using Field = typename mesh::Surface<dim>::Field;

  /// Find the nodes of the faces that follow the points of @p model, and the cuts of bolts at @p
  /// positions. References must outlive this object. @throws InputError where nodes follow two
  /// points.
  ReferencePoints(const mesh::BodyMesh<dim> &mesh,
                  const mesh::Surface<dim>  &surface,
                  const Model<dim>          &model,
                  const Ties<dim>           &ties,
                  const Field               &positions);

  bool empty() const { return model.points.empty(); }

  /// Return the motion at @p x of the obstacle of a pair, for the motions @p q of all points; zero
  /// if it follows none.
  dealii::Tensor<1, dim> motion_of(const contact::NamedPair               &pair,
                                   const dealii::Tensor<1, dim>           &x,
                                   const std::vector<std::vector<double>> &q) const;

  /// Return @p displacement without the motions @p q of bolts, with which tied sides agree.
  Field without_bolts(const Field                            &positions,
                      Field                                   displacement,
                      const std::vector<std::vector<double>> &q) const;

  /// Return the point that an obstacle follows; nothing if it follows none.
  std::optional<unsigned int> point_of(const std::string &obstacle) const;

  /// Return whether a boundary of a body follows a point.
  bool moves(unsigned int body, unsigned int boundary) const;

  /// Return the rows of the faces, e_c at each node, without their entries on the motions.
  std::vector<contact::Row<dim>> rows() const;

  /// Return the entries on the motions of all rows at @p positions, ascending by row.
  std::vector<PointEntries> entries(const Field                 &positions,
                                    const RowCoefficients<dim>  &rows,
                                    const contact::Contact<dim> &contact) const;

  /// Add the derivatives of the rows of faces and of the entries on the motions along @p velocity
  /// to the derivatives of the other rows. They are exact.
  void differentiate(const Field                 &positions,
                     const Field                 &velocity,
                     const RowCoefficients<dim>  &rows,
                     const contact::Contact<dim> &contact,
                     RowCoefficients<dim>        &derivatives) const;

  /// Return d/dX of -sum_i forces_i sum_a c_ia . R(x_a) q at fixed motions @p q of all points, for
  /// the forces of all rows.
  Field energy_gradient(const Field                            &positions,
                        const std::vector<std::vector<double>> &q,
                        const std::vector<double>              &forces,
                        const RowCoefficients<dim>             &rows,
                        const contact::Contact<dim>            &contact) const;

  /// Return the maximum of |u - R q| over the nodes of the faces that supports hold, where rows
  /// along held directions are left out, and the @p name of its point.
  double parting(const Field                               &positions,
                 const Field                               &displacement,
                 const std::vector<std::vector<double>>    &q,
                 const supports::DirichletConstraints<dim> &held,
                 std::string                               &name) const;

private:
  /// Point of each row with entries on a motion, by RowCoefficients::row().
  std::vector<std::pair<unsigned int, unsigned int>>
  points_of_rows(const RowCoefficients<dim> &rows, const contact::Contact<dim> &contact) const;

  /// Return R(x) of a point.
  qp::MultiVector motions(unsigned int point, const dealii::Tensor<1, dim> &x) const;

  /// Return whether a row with entries on the motion of a point takes the motion of a node of it.
  bool moves_node(unsigned int point, unsigned int node) const
  {
    return !model.points[point].is_bolt() || cuts[point].moved[node];
  }

  void find_followers();
  void find_cut(unsigned int point, const Field &positions);

  /// Slave side of the cut of a bolt.
  struct Cut
  {
    std::vector<bool>      pairs; ///< pairs of the tied contact
    std::vector<bool>      moved; ///< surface nodes
    dealii::Tensor<1, dim> axis;  ///< n
  };

  const mesh::BodyMesh<dim>                         &mesh;
  const Model<dim>                                  &model;
  const mesh::Surface<dim>                          &surface;
  const Ties<dim>                                   &ties;
  std::vector<std::pair<unsigned int, unsigned int>> nodes; ///< (surface node, point)
  std::vector<Cut>                                   cuts;  ///< by point; empty: no bolt
};

/// Return @p tearing with one subdomain without cells for each reference point of @p model, on the
/// last rank, unless it has them already.
template <int dim>
mesh::Tearing
with_points(mesh::Tearing tearing, const mesh::BodyMesh<dim> &mesh, const Model<dim> &model);


/// Return @p model with the length of its reference points, that of the largest body. Collective.
template <int dim>
Model<dim> with_lengths(Model<dim> model, const mesh::BodyMesh<dim> &mesh);
} // namespace snug::state

#endif
