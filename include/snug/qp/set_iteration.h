#ifndef snug_qp_set_iteration_h
#define snug_qp_set_iteration_h

#include <snug/qp/cycle_detector.h>
#include <snug/qp/face_krylov.h>
#include <snug/qp/friction_sets.h>
#include <snug/qp/held_sets.h>
#include <snug/qp/kkt.h>
#include <snug/qp/set_rules.h>

#include <memory>

namespace snug::qp {
/**
 * One solve by an iteration over sets: the linear problem on the free rows is solved by FaceKrylov
 * until the sets no longer change and the KKT residual meets the tolerance. See ActiveSet for the
 * method. All members are collective.
 */
class SetIteration
{
public:
  SetIteration(const DualProblem      &problem,
               const SolverParameters &parameters,
               const SetRules         &rules);

  /// @throws UnsettledSets where the sets do not settle, and another method may find the solution;
  /// SolveError where the contacts cannot hold the bodies, or the tolerance is not met within the
  /// allowed F-mults.
  DualSolution solve(const WarmStart &from);

  /// Return the present iterate as a start for another method.
  WarmStart     start() const { return {lambda, free_set->free_rows().rows()}; }
  unsigned long f_mults() const { return context.work.f_mults - f_mults_before; }
  unsigned int  steps() const { return outer; }

private:
  void begin(const WarmStart &from);
  KktResidual
       kkt_of(const FreeSet &face, const MultiVector &lambda, const MultiVector &residual) const;
  void solve_on_set();
  bool is_met() const;
  bool finished();
  FreeRows     next_rows() const;
  void         keep_rows(const FreeRows &next);
  void         change_rows(const FreeRows &next);
  void         take(const FreeRows &rows, const DirectionBasis &known, bool deflates);
  void         refresh_residual();
  DualSolution solution();

  const DualProblem           &problem;
  RunContext                  &context;
  const SolverParameters       parameters;
  const SetRules               rules;
  CycleDetector                history;
  CycleDetector::InnerAccuracy inner_accuracy = CycleDetector::none;
  const unsigned long          f_mults_before;
  const bool                   has_friction; ///< on any rank

  MultiVector                 lambda, residual;
  std::unique_ptr<FreeSet>    free_set;
  std::unique_ptr<FaceKrylov> krylov; ///< of free_set
  KktResidual                 kkt;    ///< of the last solve
  HeldSets                    sets;
  FrictionSets                friction;
  std::vector<double> negligible; ///< forces that may be rounding error, see force_rounding()
  double              scale = 0.;
  double              inner_tolerance;
  double              last_kkt    = 0.;   ///< of the last solve on the same sets
  unsigned int        recurrences = 0;    ///< since the residual was computed as d - F lambda
  unsigned int        outer       = 0;    ///< number of solves
  unsigned int        stalls      = 0;    ///< see SetRules::allowed_stalls
  bool                solved      = true; ///< whether the last solve converged
  bool                at_rounding = false;
};
} // namespace snug::qp

#endif
