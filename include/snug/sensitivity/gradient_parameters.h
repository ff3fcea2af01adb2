#ifndef snug_sensitivity_gradient_parameters_h
#define snug_sensitivity_gradient_parameters_h

#include <string>

namespace snug {
class Entries;
}

namespace snug::sensitivity {
/// Entries of `subsection Gradient`.
struct GradientParameters
{
  /// name in gradient_table()
  std::string method = "auto";
  /// right-hand sides of a direct or adjoint solve: block | recycled
  std::string solves = "block";
  /// of K', f', B', g': name in derivatives_table()
  std::string derivatives = "exact";
  /// step of their differences, relative to cell size
  double semi_analytic_step = 1e-5;
  /// overall finite differences: name in stencil_table()
  std::string differences = "central";
  /// their step, relative to the width of the bounds
  double step = 1e-4;
  /// also give dJ/dX on the nodes
  bool shape_gradient = false;
  /// Task = sensitivity: all methods, or only the method
  bool compare = true;

  void declare(Entries &entries);
};
} // namespace snug::sensitivity

#endif
