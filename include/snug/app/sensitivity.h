#ifndef snug_app_sensitivity_h
#define snug_app_sensitivity_h

#include <snug/app/results.h>

namespace snug::app {
/**
 * This class differentiates the objective of a scene at the start design: by Gradient/Method or,
 * with Gradient/Compare, by all methods. A table of the gradients is printed, which at weakly
 * active contacts has the one-sided derivatives too. The solver is left at another design.
 */
template <int dim>
class Sensitivity
{
public:
  using Field  = typename ShapeProblem<dim>::Field;
  using States = typename ShapeProblem<dim>::States;

  /// Differentiate at @p states, those of the start design. References to all arguments are kept.
  /// Collective. @throws SolveError.
  Sensitivity(ShapeProblem<dim> &problem, Results<dim> &results, const States &states);

  /// Write gradients.csv: the gradients of the objective and of all responses of each load case.
  /// Collective.
  void write_all(const std::string &path) const;

  /// gradients of the objective, for the summary
  io::Summary::Gradient gradient;
  /// shape gradient by the chosen method, if the scene asks for it: share of this rank
  std::optional<Field> shape_gradient;

private:
  /// This struct describes a column of the table.
  struct Method
  {
    std::string                     name;
    sensitivity::GradientParameters parameters;
  };

  std::vector<Method> methods() const;
  void                choose_method();
  void                add(const Method &method);
  void                add_one_sided();
  double              displacement_difference(const std::vector<Field> &derivatives) const;

  ShapeProblem<dim>  &problem;
  Results<dim>       &results;
  const States       &states;
  sensitivity::Method chosen;
  /// u'_j by the direct method, of one load case after the other
  std::vector<Field> reference;
};
} // namespace snug::app

#endif
