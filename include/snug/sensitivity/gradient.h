#ifndef snug_sensitivity_gradient_h
#define snug_sensitivity_gradient_h

#include <snug/response/response.h>
#include <snug/sensitivity/gradient_parameters.h>
#include <snug/shape/shape_basis.h>

namespace snug
{
  namespace sensitivity
  {
    /// A gradient dJ/dalpha and what it cost.
    struct Gradient
    {
      std::string         method; ///< the method used, never "auto"
      std::vector<double> values;
      unsigned long       f_mults                = 0;
      unsigned long       numeric_factorizations = 0;
      double              seconds                = 0.; ///< wall
    };

    /// Everything a gradient is taken of.
    template <int dim>
    struct GradientProblem
    {
      state::StateSolver<dim>        &solver;
      const shape::ShapeBasis<dim>   &basis;
      const response::Response<dim>  &response;
      const state::ContactState<dim> &state; ///< at design
      const std::vector<double>      &design;
      const std::vector<double>      &bound_widths; ///< per variable
      const GradientParameters       &parameters;
    };

    /// Node positions of a design: reference + V alpha.
    template <int dim>
    typename mesh::BodyMesh<dim>::Field
    positions(const mesh::BodyMesh<dim>    &mesh,
              const shape::ShapeBasis<dim> &basis,
              const std::vector<double>    &design);

    /// "auto", "energy", "direct", "finite differences".
    template <int dim>
    const ChoiceTable<std::vector<double>(const GradientProblem<dim> &)> &
    gradient_table();

    /**
     * dJ/dalpha by @p method, a name of gradient_table(). Finite differences
     * leave the solver at another geometry than the state's: solve again
     * before asking it for more. Collective.
     * @throws SolveError, InputError if the response has no energy gradient.
     */
    template <int dim>
    Gradient
    gradient(const GradientProblem<dim> &problem, const std::string &method);
  } // namespace sensitivity
} // namespace snug

#endif
