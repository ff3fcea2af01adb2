#ifndef snug_qp_set_iteration_h
#define snug_qp_set_iteration_h

#include <snug/base/narrow.h>
#include <snug/qp/active_set.h>
#include <snug/qp/cycle_detector.h>
#include <snug/qp/kkt.h>
#include <snug/qp/krylov_columns.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace snug::qp {
/// An iteration that solves linear problems on sets of free rows until the KKT residual meets the
/// tolerance: what the active set method and the method with friction have in common.
class SetIteration
{
public:
  unsigned long f_mults() const { return context.work.f_mults - f_mults_before; }

protected:
  /// @p the_method is the name in messages. @p the_forcing is the first tolerance of inner solves.
  SetIteration(const DualProblem      &the_problem,
               const SolverParameters &the_parameters,
               const ActiveSetOptions &the_options,
               const std::string      &the_method,
               double                  the_forcing);
  ~SetIteration() = default;

  /// Return the KKT residual of lambda on the present set. Collective.
  virtual KktResidual kkt_here() const = 0;

  /// Return whether the KKT residual meets the tolerance, or has reached its rounding error.
  bool is_met() const;

  void refresh_residual();

  /// Solve the linear problem on the set by @p krylov and compute the KKT residual. @throws
  /// SolveError after the maximum number of F-mults. Collective.
  template <typename Krylov>
  KrylovResult solve_on_set(Krylov &krylov)
  {
    // The limit counts F-mults, not steps, because all solvers measure their work in F-mults.
    if (f_mults() >= parameters.max_iterations)
      throw not_converged(method, kkt_here().relative, parameters.relative_tolerance, f_mults(),
                          true);
    // An inner solve below half of the wanted KKT residual would only polish a set that may still
    // change. After a cycle the signs of small entries decide, so inner solves may go further down.
    const double least =
      (inner_accuracy == CycleDetector::none ? 0.5 : 0.005) * parameters.relative_tolerance;
    const KrylovResult inner =
      krylov.solve(lambda, residual, {std::max(inner_tolerance, least) * scale},
                   narrow<unsigned int>(parameters.max_iterations - f_mults()));
    evaluate(inner);
    return inner;
  }

  /// Return whether the tolerance is met by a lambda without tension on contact rows, and not only
  /// by the recurrence of the residual. Clips forces that are rounding errors. Collective.
  bool finished();

  const DualProblem           &problem;
  RunContext                  &context;
  const SolverParameters       parameters;
  const std::string            method;
  CycleDetector                history;
  CycleDetector::InnerAccuracy inner_accuracy = CycleDetector::none;
  const unsigned long          f_mults_before;

  MultiVector              lambda, residual;
  std::unique_ptr<FreeSet> free_set;
  KktResidual              kkt;
  std::vector<double>      negligible; // forces that may be rounding error, see force_rounding()
  double                   scale = 0.;
  double                   inner_tolerance;
  double                   last_kkt    = 0.; // of the last solve on the same set
  unsigned int             recurrences = 0;  // since the residual was computed as d - F lambda
  unsigned int             outer       = 0;
  unsigned int             stalls      = 0;
  bool                     at_rounding = false;

private:
  void evaluate(const KrylovResult &inner);
};
} // namespace snug::qp

#endif
