#ifndef snug_sensitivity_gradient_problem_h
#define snug_sensitivity_gradient_problem_h

#include <snug/response/response.h>
#include <snug/sensitivity/gradient_parameters.h>
#include <snug/shape/shape_basis.h>

#include <optional>

namespace snug::sensitivity {
/// The design and the state at which the responses are differentiated.
template <int dim>
struct GradientProblem
{
  state::StateSolver<dim>        &solver;
  const shape::ShapeBasis<dim>   &basis;
  const state::ContactState<dim> &state; ///< state at the design
  const std::vector<double>      &design;
  const std::vector<double>       bound_widths; ///< per variable
  const GradientParameters       &parameters;
};

/// The states of one design in all load cases, in their order. A load step refers to the state that
/// it continues (state::LoadCase::after).
template <int dim>
using LoadCases = std::vector<GradientProblem<dim>>;

/// A response of one load case.
template <int dim>
struct Measured
{
  const response::Response<dim> *response;
  unsigned int                   load_case; ///< index into LoadCases

  bool operator==(const Measured &other) const
  {
    return response == other.response && load_case == other.load_case;
  }
};

template <int dim>
using MeasuredResponses = std::vector<Measured<dim>>;

/// Responses of one state.
template <int dim>
using Responses = std::vector<const response::Response<dim> *>;

/// A gradient dJ/dalpha.
template <int dim>
struct Gradient
{
  Method              method = Method::energy; ///< the method used
  std::string         reason;                  ///< reason if "auto" chose the method, else empty
  std::vector<double> values;
  /// dJ/dX if the method computes it: this rank's share at the local nodes, including hanging
  /// nodes. The values are the products of this field with the velocities.
  std::optional<mesh::Field<dim>> shape = {};
  /// False at weakly active contacts, where J has only one-sided derivatives. The
  /// values are then the derivatives for the strongly active set alone.
  bool differentiable = true;
};

/// Gradients of several responses at one state and the cost of computing them together.
template <int dim>
struct Gradients
{
  std::vector<Gradient<dim>> of_response;
  /// u'_j at the local nodes, if the method computes it. The variables of the load cases follow one
  /// another, here and below.
  std::vector<mesh::Field<dim>> displacement = {};
  /// derivatives of the normal contact forces, per variable and contact row, if the method
  /// is direct; equal on all ranks [force / variable]
  std::vector<std::vector<double>> forces                 = {};
  unsigned long                    f_mults                = 0;
  unsigned long                    numeric_factorizations = 0;
  double                           seconds                = 0.; ///< wall
};
} // namespace snug::sensitivity

#endif
