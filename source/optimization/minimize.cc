#include <snug/base/entries.h>
#include <snug/optimization/minimize.h>
#include <snug/optimization/nlopt_search.h>

#include <sstream>

namespace snug::optimization {
namespace {
std::function<Algorithm> of_nlopt(const NloptAlgorithm algorithm)
{
  return
    [algorithm](const DesignProblem &problem, const OptimizationParameters &parameters,
                const Hooks &hooks) { return nlopt_search(algorithm, problem, parameters, hooks); };
}
} // namespace

std::string complaint(const OptimizationResult &result, const OptimizationParameters &parameters)
{
  const bool is_feasible = result.constraint_violation <= parameters.constraint_tolerance;
  const bool is_cut_short =
    result.stop_reason == "interrupted" || result.stop_reason == "maximum evaluations";
  if (result.success || (is_feasible && is_cut_short))
    return "";
  std::ostringstream text;
  text << "the optimization is not solved to its tolerance: it stopped by " << result.stop_reason;
  if (!is_feasible)
    text << "; the design found violates a constraint by " << result.constraint_violation
         << " of its limit";
  return text.str();
}

const ChoiceTable<Algorithm> &algorithm_table()
{
  static const ChoiceTable<Algorithm> table = {
    {"SLSQP",
     "sequential quadratic programming (Kraft) of the NLopt library, for "
     "all constraints",
     of_nlopt(NloptAlgorithm::SLSQP)},
    {"MMA", "method of moving asymptotes (Svanberg) of NLopt, for inequalities",
     of_nlopt(NloptAlgorithm::MMA)},
    {"CCSAQ", "its relative with separable quadratic models, for inequalities",
     of_nlopt(NloptAlgorithm::CCSAQ)},
    {"AUGLAG", "augmented Lagrangian of NLopt around its L-BFGS, for all constraints",
     of_nlopt(NloptAlgorithm::AUGLAG)}};
  return table;
}

bool takes_equalities(const std::string &algorithm)
{
  return algorithm != "MMA" && algorithm != "CCSAQ";
}

OptimizationResult
minimize(const DesignProblem &problem, const OptimizationParameters &parameters, const Hooks &hooks)
{
  OptimizationParameters checked = parameters;
  Entries                entries;
  checked.declare(entries);
  entries.check(Origins(), 0);
  return choose(algorithm_table(), parameters.algorithm).make(problem, parameters, hooks);
}
} // namespace snug::optimization
