#ifndef snug_sensitivity_combined_gradients_h
#define snug_sensitivity_combined_gradients_h

#include <snug/sensitivity/gradient.h>
#include <snug/sensitivity/one_sided.h>

namespace snug::sensitivity {
/// Return sum_c factors_c gradients_c of gradients from @p first on.
template <int dim>
Gradient<dim> weighted_sum(const std::vector<double>        &factors,
                           const std::vector<Gradient<dim>> &gradients,
                           std::size_t                       first);

/**
 * Return the gradient of a combined objective J(J_1, .., J_n), where J_c is the
 * value of @p objective in load case c,
 * @f[ J' = \sum_c \frac{\partial J}{\partial J_c} J_c'. @f]
 * The gradients of the responses @p others follow, each in its own load case. @p
 * factors are dJ/dJ_c. The displacement derivatives of the load cases follow one
 * another. Collective.
 * @throws the same errors as gradients().
 */
template <int dim>
Gradients<dim> combined_gradients(const LoadCases<dim>          &load_cases,
                                  const response::Response<dim> &objective,
                                  const std::vector<double>     &factors,
                                  const MeasuredResponses<dim>  &others);

/// Return the one-sided derivatives of the same J. Collective. @throws SolveError.
template <int dim>
OneSided combined_one_sided_gradients(const LoadCases<dim>          &load_cases,
                                      const response::Response<dim> &objective,
                                      const std::vector<double>     &factors);
} // namespace snug::sensitivity

#endif
