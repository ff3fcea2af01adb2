#ifndef snug_geometry_fitted_surface_h
#define snug_geometry_fitted_surface_h

#include <snug/geometry/block_mesh.h>

namespace snug::geometry {
/**
 * The sphere, or the cylinder of a given direction, that fits points best:
 * least squares of |x|^2 = 2 c.x + (R^2 - |c|^2) in the centre c and R.
 */
template <int dim>
class FittedSurface
{
public:
  /**
   * @p value: "sphere" or, in 3D, "cylinder AXIS" with the axis x, y or z;
   * in 2D both are circles, the axis is z.
   * @throws InputError naming the entry Curved faces if @p value is none of
   *   these, or a point is off by more than 1e-4 R.
   */
  FittedSurface(const std::string                     &boundary,
                const std::string                     &value,
                const std::vector<dealii::Point<dim>> &points);

  /// The nearest point on it.
  dealii::Point<dim> project(const dealii::Point<dim> &point) const;

  typename BlockMesh<dim>::Surface manifold() const;

private:
  unsigned int       straight_axis = dim; ///< of a cylinder
  dealii::Point<dim> centre;
  double             radius = 0.;

  /// From the centre, or from the axis of a cylinder.
  dealii::Tensor<1, dim> offset(const dealii::Point<dim> &point) const;
  void                   fit(const std::vector<dealii::Point<dim>> &points);
};
} // namespace snug::geometry

#endif
