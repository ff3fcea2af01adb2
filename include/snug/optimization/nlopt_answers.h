#ifndef snug_optimization_nlopt_answers_h
#define snug_optimization_nlopt_answers_h

#include <snug/optimization/progress.h>

#include <exception>
#include <nlopt.hpp>

namespace snug::optimization {
/**
 * Answers the questions of NLopt's runs about a problem. NLopt tells nothing about its iterations:
 * a design better than the last accepted one is accepted. Where that gains little for many
 * evaluations, the run ends by round-off. How a run ended stands in the members.
 */
class NloptAnswers
{
public:
  /// Keeps references to all three.
  NloptAnswers(ScaledProblem                &problem,
               Progress                     &progress,
               const OptimizationParameters &parameters);

  /// Forget the questions of the run before.
  void begin_run();

  /// Have @p optimizer ask this object.
  void attach(nlopt::opt &optimizer);

  End                 end = End::round_off;
  std::vector<double> failed_design; ///< of End::no_value, and why
  std::string         failure;
  std::exception_ptr  error; ///< of the problem or a hook

private:
  double          objective(const double *y, double *gradient);
  void            constraints(Relation relation, double *values, const double *y, double *jacobian);
  Progress::Point values_at(const std::vector<double> &y, bool with_gradient);
  void            watch();
  [[noreturn]] void stop(End reason);
  template <typename Function>
  void guarded(const Function &work);

  static double call_objective(unsigned int, const double *y, double *gradient, void *answers);
  template <Relation relation>
  static void call_constraints(unsigned int,
                               double *values,
                               unsigned int,
                               const double *y,
                               double       *jacobian,
                               void         *answers);

  Progress                     &progress;
  ScaledProblem                &problem;
  const OptimizationParameters &parameters;
  unsigned int                  n_variables;
  unsigned int                  idle_questions = 0; ///< answered by known values
  Progress::Point               milestone;          ///< the last design that was a gain, accepted
  unsigned int                  reached = 0;        ///< by so many evaluations
};
} // namespace snug::optimization

#endif
