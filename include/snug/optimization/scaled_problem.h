#ifndef snug_optimization_scaled_problem_h
#define snug_optimization_scaled_problem_h

#include <snug/optimization/design_problem.h>
#include <snug/optimization/projected_gradient.h>

#include <deque>
#include <memory>
#include <vector>

namespace snug::optimization {
/**
 * This class states a design problem in the variables of the optimizer and evaluates each design
 * once.
 *
 * | symbol | meaning                                                 |
 * |--------|---------------------------------------------------------|
 * | w_i    | length of variable i, at most the width of its bounds;  |
 * |        | a tenth of that if the problem gives none; 1 if its     |
 * |        | bounds are equal                                        |
 * | y      | (x - start) / w, so that y = 0 is exactly the start     |
 * | F      | objective_scale(): abs(f(start)), but not further than a|
 * |        | factor 100 from norm(w df/dx(start)), so that the first |
 * |        | step, which is steepest descent, has a sensible length  |
 * | s_j    | constraint scales, but at least a hundredth of          |
 * |        | norm(w dc_j/dx(start)); this norm for a scale of 0, and |
 * |        | 1 if that is 0, too, or the problem gives no scales     |
 *
 * The optimizer sees f / F and c_j / s_j as functions of y.
 */
class ScaledProblem
{
public:
  /// This struct holds a design and its values, in the units of the problem.
  struct Point
  {
    std::vector<double> y, x;
    /// with gradients after differentiated(); rejected designs need none
    mutable Evaluation evaluation;
    double             violation = 0.; ///< max |c_j| / s_j, of c_j+ for inequalities
  };

  /**
   * Check the problem and evaluate its start, which is moved into the bounds.
   * @throws InputError, see minimize(); SolveError if the start has a
   *   value that is not finite; exceptions of evaluate().
   */
  explicit ScaledProblem(const DesignProblem &problem);

  /// Return the values at @p y. The point of a recent design that differs by at most 1e-13 of the
  /// lengths is returned without an evaluation.
  /// @throws SolveError if a value is not finite; exceptions of evaluate().
  std::shared_ptr<const Point> at(const std::vector<double> &y);

  /// Return the values at @p y, where the variables that enter linearly have their best values.
  /// @throws like at().
  std::shared_ptr<const Point> settled_at(const std::vector<double> &y);

  /// Return the values with their gradients, which are computed at the first call for a point. All
  /// functions that need gradients call this function.
  /// @throws SolveError if a derivative is not finite; exceptions of differentiate().
  const Evaluation &differentiated(const Point &point) const;

  /// Return whether at() needs no evaluation.
  bool is_cached(const std::vector<double> &y) const { return find(y) != nullptr; }

  /// Return y of a design x.
  std::vector<double> scaled(const std::vector<double> &x) const;

  /// Return w_i df/dx_i / F.
  std::vector<double> gradient(const Point &point) const;

  /// Return w_i dc_j/dx_i / s_j, one row per constraint.
  std::vector<std::vector<double>> jacobian(const Point &point) const;

  /// Return c_j / s_j.
  std::vector<double> constraints(const Evaluation &evaluation) const;

  /// A constraint that changes by less than this part of its scale in a step of the lengths has no
  /// gradient: its derivatives are round-off, or negligible like round-off.
  static constexpr double no_slope = 1e-8;

  /// Return whether the gradient of an active constraint vanishes to round-off. A first-order
  /// method then has no direction in which the constraint changes.
  bool is_blind(const Point &point) const;

  /// Return the projected gradient defined at Iteration.
  double projected_gradient(const Point &point) const;
  /// Return the multipliers mu of projected_gradient() with respect to f / F and c_j / s_j; 0 for
  /// constraints that are not active.
  std::vector<double> multipliers(const Point &point) const;

  /// Return the relation of each constraint.
  const std::vector<Relation>        &relations() const { return constraint_relations; }
  const std::vector<double>          &lower() const { return y_lower; }
  const std::vector<double>          &upper() const { return y_upper; }
  double                              objective_scale() const { return scale; }
  const std::shared_ptr<const Point> &start() const { return start_point; }
  /// Return the number of variables.
  unsigned int size() const { return static_cast<unsigned int>(lengths.size()); }
  /// Return the maximum of |d_i| over the variables that enter the functions nonlinearly.
  double length(const std::vector<double> &d) const;
  /// Return the number of variables that enter the functions nonlinearly; the others follow them.
  unsigned int n_nonlinear() const { return size() - problem.n_linear; }
  /// Return the width of the bounds of variable @p i, relative to its length.
  double bound_width(unsigned int i) const { return y_upper[i] - y_lower[i]; }

  /// This struct holds predicted values and derivatives of the scaled objective and constraints.
  struct Prediction
  {
    double                           objective = 0.;
    std::vector<double>              gradient, constraints;
    std::vector<std::vector<double>> jacobian;
  };
  /// Return the prediction at y + @p d, where y belongs to @p at.
  Prediction predicted(const Point &at, const std::vector<double> &d) const;
  bool       predicts_objective() const { return problem.predicts_objective; }

  /// Return the projected gradient, not divided by any norm, and the multipliers of all
  /// constraints, 0 of those that are not active, where @p at_bounds says which variables may move
  /// where.
  ProjectedGradient projected(const Prediction &at, const std::vector<BoundState> &at_bounds) const;

  /// Return the number of calls of evaluate() of the problem, including those that threw.
  unsigned int n_evaluations() const { return evaluations; }

private:
  std::shared_ptr<const Point> find(const std::vector<double> &y) const;
  std::vector<double>          design(const std::vector<double> &y) const;
  std::shared_ptr<Point>       evaluated(const std::vector<double> &y);
  std::shared_ptr<const Point> remembered(const std::shared_ptr<Point> &point);
  void                         scale_constraints(const Point &start);
  bool                         is_active(unsigned int j, double c) const;
  ProjectedGradient            projected(const Point &point) const;

  const DesignProblem                     &problem;
  std::vector<double>                      x_start, lengths, y_lower, y_upper;
  std::vector<double>                      scales;
  std::vector<Relation>                    constraint_relations;
  double                                   scale               = 1.;
  double                                   start_gradient_norm = 0.;
  unsigned int                             evaluations         = 0;
  std::deque<std::shared_ptr<const Point>> recent;
  std::shared_ptr<const Point>             start_point;
};
} // namespace snug::optimization

#endif
