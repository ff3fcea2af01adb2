#ifndef snug_sensitivity_direct_h
#define snug_sensitivity_direct_h

#include <snug/sensitivity/data_derivatives.h>

namespace snug
{
  namespace sensitivity
  {
    /// u' and lambda' of k directions, one column each.
    struct StateDerivatives
    {
      feti::PrimalVectors u;      ///< per subdomain
      qp::MultiVector     lambda; ///< owned rows
      unsigned long       f_mults = 0;
      unsigned int        sweeps  = 0; ///< block iterations
    };

    /**
     * The paper's semi-analytic direct method for all k directions at once:
     * on the strongly active set the derivative is the linear problem
     * @f[ \min \tfrac12 z^T K z - \tilde f^T z \quad\text{s.t.}\quad
     *     B_E z = 0,\ B_s z = \tilde c_s, @f]
     * and its dual, min 1/2 mu'F mu - mu'(B K^+ ft - ct), G mu = R' ft, is
     * solved by block PCPG with the factorizations of the state: no new one.
     *
     * Collective. @throws SolveError if contacts are weakly active, where
     * u' is not linear in the direction, or the solve stagnates.
     */
    template <int dim>
    StateDerivatives
    direct(const state::StateSolver<dim>                          &solver,
           const state::ContactState<dim>                         &state,
           const std::vector<typename mesh::BodyMesh<dim>::Field> &velocities,
           const GradientParameters                               &parameters);
  } // namespace sensitivity
} // namespace snug

#endif
