#ifndef snug_app_objective_h
#define snug_app_objective_h

#include <snug/app/analyses.h>
#include <snug/optimization/design_problem.h>
#include <snug/optimization/limit.h>

#include <optional>

namespace snug::app {
/// This struct holds the objective and the constraints of a design without derivatives.
struct DesignValues
{
  double              objective = 0.;
  std::vector<double> constraints;    ///< c(x), then the terms of maxima
  std::vector<double> constrained;    ///< values of the responses that the constraints limit
  double              violation = 0.; ///< maximum over constraints, relative to the limit
  std::string         violated;       ///< name of the constraint with the maximum violation
};

/// This class represents the objective and the constraints of a scene as functions of the design,
/// of which it gives the values and the gradients.
template <int dim>
class Objective
{
public:
  using Design = typename ShapeProblem<dim>::Design;
  using States = typename ShapeProblem<dim>::States;

  /// Read the constraints. @p paired is the design of the last contact search of @p analyses of
  /// @p problem. The first design is solved, with a contact search of its own, if a limit is
  /// relative to its value. Collective.
  Objective(const ShapeProblem<dim> &problem, Analyses<dim> &analyses, const Design &paired);

  /// Return these constraints with the objective @p response, combined over load cases as this one.
  Objective with_objective(std::shared_ptr<const response::Response<dim>> response) const;

  /// Return the response of the objective.
  const response::Response<dim> &response() const { return *quantities.front().response; }

  /// Return whether a constraint limits a response of the geometry alone, such as the volume.
  bool limits_geometry() const;

  /// Solve a design and return the values, without gradients. Collective. @throws TangledMesh,
  /// SolveError.
  optimization::Evaluation evaluate(const Design &design);

  /// Add the gradients to @p evaluation of @p design. The design is solved again unless it is the
  /// last one that was analysed. Collective. @throws TangledMesh, SolveError.
  void differentiate(const Design &design, optimization::Evaluation &evaluation);

  /// Return the gradients at @p design of the objective, of the constraints and of the terms of
  /// their maxima. They are valid until another design is analysed. The solver is then at the
  /// geometry of the design's states. Collective.
  /// @throws TangledMesh, SolveError.
  const sensitivity::Gradients<dim> &gradients(const Design &design);

  /// Return the names of the responses and the load cases of combined_gradients().
  std::vector<std::pair<std::string, unsigned int>> measured_names() const;

  /// Return the gradients of the objective, of the constraints and of the terms of their maxima,
  /// combined of @p found, the gradients at @p states of measured_names(). Collective.
  std::vector<sensitivity::Gradient<dim>>
  combined_gradients(const States                                  &states,
                     const std::vector<sensitivity::Gradient<dim>> &found) const;

  /// Return the problem of an optimizer that begins at @p start. The result refers to this object.
  optimization::DesignProblem design_problem(const Design &start);

  /// Return the objective and the constraints of @p states. Collective.
  DesignValues values(const States &states) const;

  /// A constraint and its values.
  struct ConstraintValue
  {
    std::string               name; ///< as in the scene, "volume <= initial"
    std::string               unit; ///< of the response; "" without names of units
    double                    initial, value, limit;
    optimization::Limit::Side side;
    double                    violation; ///< of the value, relative to the limit
    bool                      is_active; ///< whether the value is at the limit or beyond it
  };

  /// Return the constraints with their values in the first and in the last design. The last of
  /// @p initial and of @p reported are the values of the responses that the constraints limit.
  std::vector<ConstraintValue> constraint_values(const std::vector<double> &initial,
                                                 const std::vector<double> &reported) const;

  /// Return the maximum violation of a constraint, relative to its limit, and the name of the
  /// constraint as in the scene, such as "volume <= initial". The last of @p values are those of
  /// the responses that the constraints limit. Return {0, ""} if the values satisfy all
  /// constraints.
  std::pair<double, std::string> most_violated(const std::vector<double> &values) const;

  /// Return whether the contact forces and areas of a design are used as linear functions of the
  /// variables, see predicted(). They are if the objective or a constraint depends on the state by
  /// these alone, and if `Gradient/Method` is direct, or is auto and there are at most
  /// most_predicted variables.
  bool                          is_predicted() const;
  static constexpr unsigned int most_predicted = 60;

private:
  /// This class represents the contact forces and areas of a load case as linear functions of the
  /// variables.
  class LinearRows;

  /// This struct describes the objective or a constraint: a response, combined of its values in
  /// load cases.
  struct Quantity
  {
    std::string                                    name = {}; ///< of a constraint in the scene
    std::string                                    of   = {}; ///< name of its response
    std::shared_ptr<const response::Response<dim>> response;
    std::vector<unsigned int>                      load_cases;
    std::vector<double>                            weights; ///< of the load cases
    optimization::Combination                      combination = {};
    double                                         target      = 0.;
    optimization::Limit::Side                      side        = optimization::Limit::Side::at_most;
    std::size_t first = 0; ///< place of the first load case in `measured`

    /// Return the sign in c = sign (J - target), with c = 0 or c <= 0.
    double sign() const { return side == optimization::Limit::Side::at_least ? -1. : 1.; }

    /// Return the violation of the limit by J, relative to the limit.
    double violation(double value) const;

    /// Return J and its derivatives as a function of the values in the load cases.
    optimization::Combined combined(const std::vector<double> &values) const
    {
      return optimization::combined(combination, values, weights);
    }

    /// Return the factors of the values in the terms of maximum @p k, see n_maxima().
    std::vector<double> term_factors(unsigned int k) const;
  };

  void                add_quantity(Quantity quantity);
  Quantity            make_constraint(const std::string &name, const std::string &limit);
  bool                is_relative_to_first() const;
  std::vector<double> values(const Quantity &quantity, const States &states) const;
  void                predict(unsigned int                               i,
                              const std::vector<LinearRows>             &of_cases,
                              const std::vector<response::PressureRows> &rows,
                              optimization::Evaluation                  &result) const;
  std::vector<optimization::Maximum> maxima() const;

  const ShapeProblem<dim>                &problem;
  Analyses<dim>                          &analyses;
  std::vector<Quantity>                   quantities;     ///< the objective, then the constraints
  std::vector<sensitivity::Measured<dim>> measured;       ///< responses of the quantities
  Design                                  differentiated; ///< design of the combined gradients
  sensitivity::Gradients<dim>             combined;       ///< see gradients()

  bool                     measures_contact(const response::Response<dim> &response) const;
  std::vector<double>      linearized_contact(const Analysis<dim> &at) const;
  optimization::Evaluation predicted(const optimization::Evaluation &at,
                                     const std::vector<double>      &dx) const;
};
} // namespace snug::app

#endif
