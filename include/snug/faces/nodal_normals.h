#ifndef snug_faces_nodal_normals_h
#define snug_faces_nodal_normals_h

#include <snug/faces/face_shape.h>

namespace snug::faces {
/**
 * This class computes the unit outward normals n_k = v_k/|v_k| at the nodes of a set of faces,
 *   v_k = a_k/|a_k| + c_k.
 * a_k is the sum, over the faces at node k, of the area vectors of their true surfaces there. Where
 * all of these faces lie on one surface of known shape, c_k makes n_k exact in the reference
 * geometry; otherwise c_k = 0. The polynomials of the surface are accurate to some 1e-9, but bodies
 * that turn freely in each other need normals without a lever. Derivatives are exact,
 *   n_k' = (I - n_k n_k') v_k' / |v_k|,  a_k' bilinear in x and x'.
 * Normals are stored for all surface nodes. Normals at nodes of other faces are zero.
 */
template <int dim>
class NodalNormals
{
public:
  using Field = typename mesh::Surface<dim>::Field;

  /// Compute the normals. @p faces are indices into @p surface, and @p positions are those of all
  /// points. The references must outlive this object.
  /// @throws TangledMesh if an area vector vanishes or is not finite.
  NodalNormals(const mesh::Surface<dim>        &surface,
               const std::vector<unsigned int> &faces,
               const FaceShape<dim>            &shape,
               const Field                     &positions);

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
  Field                            unit, area_unit;     ///< n_k, a_k/|a_k|
  std::vector<double>              length, area_length; ///< |v_k|, |a_k|

  void normalise_areas(const Field &x, Field &areas, std::vector<double> &lengths) const;
  void correct();
};

/// Return (I - n n') v / length, the derivative of a unit vector n = a/length along a' = v. The
/// operator is symmetric, so it is its own transpose.
template <int dim>
dealii::Tensor<1, dim> unit_vector_derivative(const dealii::Tensor<1, dim> &n,
                                              double                        length,
                                              const dealii::Tensor<1, dim> &v);
} // namespace snug::faces

#endif
