#ifndef snug_optimization_step_model_h
#define snug_optimization_step_model_h

#include <snug/optimization/scaled_problem.h>
#include <snug/optimization/secant_hessian.h>

namespace snug::optimization {
/**
 * This class models a problem at y + d: the prediction of ScaledProblem with 1/2 d'Bd added to
 * the objective. It keeps references to its arguments.
 */
class StepModel
{
public:
  StepModel(const ScaledProblem        &problem,
            const ScaledProblem::Point &at,
            const SecantHessian        &hessian);

  /// Return the objective, the constraints and their derivatives at @p d. The reference is valid
  /// until the next call with another step.
  const ScaledProblem::Prediction &operator()(const std::vector<double> &d) const;

  /**
   * Return the step with the minimum objective among the steps with |d_i| <= radius that stay
   * between the bounds and meet the predicted constraints. If no step meets them, each constraint
   * may be violated by as much as in the step that minimizes the sum of the squared violations,
   * relative to the slopes of the constraints. NLopt's SLSQP computes the step from d = 0; if SLSQP
   * fails, the last step is returned.
   */
  std::vector<double> minimizer(double radius) const;

  /// Return the multipliers of the constraints at the step @p d, which minimize the norm of the
  /// projected gradient in the box of minimizer().
  std::vector<double> multipliers(const std::vector<double> &d, double radius) const;

  /// Return the number of variables.
  unsigned int size() const { return static_cast<unsigned int>(at.y.size()); }

private:
  const ScaledProblem              &problem;
  const ScaledProblem::Point       &at;
  const SecantHessian              &hessian;
  mutable std::vector<double>       last; ///< step of the last prediction; empty: none
  mutable ScaledProblem::Prediction predicted;

  void                settle(std::vector<double> &d) const;
  std::vector<double> minimize_from(const std::vector<double> &d, double radius, double unit) const;
  void box(double radius, std::vector<double> &lower, std::vector<double> &upper) const;
};
} // namespace snug::optimization

#endif
