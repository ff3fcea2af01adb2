#ifndef snug_optimization_trust_region_h
#define snug_optimization_trust_region_h

#include <snug/optimization/progress.h>
#include <snug/optimization/step_model.h>

namespace snug::optimization {
/**
 * This class does sequential quadratic programming in a trust region, from the iterate of a
 * Progress on. A step d minimizes a StepModel with |d_i| <= R, where R = 1 at first, in the lengths
 * of the variables. The merit is f + sum_j nu_j |c_j| (c_j^+ for inequalities), where nu_j is 1.5
 * times the multiplier of the model and at least half of what it was; rho is its decrease over the
 * predicted one.
 *
 * - rho < 1e-4: the design is rejected; R becomes 0.1 to 0.5 |d|_inf, at the minimum of the
 * parabola through both values and the slope, and B gains the curvature measured along d.
 * - rho < 0.25: accepted; R is |d|_inf / 2, at least a quarter of the last one.
 * - rho > 0.75, and d is about as long as R: accepted; R grows threefold.
 *
 * Until a difference of gradients is measured, B = |g| pg / R I with the projected gradient pg: the
 * step is about as long as R allows. Where responses are predicted with their curvature, no
 * differences are used and B keeps this value: as in the method of Levenberg and Marquardt, the
 * step is the shortest one among steps with the same gain.
 *
 * A design without a value is rejected, and R becomes a quarter of its step. If no step improves
 * the model, B is reset once, and then the search ends by round-off. The search ends by the
 * objective tolerance if a design is rejected whose predicted gain is below this tolerance.
 * Source: Conn, Gould, Toint, Trust-Region Methods (2000), sections 6.1 and 15.3.
 */
class TrustRegion
{
public:
  /// Keep references to all arguments.
  TrustRegion(ScaledProblem                &problem,
              Progress                     &progress,
              const OptimizationParameters &parameters,
              const Hooks                  &hooks);

  /// Run the search. @return why it ended. Exceptions of evaluate() and of hooks other than
  /// SolveErrors of evaluate() pass through.
  StopReason run();

  /// The message of the last failed evaluation, for StopReason::no_value. It is empty if the last
  /// rejected design has a value.
  std::string failure;

private:
  /// This struct holds a step from the iterate and its decrease of the merit.
  struct Trial
  {
    std::vector<double> d, y;
    double              objective = 0., violation = 0.; ///< parts of the merit at the iterate
    double              predicted = 0., actual = 0.;
    double              slope = 0.; ///< decrease that the linear objective predicts
    Progress::Point     point = nullptr;
  };

  Trial      proposed(const StepModel &model);
  bool       evaluated(Trial &trial);
  StopReason reject(const Trial &trial);
  StopReason accept(const StepModel &model, const Trial &trial);
  void       learn(const StepModel &model, const Trial &trial);

  double weighted_violation(const std::vector<double> &constraints) const;

  ScaledProblem                &problem;
  Progress                     &progress;
  const OptimizationParameters &parameters;
  const Hooks                  &hooks;
  SecantHessian                 hessian;
  std::vector<double>           weights; ///< nu
  double                        radius     = 1.;
  unsigned int                  n_failures = 0;     ///< evaluations since a gain
  bool                          failed     = false; ///< an evaluation from the iterate on
};
} // namespace snug::optimization

#endif
