#include <snug/optimization/dense_vectors.h>
#include <snug/optimization/linear_limits.h>

namespace snug::optimization {
DesignProblem with_limits(DesignProblem problem, const std::vector<LinearLimit> &limits)
{
  // predict() of the problem needs no change, because it treats constraints that it does not know
  // as linear functions.
  const auto add_rows = [limits](Evaluation &evaluation) {
    if (!evaluation.jacobian.empty() || !evaluation.gradient.empty())
      for (const auto &limit : limits)
        evaluation.jacobian.push_back(limit.row);
  };
  problem.evaluate = [evaluate = std::move(problem.evaluate), limits,
                      add_rows](const std::vector<double> &x) {
    Evaluation result = evaluate(x);
    for (const auto &limit : limits)
      result.constraints.push_back(dot(limit.row, x) - limit.bound);
    add_rows(result);
    return result;
  };
  if (problem.differentiate)
    problem.differentiate = [differentiate = std::move(problem.differentiate),
                             add_rows](const std::vector<double> &x, Evaluation &evaluation) {
      differentiate(x, evaluation);
      add_rows(evaluation);
    };
  for (const auto &limit : limits)
    {
      problem.relations.push_back(Relation::at_most);
      problem.constraint_scales.push_back(std::abs(limit.bound));
    }
  return problem;
}
} // namespace snug::optimization
