#ifndef snug_contact_level_set_h
#define snug_contact_level_set_h

#include <snug/contact/obstacle.h>
#include <snug/geometry/formula.h>

namespace snug::contact {
/**
 * This class is the obstacle phi < 0 of a formula phi. Newton's method computes the point y of
 * phi = 0 closest to x from
 *   y - x + m grad phi(y) = 0,  phi(y) = 0.
 * With n = grad phi(y) / |grad phi(y)| the distance is n . (x - y), and its gradient is n. The
 * Hessian n' of the distance follows from the derivative of this system. Derivatives of phi are
 * difference quotients over a 25th of the element size, so phi has to be smooth on the scale of
 * elements.
 */
template <int dim>
class LevelSet : public Obstacle<dim>
{
public:
  /// Parse the formula of @p parameters.
  /// @throws InputError if the formula cannot be parsed.
  LevelSet(const ObstacleParameters &parameters, double element_size);

  /// Return the distance of @p x, or nothing if Newton's method finds no closest point.
  /// @throws InputError if the formula is not finite at a point where it is evaluated.
  std::optional<ObstacleDistance<dim>> distance(const dealii::Point<dim> &x) const override;

private:
  struct ClosestPoint;

  void                        evaluate(ClosestPoint &closest) const;
  bool                        descend(const dealii::Point<dim> &x, ClosestPoint &closest) const;
  std::optional<ClosestPoint> closest_point(const dealii::Point<dim> &x) const;

  const geometry::Formula<dim> formula;
  const dealii::Point<dim>     origin;
  dealii::Tensor<2, dim>       rotation; ///< from local coordinates to global coordinates
  const double                 size, step;
};
} // namespace snug::contact

#endif
