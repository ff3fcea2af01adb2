#ifndef snug_optimization_projected_gradient_h
#define snug_optimization_projected_gradient_h

#include <vector>

namespace snug::optimization {
/// Where a variable stands between its bounds; `fixed` is at both.
enum class BoundState
{
  inside,
  at_lower,
  at_upper,
  fixed
};

/// The gradient of a constraint that holds the design.
struct ConstraintGradient
{
  std::vector<double> gradient;
  bool                pushes; ///< an inequality: its multiplier is >= 0
};

/// Result of projected_gradient().
struct ProjectedGradient
{
  double              norm;
  std::vector<double> multipliers; ///< mu of each constraint; 0: left out
};

/**
 * The smallest norm over mu of the projected gradient of the Lagrangian,
 * @f[ \min_\mu \| P(g + A^T \mu) \|_2, @f]
 * with P as at Iteration: what is left of the steepest descent once
 * bounds and linearized constraints have taken their share.
 *
 * The function under the minimum is convex and piecewise quadratic;
 * Newton's method on its pieces, each a least-squares problem.
 * Inequalities whose multipliers come out negative are left out, the worst
 * first. They do not come back, so that away from Karush, Kuhn and Tucker
 * points the result may be above the minimum.
 *
 * @param[in] g n entries.
 * @param[in] forces rows of A, n entries; they may be linearly dependent.
 * @param[in] places n entries.
 */
ProjectedGradient projected_gradient(const std::vector<double>      &g,
                                     std::vector<ConstraintGradient> constraint_gradients,
                                     const std::vector<BoundState>  &at_bounds);
} // namespace snug::optimization

#endif
