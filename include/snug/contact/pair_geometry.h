#ifndef snug_contact_pair_geometry_h
#define snug_contact_pair_geometry_h

#include <snug/contact/pair.h>
#include <snug/contact/row_group.h>
#include <snug/faces/face_shape.h>
#include <snug/faces/held_directions.h>

#include <cmath>

namespace snug::contact {
/// The faces of a side, ascending, so that the order of rows does not depend on the ranks.
template <int dim>
std::vector<unsigned int> faces_of(const mesh::Surface<dim> &surface, const Side &side);

/// Mean edge length of @p faces: diagonal over sqrt(dim-1) [length].
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

/// The two sides of a pair: indices of surface faces.
struct PairFaces
{
  std::vector<unsigned int> slave, master;
};

/**
 * What the rows of a pair are made from. Only the surface and the shape
 * may be referred to beyond the making of the rows.
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
  /// what supports hold, per surface node
  const faces::HeldDirections<dim> &held;
  /// surface nodes with a row against this master by an earlier pair: a
  /// second one would be the same
  std::vector<bool> taken;

  /// Mean edge length of the slave faces.
  double slave_size() const { return mean_face_size(surface, sides.slave, positions); }
};

/// Edge length, as of mean_face_size(), of the largest face at each surface node.
template <int dim>
std::vector<double> node_face_sizes(const mesh::Surface<dim>                 &surface,
                                    const typename mesh::Surface<dim>::Field &positions);

/// Slave nodes without an area, on the axis of revolution, that the rows of other nodes act for:
/// the parabola through the other two nodes of the face that is level there has
/// (4 p_1 - p_2) / 3. @p slaves are the nodes of the rows, @p idle those without an area.
template <int dim>
std::vector<SharedNode> shared_on_axis(const mesh::Surface<dim>        &surface,
                                       const std::vector<unsigned int> &faces,
                                       const std::vector<unsigned int> &slaves,
                                       const std::vector<unsigned int> &idle);

/// Whether slave nodes and what they were found to be opposite to are
/// close enough and face each other.
template <int dim>
class Opposition
{
public:
  explicit Opposition(const PairGeometry<dim> &pair);

  /// Whether the size of @p distance is within the search distance, up to
  /// round-off.
  bool is_near(double distance) const { return std::abs(distance) <= largest_distance; }

  /// Also for the unit @p normal into the master.
  bool holds(unsigned int slave, double distance, const dealii::Tensor<1, dim> &normal) const
  {
    return is_near(distance) && normals[slave] * normal >= least_cosine;
  }

private:
  typename mesh::Surface<dim>::Field normals; ///< of the slave side
  double                             largest_distance, least_cosine;
};
} // namespace snug::contact

#endif
