#ifndef snug_sensitivity_gradient_problem_h
#define snug_sensitivity_gradient_problem_h

#include <snug/response/response.h>
#include <snug/sensitivity/gradient_parameters.h>
#include <snug/shape/shape_basis.h>

namespace snug
{
  namespace sensitivity
  {
    /// The design and the state everything is differentiated at.
    template <int dim>
    struct GradientProblem
    {
      state::StateSolver<dim>        &solver;
      const shape::ShapeBasis<dim>   &basis;
      const state::ContactState<dim> &state; ///< at design
      const std::vector<double>      &design;
      const std::vector<double>      &bound_widths; ///< per variable
      const GradientParameters       &parameters;
    };

    /// What is differentiated.
    template <int dim>
    using Responses = std::vector<const response::Response<dim> *>;

    /// A gradient dJ/dalpha.
    struct Gradient
    {
      std::string         method; ///< the method used, never "auto"
      std::string         reason; ///< why "auto" took it; else empty
      std::vector<double> values;
    };

    /// Node positions of a design: reference + V alpha.
    template <int dim>
    typename mesh::BodyMesh<dim>::Field
    positions(const mesh::BodyMesh<dim>    &mesh,
              const shape::ShapeBasis<dim> &basis,
              const std::vector<double>    &design);
  } // namespace sensitivity
} // namespace snug

#endif
