#ifndef snug_contact_supported_normals_h
#define snug_contact_supported_normals_h

#include <snug/faces/held_directions.h>
#include <snug/faces/nodal_normals.h>

namespace snug::contact {
/**
 * Nodal normals that respect symmetry planes: where supports hold
 * directions q that a normal n leaves by less than 25 degrees,
 *   n <- v / |v|, v = n - sum_q (q.n) q.
 * At the edge of a curved side the mean over its faces is one-sided, so it
 * would tilt off a symmetry plane by half of the angle between two faces.
 * The directions q are constants.
 */
template <int dim>
class SupportedNormals
{
public:
  using Field = typename mesh::Surface<dim>::Field;

  /// Arguments as of NodalNormals. The references must outlive this.
  /// @throws TangledMesh.
  SupportedNormals(const mesh::Surface<dim>         &surface,
                   const std::vector<unsigned int>  &faces,
                   const faces::FaceShape<dim>      &shape,
                   const Field                      &positions,
                   const faces::HeldDirections<dim> &held);

  const Field &normals() const { return unit; }

  /// n' along @p velocity of the positions.
  Field derivative(const Field &velocity) const;

  /// gradient += (dn/dx)' @p normal_gradient.
  void add_transpose(const Field &normal_gradient, Field &gradient) const;

private:
  faces::NodalNormals<dim>          nodal;
  const faces::HeldDirections<dim> &held;
  Field                             unit;
  std::vector<double>               length; ///< |v|; 0 where n is not changed
};
} // namespace snug::contact

#endif
