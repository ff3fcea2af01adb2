#ifndef snug_contact_mortar_normals_h
#define snug_contact_mortar_normals_h

#include <snug/contact/normal_projection.h>
#include <snug/mortar/mortar_face.h>

namespace snug::contact {
/**
 * This class holds the normals n_i of the slave nodes along which mortar rows act, as functions of
 * the positions. For pairs with mean normals (PairNormals) a slave node is projected to the master,
 * and n_i is the unit vector along v there. Nodes beyond the master take its closest point, and
 * nodes whose normals are not opposite to it up to steepest_angle have their own normal. For other
 * pairs, n_i are the NodalNormals of the slave side. The constructor chooses the faces of the
 * projections.
 */
template <int dim>
class MortarNormals
{
public:
  using Field = typename mesh::Surface<dim>::Field;

  /// After construction, this object refers to the surface and the shape of @p pair only.
  explicit MortarNormals(const PairGeometry<dim> &pair);

  /// Return slave face @p face at the positions @p x. With mean normals it is projected along the
  /// sum of N_i n_i at its centre, with the normals @p n.
  template <typename Number>
  mortar::MortarFace<dim, Number> slave_face(unsigned int                          face,
                                             const faces::PointField<dim, Number> &x,
                                             const faces::PointField<dim, Number> &n) const;

  /// The normals at given positions.
  class Values
  {
  public:
    const Field &normals() const { return unit; }

    /// Return the derivatives of the normals along @p velocity of the points.
    Field derivative(const Field &velocity) const;

    /// Add (dn/dx)' @p of_normals to @p gradient, which contains all points.
    void add_transpose(const Field &of_normals, Field &gradient) const;

  private:
    friend class MortarNormals;

    const MortarNormals            &of;
    const Field                    &positions;
    const faces::NodalNormals<dim>  own;  ///< of the slave
    std::optional<PairNormals<dim>> pair; ///< only for mean normals
    Field                           unit;

    Values(const MortarNormals &of, const Field &positions);
  };

  /// Return the normals at @p positions, which the result refers to like to this object.
  Values at(const Field &positions) const { return {*this, positions}; }

private:
  const mesh::Surface<dim>          &surface;
  const faces::FaceShape<dim>       &shape;
  PairFaces                          sides;
  faces::HeldDirections<dim>         held;
  bool                               has_mean_normals;
  std::vector<NormalProjection<dim>> projections;
};
} // namespace snug::contact

#endif
