#ifndef snug_app_evaluator_h
#define snug_app_evaluator_h

#include <snug/app/shape_problem.h>
#include <snug/app/start_history.h>
#include <snug/optimization/design_problem.h>
#include <snug/optimization/limit.h>

namespace snug::app {
/**
 * The optimization problem of a scene: its objective and its constraints
 * with their gradients as functions of the design. What it remembers of
 * the design before, where its solver starts, changes values within the
 * solver's tolerance only.
 */
template <int dim>
class Evaluator
{
public:
  using Design = typename ShapeProblem<dim>::Design;
  using States = typename ShapeProblem<dim>::States;

  /// Solves the first design if a limit or the scale of 'worst' is relative
  /// to it. Collective.
  explicit Evaluator(ShapeProblem<dim> &problem);

  /// The values, without gradients. Collective. @throws TangledMesh, SolveError.
  optimization::Evaluation evaluate(const Design &design);

  /// Adds the gradients to @p evaluation of @p design, which is solved again if it is not the last
  /// one evaluated. Collective. @throws TangledMesh, SolveError.
  void differentiate(const Design &design, optimization::Evaluation &evaluation);

  /// The problem of an optimizer that begins at @p start; refers to this.
  optimization::DesignProblem design_problem(const Design &start);

  /// Objective and constraints of @p states, without derivatives, and what
  /// the largest violation is relative to its limit. Collective.
  struct Values
  {
    double              objective = 0., violation = 0.;
    std::vector<double> constraints; ///< c(x)
  };
  Values values(const States &states);

  /// Pair contact anew at @p design, which ends all states of before.
  /// Collective.
  void pair(const Design &design);

  /// States of the first design, cold if they have to be solved; not to be
  /// asked for after pair(). Collective.
  const States &first_states();

  /// @name Of the last design evaluated; empty before
  /// @{
  Design design;
  States states;
  /// of the objective, then of the constraints; of none before differentiate()
  sensitivity::Gradients<dim> gradients;
  /// @}

  /// Return whether the contact forces and areas of a design are used as linear functions of the
  /// variables, see predicted(): if the objective or a constraint depends on the state by forces
  /// and areas alone, and `Gradient/Method` is direct, or auto with at most most_predicted
  /// variables.
  bool                          is_predicted() const;
  static constexpr unsigned int most_predicted = 60;

private:
  struct Constraint
  {
    std::unique_ptr<response::Response<dim>> response;
    unsigned int                             load_case;
    double                                   target;
    optimization::Limit::Side                side;

    /// c = sign (J - target), c = 0 or c <= 0.
    double sign() const { return side == optimization::Limit::Side::at_least ? -1. : 1.; }
  };

  Constraint make_constraint(const std::string &name, const std::string &limit);

  ShapeProblem<dim>                      &problem;
  std::vector<Constraint>                 constraints;
  std::vector<sensitivity::Measured<dim>> measured; ///< of the constraints
  StartHistory                            starts;
  States                                  of_first;

  bool                     measures_contact(const response::Response<dim> &response) const;
  std::vector<double>      linearized_contact() const;
  optimization::Evaluation predicted(const optimization::Evaluation &at,
                                     const std::vector<double>      &dx) const;
};
} // namespace snug::app

#endif
