#ifndef snug_qp_projected_gcr_h
#define snug_qp_projected_gcr_h

#include <snug/qp/direction_basis.h>
#include <snug/qp/krylov_columns.h>

namespace snug::qp {
/**
 * Block preconditioned generalized conjugate residuals, with full orthogonalization, for the linear
 * problems of FreeRows with slipping contacts, whose operator is not symmetric:
 * @f[ P_l (Z_0^T F Z + D) y_j = P_l Z_0^T d_j, \qquad
 *     G Z y_j = e_j, \qquad j = 1, \dots, k. @f]
 * P_l = FreeSet::project() belongs to the equations and P_r = FreeSet::project_multipliers() to the
 * multipliers. Each iteration adds the directions z = P_r M^-1 r with the images q = P_l (Z_0'F Z +
 * D) z, makes the q orthonormal to all earlier ones, and minimizes the Euclidean norms of the
 * projected residuals over them. The directions are kept, so that solving again continues the
 * iteration.
 *
 * Source: Eisenstat, Elman, Schultz, Variational iterative methods for nonsymmetric systems of
 * linear equations, SIAM J. Numer. Anal. 20 (1983).
 */
class ProjectedGcr
{
public:
  /// Store the references; problem and face must outlive this object. The directions @p known may
  /// be those of other faces. If @p deflates, the method uses the directions C that are known for
  /// every face. Collective.
  ProjectedGcr(const DualProblem    &problem,
               const FreeSet        &free_set,
               const DirectionBasis &known    = DirectionBasis(),
               bool                  deflates = true);

  /**
   * Solve on the free rows. Costs one F-mult per direction. Collective.
   * @param[in,out] lambda start with G lambda = e, then solution (n_owned x k).
   * @param[in,out] residual d - F lambda for start and solution on all rows, updated by recurrence.
   * @param[in] tolerances absolute, one per column.
   */
  KrylovResult solve(MultiVector               &lambda,
                     MultiVector               &residual,
                     const std::vector<double> &tolerances,
                     unsigned int               max_iterations);

  /// Return all directions so far, with the known ones. No more can be solved afterwards.
  DirectionBasis release_directions();

private:
  void        recall();
  MultiVector preconditioned(const MultiVector &r) const;
  bool        add_directions(const MultiVector &r);
  MultiVector projected_residual(const MultiVector &lambda, const MultiVector &residual) const;
  void        minimize(unsigned int       first,
                       const MultiVector &r,
                       MultiVector       &lambda,
                       MultiVector       &residual) const;

  const DualProblem &problem;
  const FreeSet     &free_set;
  bool               deflates;
  MPI_Comm           comm;
  DirectionBasis     known;
  MultiVector        recalled{0, 0}, recalled_images{0, 0}; ///< y, A y approximately, orthonormal
  MultiVector        directions{0, 0}, images{0, 0};        ///< Z z, F Z z
  MultiVector        projected{0, 0};                       ///< q, orthonormal
};
} // namespace snug::qp

#endif
