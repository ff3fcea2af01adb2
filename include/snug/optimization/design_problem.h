#ifndef snug_optimization_design_problem_h
#define snug_optimization_design_problem_h

#include <functional>
#include <vector>

namespace snug::optimization {
/// Values and gradients at a design.
struct Evaluation
{
  double                           objective = 0.;
  std::vector<double>              gradient;    ///< n
  std::vector<double>              constraints; ///< m values c(x)
  std::vector<std::vector<double>> jacobian;    ///< m rows of n
  /// active contacts, F-mults, seconds: carried into history, not used
  std::vector<double> notes;
};

/// What a constraint demands.
enum class Relation
{
  equal,  ///< c(x) = 0
  at_most ///< c(x) <= 0
};

/// min f(x), c_j(x) = 0 or c_j(x) <= 0, lower <= x <= upper. Vectors only.
struct DesignProblem
{
  std::vector<double> lower, upper, start;
  /// throws TangledMesh for designs without a value
  std::function<Evaluation(const std::vector<double> &)> evaluate;
  /// of each constraint; empty: all are equalities
  std::vector<Relation> relations;
  /// |c| is measured relative to these
  std::vector<double> constraint_scales;
};
} // namespace snug::optimization

#endif
