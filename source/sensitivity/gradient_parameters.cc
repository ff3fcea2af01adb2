#include <snug/base/entries.h>
#include <snug/sensitivity/gradient_parameters.h>

namespace snug::sensitivity {
void GradientParameters::declare(Entries &entries)
{
  entries.add("Method", method,
              choice_or_auto<sensitivity::Method>(
                "cheapest exact method: energy if it applies, else adjoint if there are fewer "
                "responses than variables, else direct"),
              "The method that differentiates the objective.");
  entries.add("Solves", solves,
              "The order in which the linear problems of the adjoint and direct methods are "
              "solved.");
  entries.add("Derivatives", derivatives,
              "The method that differentiates stiffness, loads and contact rows.");
  entries.add("Semi-analytic step", semi_analytic_step, above(0., 0.1),
              "The step of the differences of 'Derivatives', relative to the cell size, above 0 "
              "and at most 0.1.");
  entries.add("Differences", differences, "The formula of overall finite differences.");
  entries.add("Step", step, above(0., 0.1),
              "The step of overall finite differences, relative to the width of the bounds, above "
              "0 and at most 0.1.");
  entries.add(
    "Shape gradient", shape_gradient,
    "Whether to write the derivative of the objective with respect to the node positions, "
    "as the point field shape_gradient of solution.pvd.");
  entries.add("Compare", compare,
              "Whether 'Task = sensitivity' compares all methods, or uses 'Gradient/Method' only.");
}
} // namespace snug::sensitivity
