#ifndef snug_optimization_projected_gradient_h
#define snug_optimization_projected_gradient_h

#include <vector>

namespace snug
{
  namespace optimization
  {
    /// Where a variable stands between its bounds; `fixed` is at both.
    enum class Place
    {
      inside,
      at_lower,
      at_upper,
      fixed
    };

    /**
     * The smallest norm over mu of the projected gradient of the Lagrangian,
     * @f[ \min_\mu \| P(g + A^T \mu) \|_2, @f]
     * with P as at Iteration: what is left of the steepest descent once
     * bounds and linearized equalities have taken their share.
     *
     * The function under the minimum is convex and piecewise quadratic;
     * Newton's method on its pieces, each a least-squares problem.
     *
     * @param[in] g n entries.
     * @param[in] A m rows of n entries; they may be linearly dependent.
     * @param[in] places n entries.
     */
    double
    projected_gradient_norm(const std::vector<double>              &g,
                            const std::vector<std::vector<double>> &A,
                            const std::vector<Place>               &places);
  } // namespace optimization
} // namespace snug

#endif
