#ifndef snug_optimization_nlopt_answers_h
#define snug_optimization_nlopt_answers_h

#include <snug/optimization/progress.h>

#include <exception>
#include <nlopt.hpp>

namespace snug::optimization {
/**
 * Answers the questions of NLopt's runs about a problem and infers from
 * them which designs are accepted. How a run ended stands in the members.
 */
class NloptAnswers
{
public:
  /// Keeps references to all three.
  NloptAnswers(ScaledProblem                &problem,
               Progress                     &progress,
               const OptimizationParameters &parameters);
  virtual ~NloptAnswers() = default;

  /// Forget the questions of the run before.
  virtual void begin_run();

  /// A run has ended by itself.
  void end_run();

  /// Have @p optimizer ask this object.
  void attach(nlopt::opt &optimizer);

  End                 end = End::round_off;
  std::vector<double> failed_design; ///< of End::no_value, and why
  std::string         failure;
  std::exception_ptr  error; ///< of the problem or a hook

protected:
  /// The objective is asked at @p y, and not yet evaluated there.
  virtual void asking(const std::vector<double> &y, bool with_gradient);
  /// It was evaluated.
  virtual void
  asked(const std::vector<double> &y, const Progress::Point &point, bool with_gradient) = 0;

  /// A run has ended by itself.
  virtual void ended();

  [[noreturn]] void stop(End reason);

  Progress                     &progress;
  ScaledProblem                &problem;
  const OptimizationParameters &parameters;

private:
  double          objective(const double *y, double *gradient);
  void            constraints(Relation relation, double *values, const double *y, double *jacobian);
  Progress::Point values_at(const std::vector<double> &y, bool with_gradient);
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

  unsigned int n_variables;
  unsigned int idle_questions = 0; ///< answered by known values
};

/**
 * Those of SLSQP. NLopt tells nothing about its iterations, but asks in a
 * fixed pattern: the full step with gradient; if that is rejected, shorter
 * steps without; the accepted one of these again with gradient. So a full
 * step is known to be accepted when the next question, too, asks for a
 * gradient, and a shortened one when the question repeats its design.
 */
class SlsqpAnswers : public NloptAnswers
{
public:
  using NloptAnswers::NloptAnswers;

  void begin_run() override;

private:
  void ended() override;
  void asking(const std::vector<double> &y, bool with_gradient) override;
  void
  asked(const std::vector<double> &y, const Progress::Point &point, bool with_gradient) override;
  void accept(const Progress::Point &point, bool full);

  Progress::Point     full_step;             ///< asked for, not known to be accepted
  std::vector<double> last_design;           ///< asked for
  bool                last_was_full = false; ///< and with gradient
};

/// Those of other algorithms: a design better than the last accepted one
/// is accepted. Where that gains little for many evaluations, the run ends by round-off.
class BetterDesigns : public NloptAnswers
{
public:
  using NloptAnswers::NloptAnswers;

  void begin_run() override;

private:
  void
  asked(const std::vector<double> &y, const Progress::Point &point, bool with_gradient) override;
  void watch();

  Progress::Point milestone; ///< the last design that was a gain, accepted
  unsigned int    reached;   ///< by so many evaluations
};
} // namespace snug::optimization

#endif
