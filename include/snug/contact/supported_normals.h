#ifndef snug_contact_supported_normals_h
#define snug_contact_supported_normals_h

#include <snug/faces/held_directions.h>
#include <snug/faces/nodal_normals.h>

namespace snug::contact {
/**
 * This class computes nodal normals that respect symmetry planes. The correction applies where
 * supports hold directions q and the normal n deviates by less than 25 degrees from the directions
 * at right angles to all q:
 *   n <- v / |v|, v = n - sum_q (q.n) q.
 * At the edge of a curved side the mean normal over the faces is one-sided. Without the correction,
 * the mean normal would tilt off a symmetry plane by half of the angle between two faces. The
 * directions q are constants.
 */
template <int dim>
class SupportedNormals
{
public:
  using Field = typename mesh::Surface<dim>::Field;

  /// Compute the normals, with the arguments of NodalNormals. The references must outlive this
  /// object.
  /// @throws TangledMesh.
  SupportedNormals(const mesh::Surface<dim>         &surface,
                   const std::vector<unsigned int>  &faces,
                   const faces::FaceShape<dim>      &shape,
                   const Field                      &positions,
                   const faces::HeldDirections<dim> &held);

  const Field &normals() const { return unit; }

  /// Return the derivative n' along @p velocity of the positions.
  Field derivative(const Field &velocity) const;

  /// Add (dn/dx)' @p normal_gradient to @p gradient.
  void add_transpose(const Field &normal_gradient, Field &gradient) const;

private:
  faces::NodalNormals<dim>          nodal;
  const faces::HeldDirections<dim> &held;
  Field                             unit;
  std::vector<double>               length; ///< |v|; 0 where n is not changed
};
} // namespace snug::contact

#endif
