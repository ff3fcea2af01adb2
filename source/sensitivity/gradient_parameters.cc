#include <snug/base/entries.h>
#include <snug/sensitivity/gradient_parameters.h>

namespace snug::sensitivity {
void GradientParameters::declare(Entries &entries)
{
  entries.add("Method", method,
              choice_or_auto<sensitivity::Method>(
                "the cheapest exact one: energy where it applies, else adjoint for fewer responses "
                "than variables, else direct"),
              "How the objective is differentiated.");
  entries.add(
    "Solves", solves,
    "How the linear problems of the adjoint and direct methods are solved: block: all at once; "
    "recycled: one after the other, each starting in the search directions of those before.");
  entries.add("Derivatives", derivatives, "Derivatives of stiffness, loads and contact rows.");
  entries.add("Semi-analytic step", semi_analytic_step, above(0., 0.1),
              "Step of those differences relative to the cell size; above 0, at most 0.1.");
  entries.add("Differences", differences, "Formula of overall finite differences.");
  entries.add("Step", step, above(0., 0.1),
              "Step of overall finite differences relative to the width of the bounds; above 0, at "
              "most 0.1.");
  entries.add("Shape gradient", shape_gradient,
              "Also write the derivative of the objective by the positions of the nodes, the point "
              "field shape_gradient of solution.pvd.");
  entries.add("Compare", compare,
              "Task = sensitivity: all methods side by side, or only Gradient/Method.");
}
} // namespace snug::sensitivity
