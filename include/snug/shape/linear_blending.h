#ifndef snug_shape_linear_blending_h
#define snug_shape_linear_blending_h

#include <snug/shape/interior.h>

namespace snug::shape {
/**
 * Nodes of a box follow the point of the shaped face below or above them,
 *   u(x) = b(x) u(face point),  b = max(0, 1 - depth / reach),
 * where depth is measured in the box before its faces are curved and reach
 * is the box's height unless given. The face point is found in logical
 * coordinates, its displacement interpolated as the elements do.
 */
template <int dim>
class LinearBlending : public Interior<dim>
{
public:
  using Field     = typename Interior<dim>::Field;
  using FaceField = typename Interior<dim>::FaceField;

  LinearBlending(const ShapedFace<dim> &face, const ShapeParameters &parameters);

  Field     extend(const FaceField &moves) const override;
  FaceField transpose(const Field &gradient) const override;

private:
  /// b times the weights of the face's nodes at one node of the body.
  struct NodeWeights
  {
    unsigned int                                 node; ///< local
    std::vector<std::pair<unsigned int, double>> weights;
  };

  const ShapedFace<dim>   &face;
  std::vector<NodeWeights> rows;
};
} // namespace snug::shape

#endif
