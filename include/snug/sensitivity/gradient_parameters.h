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
  return {{"energy", "no solve; for potential energy and volume"},
          {"adjoint", "one linear solve per response, with the factorizations of the state"},
          {"direct", "one linear solve per variable for the derivatives of the state, with the "
                     "factorizations of the state"},
          {"finite differences", "differences of states with cold starts, for comparison"}};
}

/// Order in which the right-hand sides of a direct or adjoint solve are solved.
enum class Solves
{
  block,   ///< all at once, by block PCPG
  recycled ///< one after the other; each starts in the directions so far
};
inline Names names(Solves)
{
  return {{"block", "all at once"},
          {"recycled", "one after the other, each projected onto the search directions of the "
                       "solves before"}};
}

/// Way in which the derivatives K', f', B' and g' are computed.
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
  return {{"exact", "analytic derivatives"},
          {"forward differences", "forward differences of element quantities (semi-analytic)"},
          {"central differences", "central differences of element quantities"},
          {"refined forward differences",
           "forward differences with exact derivatives for the rigid motion of each element, for "
           "slender bodies"},
          {"refined central differences",
           "central differences with exact derivatives for the rigid motion of each element"}};
}

/// Entries of `subsection Gradient`.
struct GradientParameters
{
  /// no value: see cheapest_methods()
  std::optional<Method> method;
  Solves                solves      = Solves::block;
  Derivatives           derivatives = Derivatives::exact;
  /// step of the semi-analytic differences, relative to the cell size
  double semi_analytic_step = 1e-5;
  /// formula of the overall finite differences
  elasticity::Differences differences = elasticity::Differences::central;
  /// step of the overall finite differences, relative to the width of the bounds
  double step = 1e-4;
  /// minimum relative tolerance of the derivatives of states; searches set it
  double state_tolerance = 0.;
  /// whether dJ/dX at the nodes is computed too
  bool shape_gradient = false;
  /// for Task = sensitivity: whether all methods are compared or only the chosen one is used
  bool compare = true;

  void declare(Entries &entries);
};
} // namespace snug::sensitivity

#endif
