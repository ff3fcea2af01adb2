#ifndef snug_shape_node_wise_h
#define snug_shape_node_wise_h

#include <snug/shape/face_basis.h>

namespace snug::shape {
/**
 * One variable per node of a face that does not hang, smoothed by a filter
 * of radius r:
 *   u_i = c_i d_i sum_j w_ij alpha_j / sum_j w_ij,
 *   w_ij = A_j max(0, 1 - |x_i - x_j| / r),
 * with the reference positions x, tributary areas A and normals d (or the
 * given direction), and c_i = 1. Where nodes are fixed, their rows are
 * zero and c_i = min(1, distance from the nearest fixed node / r) leads
 * smoothly there. Equal alpha move a plane face as a whole.
 *
 * Sources: the filter of Bruns, Tortorelli, Comput. Methods Appl. Mech.
 * Engrg. 190 (2001), used for shapes in the vertex morphing of Hojjat,
 * Stavropoulou, Bletzinger, ibid. 268 (2014).
 */
template <int dim>
class NodeWise : public FaceModes<dim>
{
public:
  using FaceField = typename FaceModes<dim>::FaceField;

  /// @throws InputError naming the entry Filter radius, Direction or Fixed.
  /// The face must outlive this object.
  NodeWise(const ShapedFace<dim> &face, const ShapeParameters &parameters);

  unsigned int              n_variables() const override;
  FaceField                 apply(const std::vector<double> &alpha) const override;
  std::vector<double>       transpose(const FaceField &gradient) const override;
  std::vector<Control<dim>> controls() const override;

private:
  void set_weights(double radius);
  void lead_to_fixed(const ShapeParameters &parameters);

  const ShapedFace<dim>    &face;
  FaceField                 directions;
  std::vector<unsigned int> nodes; ///< surface node of each variable
  /// per variable's node: variables and weights
  std::vector<std::vector<std::pair<unsigned int, double>>> rows;
};
} // namespace snug::shape

#endif
