#include <snug/app/search.h>
#include <snug/optimization/starts.h>

namespace snug::app {
using optimization::OptimizationResult;

namespace {
/// Maximum number of evaluations, and relative change of the potential energy that ends a search
/// for a wider contact. A punch with 25 control points takes 32 evaluations.
const unsigned int evaluations_to_widen = 40;
const double       tolerance_to_widen   = 1e-3;
} // namespace

/// Search with the potential energy from @p start, and again with the objective if this has widened
/// the contact. A pressure has no derivative with respect to the gaps of nodes that are not in
/// contact, so that a search on pressures rarely brings further nodes into contact. The potential
/// energy does, but without a limit on the geometry it also moves the faces to their bounds. Return
/// the better one of @p result and the last result.
template <int dim>
OptimizationResult Search<dim>::widen_contact(const Design             &start,
                                              const OptimizationResult &result,
                                              const double              tolerance)
{
  const auto  &parameters = problem.scene.optimization;
  unsigned int n_rows     = 0;
  for (unsigned int c = 0; c < problem.n_load_cases(); ++c)
    n_rows += problem.solver->contact(c).n_rows();
  const unsigned int n = result.evaluation.active_contacts;
  if (!objective.response().reads_pressure() || n == n_rows ||
      result.end == optimization::StopReason::interrupted)
    return result;
  const std::string now = to_text(n) + " of " + counted(n_rows, "node") + " are in contact" +
                          (n == first_contacts ? ", as many as in the first design" : "");
  if (!objective.limits_geometry() || parameters.starts > 1 ||
      result.evaluations + evaluations_to_widen >= parameters.maximum_evaluations)
    {
      if (n == first_contacts)
        log(now);
      return result;
    }
  log(now + ": searching with the potential energy, which may widen the contact");
  auto of_energy = objective.with_objective(problem.make_response("potential energy"));
  auto wide      = run_with_pairing(of_energy, start, result, tolerance_to_widen,
                                    result.evaluations + evaluations_to_widen);
  auto better    = result;
  auto last      = wide;
  if (wide.end != optimization::StopReason::interrupted && wide.evaluation.active_contacts > n)
    {
      log("searching again with the " + parameters.objective);
      last = run_with_pairing(objective, wide.x, wide, tolerance);
      if (optimization::is_better(last, result, parameters))
        better = last;
    }
  if (last.end == optimization::StopReason::interrupted)
    {
      better.end         = last.end;
      better.stop_reason = last.stop_reason;
      better.success     = false;
    }
  if (better.x == result.x)
    log("the design of the first search is the best: " + parameters.objective + ' ' +
        to_text(result.objective_final));
  better.iterations  = last.iterations;
  better.evaluations = last.evaluations;
  return better;
}

#define SNUG_INSTANTIATE(dim)                                            \
  template OptimizationResult Search<dim>::widen_contact(const Design &, \
                                                         const OptimizationResult &, double);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::app
