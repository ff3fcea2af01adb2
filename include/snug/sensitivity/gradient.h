#ifndef snug_sensitivity_gradient_h
#define snug_sensitivity_gradient_h

#include <snug/sensitivity/gradient_problem.h>

namespace snug
{
  namespace sensitivity
  {
    /// Gradients of several responses at one state and what they cost together.
    struct Gradients
    {
      std::vector<Gradient> of_response;
      unsigned long         f_mults                = 0;
      unsigned long         numeric_factorizations = 0;
      double                seconds                = 0.; ///< wall
    };

    /// "auto", "energy", "adjoint", "direct", "finite differences".
    template <int dim>
    const ChoiceTable<std::vector<Gradient>(const GradientProblem<dim> &,
                                            const Responses<dim> &)> &
    gradient_table();

    /**
     * dJ/dalpha of every response by parameters.method. Finite differences
     * leave the solver at another geometry than the state's: solve again
     * before asking it for more. Collective.
     * @throws SolveError, InputError if a response has no energy gradient.
     */
    template <int dim>
    Gradients
    gradients(const GradientProblem<dim> &problem,
              const Responses<dim>       &responses);
  } // namespace sensitivity
} // namespace snug

#endif
