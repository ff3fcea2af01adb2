#ifndef snug_contact_pair_normals_h
#define snug_contact_pair_normals_h

#include <snug/base/errors.h>
#include <snug/contact/pair_geometry.h>
#include <snug/faces/nodal_normals.h>
#include <snug/faces/point_field.h>

#include <cmath>
#include <optional>

namespace snug::contact {
/// Return v / |v| of a sum @p v of normals.
/// @throws TangledMesh if v = 0
template <int dim, typename Number>
dealii::Tensor<1, dim, Number> unit_normal(const dealii::Tensor<1, dim, Number> &v)
{
  using std::sqrt;
  const Number length = sqrt(v * v);
  if (!(faces::value_of(length) > 0.))
    throw TangledMesh("the normals of a contact face cancel: it is folded");
  return v / length;
}

/// Normals of the nodes of both sides as numbers of a type.
template <int dim, typename Number>
struct NormalFields
{
  const faces::PointField<dim, Number> &master, &slave;
};

/**
 * This class holds the normals along which the points of two sides are paired, as functions of the
 * positions: NodalNormals of the master, n_k, and of the slave, n_s. A point of the slave is paired
 * with a point of the master along v = sum_k w_k n_k - n_s. For pairs with friction this is the
 * mean of both normals. The surface on which two bodies of equal material meet has the mean of
 * their curvatures (theory.md, section 17), so that a gap closes along this mean without slip. For
 * other pairs n_s is 0, and v is the normal of the master.
 */
template <int dim>
class PairNormals
{
public:
  using Field = typename mesh::Surface<dim>::Field;

  /// Normals of nodes, or vectors that belong to them; zero at nodes of other faces.
  struct Fields
  {
    Field master, slave;
  };

  /// Compute the normals at @p positions. The references must outlive this object.
  PairNormals(const mesh::Surface<dim>         &surface,
              const faces::FaceShape<dim>      &shape,
              const PairFaces                  &sides,
              bool                              are_means,
              const Field                      &positions,
              const faces::HeldDirections<dim> &held)
    : master(surface, sides.master, shape, positions, &held), fields{master.normals(), {}}
  {
    if (are_means)
      slave.emplace(surface, sides.slave, shape, positions, &held);
    fields.slave = slave ? slave->normals() : Field(surface.n_nodes());
  }

  /// Compute the normals of @p pair. The data to which it refers must outlive this object.
  explicit PairNormals(const PairGeometry<dim> &pair)
    : PairNormals(pair.surface,
                  pair.shape,
                  pair.sides,
                  pair.has_mean_normals(),
                  pair.positions,
                  pair.held)
  {}

  const Fields &values() const { return fields; }

  /// Return the derivatives along @p velocity of the points.
  Fields derivative(const Field &velocity) const
  {
    return {master.derivative(velocity),
            slave ? slave->derivative(velocity) : Field(fields.slave.size())};
  }

  /// Add (dn/dx)' @p of_normals to @p gradient, which contains all points.
  void add_transpose(const Fields &of_normals, Field &gradient) const
  {
    master.add_transpose(of_normals.master, gradient);
    if (slave)
      slave->add_transpose(of_normals.slave, gradient);
  }

private:
  faces::NodalNormals<dim>                master;
  std::optional<faces::NodalNormals<dim>> slave;
  Fields                                  fields;
};
} // namespace snug::contact

#endif
