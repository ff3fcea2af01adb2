#ifndef snug_optimization_step_model_h
#define snug_optimization_step_model_h

#include <snug/optimization/scaled_problem.h>
#include <snug/optimization/secant_hessian.h>

namespace snug::optimization {
/**
 * What is expected of a problem at y + d: the prediction of ScaledProblem with 1/2 d'Bd added to
 * the objective. Refers to its arguments.
 */
class StepModel
{
public:
  StepModel(const ScaledProblem        &problem,
            const ScaledProblem::Point &at,
            const SecantHessian        &hessian);

  /// Objective, constraints and their derivatives at @p d.
  const ScaledProblem::Prediction &operator()(const std::vector<double> &d) const;

  /// sum_j weights_j |c_j|, of c_j+ for inequalities.
  double violation(const std::vector<double> &constraints,
                   const std::vector<double> &weights) const;

  /**
   * The step with the least objective among those with |d_i| <= radius that stay between the
   * bounds and meet the predicted constraints, or violate each no more than the step that
   * violates them least, in the sum of squares relative to their slopes. Found by NLopt's SLSQP
   * from 0; if it fails, what it came to.
   */
  std::vector<double> least(double radius) const;

  /// Multipliers of the constraints at the step @p d, made least squares of what is left of the
  /// gradient inside of the box of least().
  std::vector<double> multipliers(const std::vector<double> &d, double radius) const;

  /// Variables of the step.
  unsigned int size() const { return static_cast<unsigned int>(at.y.size()); }

private:
  const ScaledProblem              &problem;
  const ScaledProblem::Point       &at;
  const SecantHessian              &hessian;
  mutable std::vector<double>       last; ///< step of the last prediction; empty: none
  mutable ScaledProblem::Prediction predicted;

  std::vector<double> least_from(const std::vector<double> &d, double radius, double unit) const;
  void box(double radius, std::vector<double> &lower, std::vector<double> &upper) const;
};
} // namespace snug::optimization

#endif
