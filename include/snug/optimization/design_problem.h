#ifndef snug_optimization_design_problem_h
#define snug_optimization_design_problem_h

#include <functional>
#include <string>
#include <vector>

namespace snug::optimization {
/// Values and gradients at a design.
struct Evaluation
{
  double                           objective = 0.;
  std::vector<double>              gradient;    ///< n
  std::vector<double>              constraints; ///< m values c(x)
  std::vector<std::vector<double>> jacobian;    ///< m rows of n
  /// @name For the history; no optimizer looks at them
  /// @{
  unsigned int  active_contacts       = 0;
  unsigned long f_mults               = 0;
  double        least_scaled_jacobian = 0.; ///< of all cells
  double        seconds               = 0.; ///< since the run began
  /// @}
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
  /// What this rank takes along from one evaluation to the next (the warm
  /// start of a solver), as at least one byte. Both or none; not collective.
  std::function<std::string()> memory;
  /// Take it along again. @return false, with all forgotten, if the bytes
  /// are not whole or not of this problem, as no bytes are.
  std::function<bool(const std::string &)> remember;
  /// of each constraint; empty: all are equalities
  std::vector<Relation> relations;
  /// |c| is measured relative to these, or to its slope where that is far
  /// steeper, see ScaledProblem; 0: to its slope
  std::vector<double> constraint_scales;
};
} // namespace snug::optimization

#endif
