#ifndef snug_sensitivity_gradient_problem_h
#define snug_sensitivity_gradient_problem_h

#include <snug/response/response.h>
#include <snug/sensitivity/gradient_parameters.h>
#include <snug/shape/shape_basis.h>

#include <optional>

namespace snug::sensitivity {
/// The design and the state everything is differentiated at.
template <int dim>
struct GradientProblem
{
  state::StateSolver<dim>        &solver;
  const shape::ShapeBasis<dim>   &basis;
  const state::ContactState<dim> &state; ///< at design
  const std::vector<double>      &design;
  const std::vector<double>       bound_widths; ///< per variable
  const GradientParameters       &parameters;
};

/// What is differentiated.
template <int dim>
using Responses = std::vector<const response::Response<dim> *>;

/// A gradient dJ/dalpha.
template <int dim>
struct Gradient
{
  Method              method = Method::energy; ///< the method used
  std::string         reason;                  ///< why "auto" took it; else empty
  std::vector<double> values;
  /// dJ/dX if the method has it: this rank's share at the local nodes,
  /// hanging ones included; values are its products with the velocities.
  std::optional<typename mesh::BodyMesh<dim>::Field> shape = {};
  /// False where J has only one-sided derivatives, at weakly active
  /// contacts: the values are those of the strongly active set alone.
  bool differentiable = true;
};

/// Gradients of several responses at one state and what they cost together.
template <int dim>
struct Gradients
{
  std::vector<Gradient<dim>> of_response;
  /// u'_j at the local nodes, if the method has it
  std::vector<typename mesh::BodyMesh<dim>::Field> displacement = {};
  /// of the contact forces, per variable and contact row, if the method is direct; equal on all
  /// ranks [force / variable]
  std::vector<std::vector<double>> forces                 = {};
  unsigned long                    f_mults                = 0;
  unsigned long                    numeric_factorizations = 0;
  double                           seconds                = 0.; ///< wall
};
} // namespace snug::sensitivity

#endif
