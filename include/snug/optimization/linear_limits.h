#ifndef snug_optimization_linear_limits_h
#define snug_optimization_linear_limits_h

#include <snug/optimization/design_problem.h>

namespace snug::optimization {
/// This struct describes the limit a'x <= b of the variables x.
struct LinearLimit
{
  std::vector<double> row; ///< a
  double              bound;
};

/// Return @p problem with the constraints a'x - b <= 0, which follow the constraints of the
/// problem. The result refers to no other object than @p problem does.
DesignProblem with_limits(DesignProblem problem, const std::vector<LinearLimit> &limits);
} // namespace snug::optimization

#endif
