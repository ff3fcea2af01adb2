#ifndef snug_qp_kkt_h
#define snug_qp_kkt_h

#include <snug/qp/solver.h>

#include <limits>

namespace snug::qp {
/// A projection takes the difference of vectors of the size of what it is given: a
/// result below this part of it is rounding. 30 epsilon were met with six rigid
/// motions and some kernels of BLAS.
constexpr double projection_rounding = 64. * std::numeric_limits<double>::epsilon();

/// A residual that falls no more below this part of d - F lambda, of which it is the difference to
/// a rigid motion, may be the rounding of both.
constexpr double residual_rounding = 16. * projection_rounding;

/// The optimality conditions at a point; see kkt_residual().
struct KktResidual
{
  MultiVector w;                ///< d - F lambda + G' alpha, n_owned x 1
  MultiVector amplitudes;       ///< alpha, n_kernel x 1, on all ranks
  double      rounding    = 0.; ///< of w
  double      relative    = 0.; ///< the natural residual of DualSolution
  double      feasibility = 0.; ///< its part of G lambda = e
};

/// What ||G lambda - e|| is compared with, the last denominator below. Forces that move no row by
/// as much as @p scale count as zero: their rounding is no imbalance. Collective.
double load_scale(const DualProblem &problem, const MultiVector &lambda, double scale);

/**
 * The natural KKT residual of the dual problem,
 * @f[ r_E = w_E, \quad r_i = -\min(\lambda_i F_{ii}, -w_i), \quad
 *     \frac{\|r\|}{s} + \frac{\|G\lambda - e\|}
 *     {\|e\| + \max_s \||R_s|^T |f_s|\| + \|G\| (\|\lambda\| + s / \max F_{ii})}, \qquad
 *     w = d - F\lambda + G^T\alpha, @f]
 * with an alpha of the caller's choice: any that makes this zero proves
 * the solution. An @f$\|r\|@f$ below the rounding error of
 * @f$d - F\lambda@f$ is zero.
 *
 * @param[in] rigid -alpha: FreeSet::amplitudes() of d - F lambda, as a rule
 *   on the rows with a force, all equality rows and the active contacts.
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
 * What forces of the owned rows may be by rounding alone: a part of the
 * largest force, and what moves the row by as much of @p scale or by the
 * rounding of w. The part is 1e-12, less for tolerances below 1e-9.
 * Collective.
 */
std::vector<double> force_rounding(const DualProblem &problem,
                                   const MultiVector &lambda,
                                   const KktResidual &kkt,
                                   double             scale,
                                   double             tolerance);

/**
 * The face of @p rows, which grow where they cannot balance the loads: by contacts that close in
 * the motion that is left.
 *
 * @param[in,out] lambda made feasible on the face.
 * @param[in] scale of residuals; zero if it is not known yet.
 * @throws SolveError if no rows can. Collective.
 */
std::unique_ptr<FreeSet>
balanced_set(const DualProblem &problem, RowSet &rows, MultiVector &lambda, double scale);

/**
 * What every solve starts from: the least squares solution
 * @f$\lambda_{Im} = G^T (G G^T)^+ e@f$ of G lambda = e on a face, and the scale
 * @f$s = \|P (d - F \lambda_{Im})\|@f$ of the residuals, which depends
 * neither on the start nor on the choice of K^+. Where that is as small as
 * rounding, s is a size that a tolerance can be a part of.
 */
struct EqualityPart
{
  RowSet                   rows;     ///< free ones
  std::unique_ptr<FreeSet> free_set; ///< of them
  MultiVector              lambda;   ///< lambda_Im
  MultiVector              residual; ///< d - F lambda_Im
  double                   scale = 0.;
};

/**
 * Compute the equality part and, in the same application of F, F x.
 *
 * @param[in] rows free ones; they grow until they balance the loads.
 * @param[in,out] x a start, replaced by d - F x; no columns if there is
 *   none besides lambda_Im.
 * @throws SolveError if the data are not finite. Collective,
 *   1 + x.n_columns F-mults.
 */
EqualityPart equality_part(const DualProblem &problem, const RowSet &rows, MultiVector &x);

/// The error of a solver that gives up: what was reached, what to try. Without @p out_of_f_mults
/// more of them would not help.
SolveError not_converged(const std::string &method,
                         double             reached,
                         double             tolerance,
                         unsigned long      f_mults,
                         bool               out_of_f_mults);
} // namespace snug::qp

#endif
