#ifndef snug_contact_level_set_h
#define snug_contact_level_set_h

#include <snug/contact/obstacle.h>
#include <snug/geometry/formula.h>

namespace snug::contact {
/**
 * The obstacle phi < 0 of a formula phi. The point y of phi = 0 closest to
 * x solves
 *   y - x + m grad phi(y) = 0,  phi(y) = 0
 * by Newton's method; with n = grad phi(y) / |grad phi(y)| the distance is
 * n . (x - y), its gradient n, and its Hessian n' follows from the
 * derivative of that system. Derivatives of phi are differences over a
 * 25th of the element size: phi has to be smooth on the scale of elements.
 */
template <int dim>
class LevelSet : public Obstacle<dim>
{
public:
  /// @throws InputError if the formula cannot be parsed.
  LevelSet(const ObstacleParameters &parameters, double element_size);

  /// @throws InputError if the formula is not finite at a point of need.
  std::optional<ObstacleDistance<dim>> distance(const dealii::Point<dim> &x) const override;

private:
  struct Foot;

  void                evaluate(Foot &foot) const;
  bool                descend(const dealii::Point<dim> &x, Foot &foot) const;
  std::optional<Foot> foot(const dealii::Point<dim> &x) const;

  const geometry::Formula<dim> formula;
  const dealii::Point<dim>     origin;
  dealii::Tensor<2, dim>       rotation; ///< local coordinates to global ones
  const double                 size, step;
};
} // namespace snug::contact

#endif
