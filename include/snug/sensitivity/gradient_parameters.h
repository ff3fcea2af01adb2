#ifndef snug_sensitivity_gradient_parameters_h
#define snug_sensitivity_gradient_parameters_h

#include <snug/elasticity/finite_difference.h>

#include <optional>

namespace snug {
class Entries;
}

namespace snug::sensitivity {
enum class Method
{
  energy,
  adjoint,
  direct,
  finite_differences
};
inline Names names(Method)
{
  return {{"energy", "without any solve, for potential energy and volume"},
          {"adjoint", "one linear solve per response with the state's factorizations"},
          {"direct", "the derivatives of the state, one linear solve per variable with the state's "
                     "factorizations"},
          {"finite differences", "differences of cold-started states, a baseline"}};
}

/// How many right-hand sides of a direct or adjoint solve are solved together.
enum class Solves
{
  block,   ///< all, by block PCPG
  recycled ///< one after the other; each starts in the directions so far
};
inline Names names(Solves)
{
  return {{"block"}, {"recycled"}};
}

/// How the derivatives K', f', B' and g' are taken.
enum class Derivatives
{
  exact,
  forward,
  central,
  refined_forward, ///< see SemiAnalytic
  refined_central
};
inline Names names(Derivatives)
{
  return {{"exact", "differentiated by hand"},
          {"forward differences", "of element quantities (semi-analytic)"},
          {"central differences", "the same from both sides"},
          {"refined forward differences",
           "forward ones that take the rigid motion of each element exactly, for slender bodies"},
          {"refined central differences", "the same from both sides"}};
}

/// Entries of `subsection Gradient`.
struct GradientParameters
{
  /// none: see cheapest_methods()
  std::optional<Method> method;
  Solves                solves      = Solves::block;
  Derivatives           derivatives = Derivatives::exact;
  /// step of their differences, relative to cell size
  double semi_analytic_step = 1e-5;
  /// overall finite differences
  elasticity::Differences differences = elasticity::Differences::central;
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
