#ifndef snug_qp_kkt_h
#define snug_qp_kkt_h

#include <snug/qp/solver.h>

#include <limits>

namespace snug::qp {
/// A projection subtracts vectors of the size of its argument, so a result below this part of the
/// argument is rounding error. Measured with six rigid motions and some kernels of BLAS: 30
/// epsilon.
constexpr double projection_rounding = 64. * std::numeric_limits<double>::epsilon();

/// The projected residual is the difference of d - F lambda and a rigid motion. If it stalls below
/// this part of d - F lambda, it may be the rounding error of both.
constexpr double residual_rounding = 16. * projection_rounding;

/// Part of the load that a set may leave unbalanced.
constexpr double balance_tolerance = 1e-8;

/// Residuals of the optimality conditions at a point; see kkt_residual().
struct KktResidual
{
  MultiVector w;                ///< d - F lambda + G' alpha, n_owned x 1
  MultiVector amplitudes;       ///< alpha, n_kernel x 1, on all ranks
  double      rounding    = 0.; ///< rounding error of w
  double      relative    = 0.; ///< natural residual, see DualSolution
  double      feasibility = 0.; ///< part of G lambda = e in the natural residual
};

/// Return the scale of ||G lambda - e||, the last denominator in kkt_residual(). The rounding
/// errors of forces that move no row by as much as @p scale are no imbalance by this measure.
/// Collective.
double load_scale(const DualProblem &problem, const MultiVector &lambda, double scale);

/**
 * Return the natural KKT residual of the dual problem,
 * @f[ r_E = w_E, \quad r_i = -\min(\lambda_i F_{ii}, -w_i), \quad
 *     \frac{\|r\|}{s} + \frac{\|G\lambda - e\|}
 *     {\|e\| + \max_s \||R_s|^T |f_s|\| + \|G\| (\|\lambda\| + s / \max F_{ii})}, \qquad
 *     w = d - F\lambda + G^T\alpha. @f]
 * The caller chooses alpha: any alpha for which the residual is zero proves the solution. An
 * @f$\|r\|@f$ below the rounding error of @f$d - F\lambda@f$ counts as zero.
 *
 * @param[in] rigid -alpha: FreeSet::amplitudes() of d - F lambda, as a rule on the rows with a
 *   force, that is all equality rows and the active contacts.
 * @param[in] residual d - F lambda.
 * @param[in] scale s of EqualityPart.
 * @throws SolveError if the residual is not a finite number.
 * Collective, no F-mult.
 */
KktResidual kkt_residual(const DualProblem &problem,
                         const MultiVector &rigid,
                         const MultiVector &lambda,
                         const MultiVector &residual,
                         double             scale);

/**
 * Return an estimate of the error of @p residual = d - F lambda after @p steps of a Krylov method,
 * each of which adds rounding errors of about eps (|F lambda| + |d|). If it could hide a tenth of
 * the tolerance, the residual must be computed anew. Collective.
 */
double
recurrence_error(const DualProblem &problem, const MultiVector &residual, unsigned int steps);

/**
 * Return, for each owned row, the force that may be rounding error alone. It is the maximum of a
 * part of the largest force and the force that moves the row by this part of @p scale or by the
 * rounding error of w. The part is 1e-12, less for tolerances below 1e-9. Collective.
 */
std::vector<double> force_rounding(const DualProblem &problem,
                                   const MultiVector &lambda,
                                   const KktResidual &kkt,
                                   double             scale,
                                   double             tolerance);

/**
 * Data from which every solve starts: the least squares solution
 * @f$\lambda_{Im} = G^T (G G^T)^+ e@f$ of G lambda = e on a face, and the scale
 * @f$s = \|P (d - F \lambda_{Im})\|@f$ of the residuals. s depends neither on the start nor on the
 * choice of K^+. Where this norm is as small as rounding, s is a larger size to which a tolerance
 * can be relative.
 */
struct EqualityPart
{
  std::unique_ptr<FreeSet> free_set; ///< face of the given rows and those added
  MultiVector              lambda;   ///< lambda_Im
  MultiVector              residual; ///< d - F lambda_Im
  double                   scale = 0.;
};

/**
 * Compute the equality part and, in the same application of F, F x.
 *
 * @param[in] rows free rows; rows are added until they balance the loads.
 * @param[in,out] x a start, replaced by d - F x; it has no columns if lambda_Im is the only start.
 * @throws SolveError if the data are not finite. Collective, 1 + x.n_columns F-mults.
 */
EqualityPart equality_part(const DualProblem &problem, const RowSet &rows, MultiVector &x);

/// Return the error of a solver that gives up, with the residual that it reached and advice. If
/// @p out_of_f_mults is false, more F-mults would not help.
SolveError not_converged(const std::string &method,
                         double             reached,
                         double             tolerance,
                         unsigned long      f_mults,
                         bool               out_of_f_mults);
} // namespace snug::qp

#endif
