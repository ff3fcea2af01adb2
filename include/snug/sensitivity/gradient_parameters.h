#ifndef snug_sensitivity_gradient_parameters_h
#define snug_sensitivity_gradient_parameters_h

#include <string>

namespace snug
{
  namespace sensitivity
  {
    /// Entries of `subsection Gradient`.
    struct GradientParameters
    {
      /// name in gradient_table()
      std::string method = "auto";
      /// right-hand sides of a direct or adjoint solve: block | recycled
      std::string solves = "block";
      /// of K', f', B', g': exact | finite differences (semi-analytic)
      std::string derivatives = "exact";
      /// central difference step of K', f', B', g', relative to cell size
      double semi_analytic_step = 1e-5;
      /// central step of overall finite differences, relative to the width
      /// of the bounds
      double step = 1e-4;
    };
  } // namespace sensitivity
} // namespace snug

#endif
