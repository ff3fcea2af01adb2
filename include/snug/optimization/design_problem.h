#ifndef snug_optimization_design_problem_h
#define snug_optimization_design_problem_h

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace snug::optimization {
/// This struct holds the values at a design and, once they are computed, the gradients.
struct Evaluation
{
  double                           objective = 0.;
  std::vector<double>              gradient;    ///< n; empty: not known
  std::vector<double>              constraints; ///< m values c(x)
  std::vector<std::vector<double>> jacobian;    ///< m rows of n; empty with the gradient
  /// what predict() of the problem needs at this design; empty: nothing
  std::vector<double> linearization;
  /// @name For the history; optimizers do not read them
  /// @{
  std::vector<double> reported; ///< further values of the design
  unsigned int        active_contacts       = 0;
  unsigned long       f_mults               = 0;
  double              least_scaled_jacobian = 0.; ///< of all cells
  double              seconds               = 0.; ///< since the run began
  /// @}
};

/// Relation of a constraint's value to zero.
enum class Relation
{
  equal,   ///< c(x) = 0
  at_most, ///< c(x) <= 0
  term     ///< c(x) is a term of a Maximum
};

/// This struct describes the maximum of several terms that the objective or a constraint contains.
struct Maximum
{
  int          of;         ///< -1: the objective, else the index of the constraint
  unsigned int begin, end; ///< constraints of the relation `term`
};

/// Return by how much a constraint is violated: |c| of an equality, max(0, c) of an inequality.
inline double violation(const Relation relation, const double c)
{
  return relation == Relation::equal ? std::abs(c) : std::max(0., c);
}

/// This struct describes the problem min f(x), c_j(x) = 0 or c_j(x) <= 0, lower <= x <= upper, of
/// vectors x.
struct DesignProblem
{
  std::vector<double> lower, upper, start;
  /// throws TangledMesh for designs without a value
  std::function<Evaluation(const std::vector<double> &)> evaluate;
  /// Add the gradients to what evaluate() gave at the design, which costs little if nothing else
  /// was evaluated since. None: evaluate() gives them.
  std::function<void(const std::vector<double> &, Evaluation &)> differentiate;
  /// Return the data that this rank keeps from one evaluate() to the next (the warm start of a
  /// solver). differentiate() does not change the data. Both memory and remember are set, or
  /// none; not collective.
  std::function<std::string()> memory;
  /// Restore the data that memory() returned. @return false, with all data cleared, if the bytes
  /// are empty, incomplete or not of this problem.
  std::function<bool(const std::string &)> remember;
  /// of each constraint; empty: all are equalities
  std::vector<Relation> relations;
  /// |c| is measured relative to these, or to its slope where that is far
  /// steeper, see ScaledProblem; 0: to its slope
  std::vector<double> constraint_scales;
  /// of each variable, the change that a first step may make; empty: a tenth of the bounds' widths
  std::vector<double> lengths;
  /**
   * Return the prediction of the values and derivatives at x + dx from the linearization that
   * differentiate() stores in the Evaluation @p at x, for responses that are known functions of
   * nearly linear quantities. None: the functions are linear. Not collective.
   */
  std::function<Evaluation(const Evaluation &at, const std::vector<double> &dx)> predict;
  /// Maxima that the objective and the constraints contain. Their values are the sums of smooth
  /// functions and maxima; their gradients are those of the first of the largest terms.
  std::vector<Maximum> maxima;
  /// number of the last variables that enter all functions linearly
  unsigned int n_linear = 0;
  /// Return a design with these variables at their best values for the others. Empty: as it is.
  std::function<std::vector<double>(const std::vector<double> &)> settle;
  /// predict() has the curvature of the objective; else it is learnt from gradients.
  bool predicts_objective = false;
};
} // namespace snug::optimization

#endif
