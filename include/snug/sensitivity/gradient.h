#ifndef snug_sensitivity_gradient_h
#define snug_sensitivity_gradient_h

#include <snug/sensitivity/gradient_problem.h>

namespace snug::sensitivity {
/// A method and why it was chosen.
struct MethodChoice
{
  Method      method;
  std::string reason;
};

/// What "auto" takes for each of the responses of @p n_variables.
template <int dim>
std::vector<MethodChoice> cheapest_methods(const Responses<dim> &responses,
                                           unsigned int          n_variables);

/**
 * dJ/dalpha of every response by parameters.method; dJ/dX if
 * parameters.shape_gradient, by methods that differentiate along the
 * variables only as the field V (V'V)^-1 dJ/dalpha. Finite differences
 * leave the solver at another geometry than the state's: solve again
 * before asking it for more. Collective.
 * @throws SolveError, InputError if a response has no energy gradient.
 */
template <int dim>
Gradients<dim> gradients(const GradientProblem<dim> &problem, const Responses<dim> &responses);
} // namespace snug::sensitivity

#endif
