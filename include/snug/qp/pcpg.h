#ifndef snug_qp_pcpg_h
#define snug_qp_pcpg_h

#include <snug/qp/direction_basis.h>
#include <snug/qp/krylov_columns.h>

namespace snug::qp {
/**
 * Block preconditioned conjugate projected gradients with full reorthogonalization for the linear
 * problems on a face,
 * @f[ P_M (d_j - F \lambda_j) = 0, \qquad j = 1, \dots, k. @f]
 * Each iteration adds a block of directions @f$P_M M^{-1}_M P_M r_j@f$, made F-orthonormal to all
 * earlier directions, and minimizes all k columns over it. A column gives a direction only if its
 * residual, relative to its tolerance, is far enough from the span of the other residuals. Linearly
 * dependent directions are dropped before F is applied. Similar columns therefore cost little more
 * than one of them does.
 *
 * The directions are kept: solving again on the same face, with tighter tolerances or corrected
 * residuals, continues the iteration. Directions that vanish on the rows that leave the face are
 * directions on the next face too, and cost nothing there.
 *
 * Source: O'Leary, The block conjugate gradient algorithm, Linear Algebra Appl. 29 (1980); Farhat,
 * Roux, An unconventional domain decomposition method, SIAM J. Sci. Stat. Comput. 13 (1992).
 */
class Pcpg
{
public:
  /// Store the references; problem and face must outlive this object. The @p known directions must
  /// lie in the face. If @p deflates, the method uses the directions C that are known for every
  /// face, whose rounding errors bound the accuracy.
  Pcpg(const DualProblem &problem,
       const FreeSet     &free_set,
       DirectionBasis     known    = DirectionBasis(),
       bool               deflates = true);

  /**
   * Solve on the face. Costs one F-mult per direction; with k = 1 and no earlier directions at most
   * max_iterations. Collective.
   * @param[in,out] lambda feasible start, then solution (n_owned x k).
   * @param[in,out] residual d - F lambda for start and solution, updated by recurrence.
   * @param[in] tolerances absolute, one per column.
   */
  KrylovResult solve(MultiVector               &lambda,
                     MultiVector               &residual,
                     const std::vector<double> &tolerances,
                     unsigned int               max_iterations);

  /// Return all directions so far.
  const DirectionBasis &directions() const { return basis; }
  DirectionBasis        release_directions() { return std::move(basis); }

private:
  /// Minimize over the directions that are already known.
  void correct(MultiVector &lambda, MultiVector &residual) const;

  /// Set x <- (I - P (F P)' / unit) x. Return the squares of the F-norms of the removed parts.
  std::vector<double> orthogonalise(MultiVector &x) const;

  /// Return directions from the projected residuals @p r. @p removed receives the squares of the
  /// F-norms that the last orthogonalization removed from the directions.
  MultiVector new_directions(const MultiVector &r, std::vector<double> &removed) const;

  /// Append an F-orthonormal basis of @p Z and minimize over it. Return false if F vanishes on Z up
  /// to rounding.
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

/// Solve by Pcpg with an empty basis and forget the directions. Collective.
KrylovResult pcpg(const DualProblem         &problem,
                  const FreeSet             &free_set,
                  MultiVector               &lambda,
                  MultiVector               &residual,
                  const std::vector<double> &tolerances,
                  unsigned int               max_iterations);
} // namespace snug::qp

#endif
