#ifndef snug_app_sensitivity_h
#define snug_app_sensitivity_h

#include <snug/app/results.h>

namespace snug::app {
/**
 * The objective of a scene differentiated at @p states, those of the start:
 * by Gradient/Method or, with Gradient/Compare, by all methods side by
 * side, printed as a table. At weakly active contacts the one-sided
 * derivatives stand beside them. Leaves the solver at another design.
 */
template <int dim>
class Sensitivity
{
public:
  using Field  = typename ShapeProblem<dim>::Field;
  using States = typename ShapeProblem<dim>::States;

  /// Collective. @throws SolveError.
  Sensitivity(ShapeProblem<dim> &problem, Results<dim> &results, const States &states);

  /// Write gradients.csv: the gradients of the objective and of all responses of each load case.
  /// Collective.
  void write_all(const std::string &path) const;

  /// For the summary.
  io::Summary::Gradient gradient;
  /// Shape gradient by the requested method, if requested: this rank's share.
  std::optional<Field> shape_gradient;

private:
  /// A column of the table.
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
