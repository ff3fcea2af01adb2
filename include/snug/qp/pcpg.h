#ifndef snug_qp_pcpg_h
#define snug_qp_pcpg_h

#include <snug/qp/direction_basis.h>

namespace snug::qp {
struct PcpgResult
{
  unsigned int        iterations = 0;
  std::vector<double> residual_norms; ///< ||P_M (d_j - F lambda_j)||
  /// Every column is within its tolerance or zero up to rounding; false
  /// if the iterations ran out or the residual no longer falls.
  bool converged = false;
  /// It is not, but the residual is rounding and falls no more; counts as converged.
  bool at_rounding = false;
};

/**
 * Block preconditioned conjugate projected gradients with full
 * reorthogonalisation for the linear problems on a face,
 * @f[ P_M (d_j - F \lambda_j) = 0, \qquad j = 1, \dots, k. @f]
 * Each iteration adds a block of directions
 * @f$P_M M^{-1}_M P_M r_j@f$, made F-orthonormal to all earlier ones, and
 * minimizes all k columns over it. Only columns whose residuals, measured
 * by their tolerances, stand out from the span of the others' give
 * directions, and linearly dependent ones are dropped before F is applied:
 * similar columns cost little more than one of them does.
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
  /// lie in the face. Whether it uses the directions C that are known for
  /// every face, whose rounding bounds the accuracy.
  Pcpg(const DualProblem &problem,
       const FreeSet     &free_set,
       DirectionBasis     known    = DirectionBasis(),
       bool               deflates = true);

  /**
   * @param[in,out] lambda feasible start, then solution (n_owned x k).
   * @param[in,out] residual d - F lambda for start and solution, updated
   *   by recurrence.
   * @param[in] tolerances absolute, one per column.
   * Collective. Costs one F-mult per direction; with k = 1 and no earlier
   * directions at most max_iterations.
   */
  PcpgResult solve(MultiVector               &lambda,
                   MultiVector               &residual,
                   const std::vector<double> &tolerances,
                   unsigned int               max_iterations);

  /// All directions so far.
  const DirectionBasis &directions() const { return basis; }

private:
  /// Minimize over directions already there.
  void correct(MultiVector &lambda, MultiVector &residual) const;

  /// x <- (I - P (F P)' / unit) x; squares of the F-norms of what was
  /// removed.
  std::vector<double> orthogonalise(MultiVector &x) const;

  /// New directions from the projected residuals @p r, and what the last
  /// orthogonalisation removed from them.
  MultiVector new_directions(const MultiVector &r, std::vector<double> &removed) const;

  /// Append an F-orthonormal basis of @p Z and minimize over it; false
  /// if F vanishes on Z up to rounding.
  bool step(const MultiVector         &Z,
            const std::vector<double> &removed,
            MultiVector               &lambda,
            MultiVector               &residual);

  const DualProblem &problem;
  const FreeSet     &free_set;
  bool               deflates;
  MPI_Comm           comm;
  DirectionBasis     basis;
  double             largest_rayleigh_quotient = 0.;
};

/// Pcpg with an empty basis; the directions are forgotten. Collective.
PcpgResult pcpg(const DualProblem         &problem,
                const FreeSet             &free_set,
                MultiVector               &lambda,
                MultiVector               &residual,
                const std::vector<double> &tolerances,
                unsigned int               max_iterations);
} // namespace snug::qp

#endif
