#ifndef snug_faces_nodal_normals_h
#define snug_faces_nodal_normals_h

#include <snug/faces/face_shape.h>
#include <snug/faces/held_directions.h>
#include <snug/faces/point_field.h>

namespace snug::faces {
/**
 * This class computes the unit outward normals n_k = v_k/|v_k| at the nodes of a set of faces,
 *   v_k = a_k/|a_k| + c_k.
 * a_k is the sum, over the faces at node k, of the area vectors of their true surfaces there. Where
 * all of these faces lie on one surface of known shape, c_k makes n_k exact in the reference
 * geometry; otherwise c_k = 0. The polynomials of the surface are accurate to some 1e-9, but bodies
 * that turn freely in each other need normals without a lever.
 *
 * Normals may respect symmetry planes. Where supports hold directions q and n deviates by less than
 * 25 degrees from the directions at right angles to all q,
 *   n <- v / |v|, v = n - sum_q (q.n) q.
 * At the edge of a curved side the mean normal over the faces is one-sided, and would tilt off a
 * symmetry plane by half of the angle between two faces. The directions q are constants.
 *
 * Derivatives are exact. Normals are stored for all surface nodes. Normals at nodes of other faces
 * are zero.
 */
template <int dim>
class NodalNormals
{
public:
  using Field = typename mesh::Surface<dim>::Field;

  /// Compute the normals. @p faces are indices into @p surface, and @p positions are those of all
  /// points. Without @p held, supports do not count. The references must outlive this object.
  /// @throws TangledMesh if an area vector vanishes or is not finite, or if the true surface of a
  /// face turns back from the mesh.
  NodalNormals(const mesh::Surface<dim>        &surface,
               const std::vector<unsigned int> &faces,
               const FaceShape<dim>            &shape,
               const Field                     &positions,
               const HeldDirections<dim>       *held = nullptr);

  const Field &normals() const { return unit; }

  /// Return the derivative n' along @p velocity of the points.
  Field derivative(const Field &velocity) const;

  /// Add (dn/dx)' @p normal_gradient to @p gradient, which contains all points.
  void add_transpose(const Field &normal_gradient, Field &gradient) const;

private:
  const mesh::Surface<dim>        &surface;
  const std::vector<unsigned int> &faces;
  const FaceShape<dim>            &shape;
  const Field                     &positions;
  const HeldDirections<dim>       *held;
  Field                            areas, corrections; ///< a_k, c_k
  std::vector<bool>                touched, corrected; ///< nodes of the faces; those with c_k
  Field                            unit;               ///< n_k

  template <typename Number>
  std::vector<dealii::Tensor<1, dim, Number>> sum_areas(const PointField<dim, Number> &x) const;
  template <typename Number>
  dealii::Tensor<1, dim, Number> normal(unsigned int                   node,
                                        dealii::Tensor<1, dim, Number> area) const;
  void                           check(const Field &areas, const Field &x) const;
  void                           check_true_surface() const;
  void                           correct();
};
} // namespace snug::faces

#endif
