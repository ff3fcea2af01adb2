#include <snug/base/narrow.h>
#include <snug/base/values.h>
#include <snug/qp/active_set.h>
#include <snug/qp/row_set.h>
#include <snug/qp/set_iteration.h>
#include <snug/qp/smalse.h>

#include <algorithm>
#include <ostream>

namespace snug::qp {
namespace {
/// Return the rules with friction. Measured in 3D, 56k and 94k unknowns: the forcings 0.1, 0.3, 0.5
/// and 0.7 take 35, 30, 27, 28 and 41, 35, 33, 35 F-mults.
SetRules rules_of_friction()
{
  SetRules rules;
  rules.method         = "friction";
  rules.forcing        = 0.5;
  rules.settled        = 0.3;
  rules.exact_forcing  = 1e-3;
  rules.many_repairs   = 3;
  rules.allowed_stalls = 12; // directions of slips turn from solve to solve
  rules.in_cycles      = 1.;
  return rules;
}
} // namespace

ActiveSet::ActiveSet(const SolverParameters &the_parameters, const SetRules &the_rules)
  : parameters(the_parameters), rules(the_rules)
{}

DualSolution ActiveSet::solve_with_friction(const DualProblem &problem,
                                            const WarmStart   &start) const
{
  SetRules            with_friction = rules_of_friction();
  const unsigned long before        = problem.context().work.f_mults;
  try
    {
      return SetIteration(problem, parameters, with_friction).solve(start);
    }
  catch (const UnsettledSets &error)
    {
      problem.context().out(Verbosity::debug)
        << "friction: " << error.what() << "; starting again with friction limits of the last step"
        << std::endl;
    }
  with_friction.is_lagging = true;
  with_friction.forcing    = 0.1;
  try
    {
      auto result    = SetIteration(problem, parameters, with_friction).solve(WarmStart());
      result.f_mults = problem.context().work.f_mults - before;
      return result;
    }
  catch (const NoEquilibrium &)
    {
      throw;
    }
  catch (const UnsettledSets &error)
    {
      throw SolveError("the friction solver does not converge: it " + std::string(error.what()) +
                       " after " + counted(problem.context().work.f_mults - before, "F-mult") +
                       "; the contact may slide, or have several states");
    }
}

DualSolution ActiveSet::solve(const DualProblem &problem, const WarmStart &start) const
{
  if (any(!problem.cones().empty(), problem.context().communicator()))
    return solve_with_friction(problem, start);
  SetIteration iteration(problem, parameters, rules);
  std::string  reason;
  try
    {
      return iteration.solve(start);
    }
  catch (const NoEquilibrium &)
    {
      throw;
    }
  catch (const UnsettledSets &error)
    {
      reason = error.what();
    }
  const unsigned long spent = iteration.f_mults();
  problem.context().out() << "active set method: " << reason << " after "
                          << counted(spent, "F-mult") << ", continuing with SMALSE-M" << std::endl;
  SolverParameters remaining = parameters;
  remaining.max_iterations -=
    narrow<unsigned int>(std::min<unsigned long>(spent, remaining.max_iterations));
  DualSolution result = Smalse(remaining).solve(problem, iteration.start());
  result.f_mults += spent;
  // Add the steps of the iteration that gave up, because they were done for this solution as well.
  result.outer_iterations += iteration.steps();
  return result;
}
} // namespace snug::qp
