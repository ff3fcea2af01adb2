#ifndef snug_qp_pcpg_h
#define snug_qp_pcpg_h

#include <snug/qp/dual_problem.h>

namespace snug
{
  namespace qp
  {
    struct PcpgResult
    {
      unsigned int        iterations = 0;
      std::vector<double> residual_norms; ///< ||P_M (d_j - F lambda_j)||
      bool                converged = false;
    };

    /**
     * Block preconditioned conjugate projected gradients with full
     * reorthogonalisation for the linear problems on a face,
     * @f[ P_M (d_j - F \lambda_j) = 0, \qquad j = 1, \dots, k. @f]
     * All k columns share each application of F and of the preconditioner;
     * converged or linearly dependent directions drop out of the block.
     *
     * @param[in,out] lambda feasible start, then solution (n_owned x k).
     * @param[in,out] residual d - F lambda for start and solution.
     * @param[in] tolerances absolute, one per column.
     * Collective. Costs one F-mult per column and iteration.
     */
    PcpgResult
    pcpg(const DualProblem         &problem,
         const Face                &face,
         MultiVector               &lambda,
         MultiVector               &residual,
         const std::vector<double> &tolerances,
         unsigned int               max_iterations);
  } // namespace qp
} // namespace snug

#endif
