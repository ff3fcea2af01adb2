#ifndef snug_optimization_epigraph_h
#define snug_optimization_epigraph_h

#include <snug/optimization/minimize.h>

#include <deque>
#include <memory>

namespace snug::optimization {
/**
 * This class replaces the maxima of a design problem by variables: the smooth problem
 * @f[ \min_{x, \tau} f(x) - \sum_k m_k(x) + \sum_k \tau_k, \quad c_j(x) \le \tau_k
 *     \text{ for the terms } j \text{ of } m_k = \max_j c_j, @f]
 * and likewise for constraints that contain maxima, has the same minimizers. The new variables
 * follow those of the design problem and enter all functions linearly.
 */
class Epigraph
{
public:
  /// Evaluate the start of @p problem, which must outlive this object.
  explicit Epigraph(const DesignProblem &problem);

  /// Return the smooth problem, which refers to this object.
  const DesignProblem &smooth_problem() const { return smooth; }

  /// Return hooks for the smooth problem that report designs and values of the design problem.
  Hooks hooks(const Hooks &given) const;

  /// Return a result of the smooth problem as a result of the design problem.
  OptimizationResult result(OptimizationResult of_smooth) const;

private:
  using Values = std::shared_ptr<Evaluation>;

  Values              evaluated(const std::vector<double> &x);
  std::vector<double> design(const std::vector<double> &with_tau) const;
  std::vector<double> tau(const std::vector<double> &with_tau) const;
  unsigned int        largest(const Evaluation &at, const Maximum &maximum) const;
  Evaluation          to_smooth(const Evaluation &at, const std::vector<double> &tau) const;
  Evaluation          from_smooth(const Evaluation &at) const;

  const DesignProblem                               &problem;
  DesignProblem                                      smooth;
  std::deque<std::pair<std::vector<double>, Values>> recent; ///< the newest first
  double                                             objective_initial;
};
} // namespace snug::optimization

#endif
