#ifndef snug_contact_pair_geometry_h
#define snug_contact_pair_geometry_h

#include <snug/contact/pair.h>
#include <snug/contact/row_group.h>
#include <snug/faces/face_shape.h>
#include <snug/faces/held_directions.h>
#include <snug/geometry/rigid_motion.h>

#include <cmath>
#include <functional>

namespace snug::contact {
/// Return the faces of a side in ascending order, so that the order of rows does not depend on the
/// ranks.
template <int dim>
std::vector<unsigned int> faces_of(const mesh::Surface<dim> &surface, const Side &side);

/// Return the mean edge length of @p faces [length]. The edge length of a face is its diagonal
/// divided by sqrt(dim-1).
template <int dim>
double mean_face_size(const mesh::Surface<dim>                 &surface,
                      const std::vector<unsigned int>          &faces,
                      const typename mesh::Surface<dim>::Field &positions);

/// Return the maximum distance of the true surface of @p side from its faces, measured along the
/// normals of the faces, at the reference [length]; 0 if it is round-off.
template <int dim>
double face_height(const mesh::Surface<dim>    &surface,
                   const faces::FaceShape<dim> &shape,
                   const Side                  &side);

/// Indices of the surface faces of the two sides of a pair.
struct PairFaces
{
  std::vector<unsigned int> slave, master;
};

/**
 * Data from which the rows of a pair are made. After they are made, rows may refer only to the
 * surface and to the shape.
 */
template <int dim>
struct PairGeometry
{
  using Field = typename mesh::Surface<dim>::Field;

  const mesh::Surface<dim>    &surface;
  const faces::FaceShape<dim> &shape;
  const Pair                  &pair;
  PairFaces                    sides;
  const Field                 &positions;
  /// directions that supports hold, per surface node
  const faces::HeldDirections<dim> &held;
  /// surface nodes with a row against this master in another pair; a second row would be nearly the
  /// same
  std::vector<bool>          taken;
  geometry::RigidMotion<dim> slave_motion;    ///< of the slave's body, to the position
  geometry::RigidMotion<dim> obstacle_motion; ///< of the obstacle, to the position

  /// Return the obstacle of the pair at its position.
  std::unique_ptr<Obstacle<dim>> obstacle() const;
  /// Return the displacement that the scene prescribes for the obstacle, at its position [length].
  dealii::Tensor<1, dim> obstacle_displacement() const;

  /// Return whether points are paired along the mean of the normals of both sides, PairNormals.
  /// Against obstacles they are paired along the normal of the obstacle.
  bool has_mean_normals() const { return pair.parameters.has_friction() && !pair.obstacle; }

  /// Return the mean edge length of the slave faces [length].
  double slave_size() const { return mean_face_size(surface, sides.slave, positions); }
};

/// Return the coefficient or the bound of the friction of a pair as a function of the reference
/// position.
template <int dim>
std::function<double(const dealii::Point<dim> &)> resistance(const Pair &pair);

/// Return the edge length, as in mean_face_size(), of the largest face at each surface node. A
/// triangle with quadratic functions counts as one face, with the mean of its edges.
template <int dim>
std::vector<double> node_face_sizes(const mesh::Surface<dim>                 &surface,
                                    const typename mesh::Surface<dim>::Field &positions);

/**
 * Return the slave nodes without an area, with the rows of other nodes that act for them. @p slaves
 * are the nodes of the rows, and @p zero_area_nodes are the nodes without an area.
 * - On the axis of revolution the parabola through the other two nodes of the face that has slope 0
 *   on the axis has the value (4 p_1 - p_2) / 3.
 * - Corners of quadratic triangles take the mean of the middles of the edges at the corner.
 */
template <int dim>
std::vector<DependentMultiplier>
dependent_without_area(const mesh::Surface<dim>        &surface,
                       const std::vector<unsigned int> &faces,
                       const std::vector<unsigned int> &slaves,
                       const std::vector<unsigned int> &zero_area_nodes);

/// This class checks whether slave nodes and their opposite points on the master are close enough
/// and face each other.
template <int dim>
class SearchCriteria
{
public:
  explicit SearchCriteria(const PairGeometry<dim> &pair);

  /// Return whether the absolute value of @p distance is within the search distance, up to
  /// round-off.
  bool is_near(double distance) const { return std::abs(distance) <= largest_distance; }

  /// Return whether the node is near and its normal is within the largest angle to the unit
  /// @p normal into the master.
  bool are_met(unsigned int slave, double distance, const dealii::Tensor<1, dim> &normal) const
  {
    return is_near(distance) && normals[slave] * normal >= least_cosine;
  }

private:
  typename mesh::Surface<dim>::Field normals; ///< nodal normals of the slave side
  double                             largest_distance, least_cosine;
};
} // namespace snug::contact

#endif
