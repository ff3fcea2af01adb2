#ifndef snug_optimization_projected_gradient_h
#define snug_optimization_projected_gradient_h

#include <vector>

namespace snug::optimization {
/// Position of a variable between its bounds; `fixed` is at both.
enum class BoundState
{
  inside,
  at_lower,
  at_upper,
  fixed
};

/// This struct holds the gradient of an active constraint.
struct ConstraintGradient
{
  std::vector<double> gradient;
  bool                pushes; ///< whether it is an inequality, with a multiplier >= 0
};

/// This struct is the result of projected_gradient().
struct ProjectedGradient
{
  double              norm;
  std::vector<double> multipliers; ///< mu of each constraint; 0: left out
};

/**
 * Return the minimum over mu of the norm of the projected gradient of the Lagrangian,
 * @f[ \min_\mu \| P(g + A^T \mu) \|_2, @f]
 * with P as at Iteration: the part of the steepest descent that bounds and linearized constraints
 * permit.
 *
 * The square of the norm is convex and piecewise quadratic in mu. Newton's method solves a
 * least-squares problem for each piece. Inequalities with negative multipliers are removed one
 * after the other, that with the most negative multiplier first. They are not added again;
 * therefore the result may be above the minimum away from the points of Karush, Kuhn and Tucker.
 *
 * @param[in] g n entries.
 * @param[in] constraint_gradients rows of A with n entries, which may be linearly dependent.
 * @param[in] at_bounds n entries.
 */
ProjectedGradient projected_gradient(const std::vector<double>      &g,
                                     std::vector<ConstraintGradient> constraint_gradients,
                                     const std::vector<BoundState>  &at_bounds);
} // namespace snug::optimization

#endif
