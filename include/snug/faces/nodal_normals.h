#ifndef snug_faces_nodal_normals_h
#define snug_faces_nodal_normals_h

#include <snug/faces/face_shape.h>

namespace snug::faces {
/**
 * Unit outward normals n_k = a_k/|a_k| at the nodes of a set of faces,
 * a_k = sum over the faces at node k of their area vectors there, with
 * exact derivatives
 *   n_k' = (I - n_k n_k') a_k' / |a_k|,  a_k' bilinear in x and x'.
 * Fields run over all surface nodes; nodes of other faces hold zeros.
 */
template <int dim>
class NodalNormals
{
public:
  using Field = typename mesh::Surface<dim>::Field;

  /// @p faces: indices into @p surface. The references must outlive this.
  /// @throws TangledMesh if an area vector vanishes or is not finite.
  NodalNormals(const mesh::Surface<dim>        &surface,
               const std::vector<unsigned int> &faces,
               const FaceShape<dim>            &shape,
               const Field                     &positions);

  const Field &normals() const { return unit; }

  /// n' along @p velocity of the positions.
  Field derivative(const Field &velocity) const;

  /// gradient += (dn/dx)' @p normal_gradient.
  void add_transpose(const Field &normal_gradient, Field &gradient) const;

private:
  const mesh::Surface<dim>        &surface;
  const std::vector<unsigned int> &faces;
  const FaceShape<dim>            &shape;
  const Field                     &positions;
  Field                            unit;
  std::vector<double>              length; ///< |a_k|
};

/// (I - n n') v / length: the derivative of a unit vector n = a/length
/// along a' = v; symmetric, so its own transpose.
template <int dim>
dealii::Tensor<1, dim> unit_vector_derivative(const dealii::Tensor<1, dim> &n,
                                              double                        length,
                                              const dealii::Tensor<1, dim> &v);
} // namespace snug::faces

#endif
