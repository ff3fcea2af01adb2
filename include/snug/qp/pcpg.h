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
      /// Every column is within its tolerance or zero up to rounding; false
      /// if the iterations ran out or the residual no longer falls.
      bool converged = false;
    };

    /// Directions P with P' F P = I, and F P (n_owned x n each).
    struct DirectionBasis
    {
      MultiVector P{0, 0}, FP{0, 0};
    };

    /**
     * Block preconditioned conjugate projected gradients with full
     * reorthogonalisation for the linear problems on a face,
     * @f[ P_M (d_j - F \lambda_j) = 0, \qquad j = 1, \dots, k. @f]
     * Each iteration adds a block of directions
     * @f$P_M M^{-1}_M P_M r_j@f$, one per column that is not converged, made
     * F-orthonormal to all earlier ones, and minimizes all k columns over it.
     * Linearly dependent directions are dropped before F is applied, so a
     * block of equal columns costs what one of them does.
     *
     * The directions are kept: solving again on the same face, with tighter
     * tolerances or corrected residuals, continues the iteration. Those that
     * vanish on rows that leave the face are directions on the new face too,
     * and cost nothing there.
     *
     * Source: O'Leary, The block conjugate gradient algorithm, Linear Algebra
     * Appl. 29 (1980); Farhat, Roux, An unconventional domain decomposition
     * method, SIAM J. Sci. Stat. Comput. 13 (1992).
     */
    class Pcpg
    {
    public:
      /// Problem and face must outlive this object; @p known directions must
      /// lie in the face.
      Pcpg(const DualProblem &problem,
           const Face        &face,
           DirectionBasis     known = DirectionBasis());

      /**
       * @param[in,out] lambda feasible start, then solution (n_owned x k).
       * @param[in,out] residual d - F lambda for start and solution, updated
       *   by recurrence.
       * @param[in] tolerances absolute, one per column.
       * Collective. Costs one F-mult per direction; with k = 1 and no earlier
       * directions at most max_iterations.
       */
      PcpgResult
      solve(MultiVector               &lambda,
            MultiVector               &residual,
            const std::vector<double> &tolerances,
            unsigned int               max_iterations);

      /**
       * An F-orthonormal basis of the directions' span that vanishes on
       * @p rows; without F-mults. Empty if there are as many rows as
       * directions. Collective.
       */
      DirectionBasis
      directions_off(const RowSet &rows) const;

    private:
      /// Minimize over directions already there.
      void
      correct(MultiVector &lambda, MultiVector &residual) const;

      /// x <- (I - P (F P)') x; squares of the F-norms of what was removed.
      std::vector<double>
      orthogonalise(MultiVector &x) const;

      /// New directions from the projected residuals @p r, and what the last
      /// orthogonalisation removed from them.
      MultiVector
      directions(const MultiVector &r, std::vector<double> &removed) const;

      /// Append an F-orthonormal basis of @p Z and minimize over it; false
      /// if F vanishes on Z up to rounding.
      bool
      step(const MultiVector         &Z,
           const std::vector<double> &removed,
           MultiVector               &lambda,
           MultiVector               &residual);

      const DualProblem &problem;
      const Face        &face;
      MPI_Comm           comm;
      DirectionBasis     basis;
      double             largest_rayleigh_quotient = 0.;
    };

    /// Pcpg with an empty basis; the directions are forgotten. Collective.
    PcpgResult
    pcpg(const DualProblem         &problem,
         const Face                &face,
         MultiVector               &lambda,
         MultiVector               &residual,
         const std::vector<double> &tolerances,
         unsigned int               max_iterations);

    /// Orthonormal basis of the null space of @p A (m x n) by Householder
    /// reflections; n x (n - rank).
    MultiVector
    null_space(MultiVector A);

    /**
     * Rank-revealing Cholesky factorization of the symmetric positive
     * semidefinite S (k x k): C (k x rank) with C' S C = I. Pivots (of S
     * scaled to unit diagonal) below @p cut are dropped, and rows whose
     * diagonal entry is not above their entry of @p smallest.
     */
    MultiVector
    orthonormal_combinations(const MultiVector         &S,
                             const std::vector<double> &smallest,
                             double                     cut);
  } // namespace qp
} // namespace snug

#endif
