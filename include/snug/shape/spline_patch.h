#ifndef snug_shape_spline_patch_h
#define snug_shape_spline_patch_h

#include <snug/shape/face_basis.h>
#include <snug/shape/spline.h>

namespace snug::shape {
/**
 * Heights over a face from a net of n1 x n2 (2D: n1) control points,
 *   u(x) = sum_i B_i(s, t) alpha_i d(x),  i = j + n1 k,
 * with products B_i of Bernstein polynomials or B-splines. s and t are the
 * fractions, in the order x, y, z, of the face's bounding rectangle along
 * the two axes that its mean normal leaves; the face must be a graph over
 * them. d: the given unit direction or the face's normal.
 *
 * Control points stand over their Greville abscissae, at the mean height
 * of the face.
 */
template <int dim>
class SplinePatch : public FaceModes<dim>
{
public:
  using FaceField = typename FaceModes<dim>::FaceField;

  /// Splines of @p degree, or Bernstein polynomials if it is 0.
  /// @throws InputError naming the entry Face, Control points, Degree or
  /// Direction. The face must outlive the patch.
  SplinePatch(const ShapedFace<dim> &face, const ShapeParameters &parameters, unsigned int degree);

  unsigned int              n_variables() const override;
  FaceField                 apply(const std::vector<double> &alpha) const override;
  std::vector<double>       transpose(const FaceField &gradient) const override;
  std::vector<Control<dim>> controls() const override;

private:
  void find_axes(const ShapeParameters &parameters);

  const ShapedFace<dim>           &face;
  SplineNet                        net;
  FaceField                        directions;           ///< of the nodes
  dealii::Tensor<1, dim>           mean_normal;          ///< of the face, unit
  std::vector<unsigned int>        axes;                 ///< of s and t
  dealii::Tensor<1, dim>           lower, upper, middle; ///< of the nodes
  std::vector<std::vector<double>> places;               ///< s, t of the nodes
};

/// Unit vectors of the entry Direction, or the normals, at the face's
/// nodes. @throws InputError
template <int dim>
typename ShapedFace<dim>::Field face_directions(const ShapedFace<dim> &face,
                                                const ShapeParameters &parameters);
} // namespace snug::shape

#endif
