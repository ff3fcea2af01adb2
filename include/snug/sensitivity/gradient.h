#ifndef snug_sensitivity_gradient_h
#define snug_sensitivity_gradient_h

#include <snug/sensitivity/gradient_problem.h>

namespace snug::sensitivity {
/// A method of differentiation and the reason why it was chosen.
struct MethodChoice
{
  Method      method;
  std::string reason;
};

/// Return the method that "auto" chooses for each of the responses of @p n_variables, for states
/// with or without a potential (StateSolver::has_potential()).
template <int dim>
std::vector<MethodChoice>
cheapest_methods(const Responses<dim> &responses, unsigned int n_variables, bool has_potential);

/**
 * Compute dJ/dalpha of responses of load cases, in their order, by parameters.method. Responses of
 * a load case share one block solve. If parameters.shape_gradient is set, compute dJ/dX too. A
 * method that differentiates only along the variables gives dJ/dX only as the field V (V'V)^-1
 * dJ/dalpha. The solver is at the geometry of the states after. Collective.
 * @throws SolveError, and InputError if a response has no energy gradient.
 */
template <int dim>
Gradients<dim> gradients(const LoadCases<dim> &load_cases, const MeasuredResponses<dim> &responses);
} // namespace snug::sensitivity

#endif
