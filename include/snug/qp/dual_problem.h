#ifndef snug_qp_dual_problem_h
#define snug_qp_dual_problem_h

#include <snug/base/run_context.h>
#include <snug/qp/multi_vector.h>

#include <memory>
#include <vector>

namespace snug::qp {
/// One flag per row of the dual problem owned by this rank.
using RowSet = std::vector<unsigned char>;

/**
 * The face of the feasible set on which only the rows of a set M are free
 * and the others are zero, with the projector and the preconditioner that
 * belong to it:
 * @f[ P_M = I_M - G_M^T (G_M G_M^T)^+ G_M, \qquad
 *     M^{-1}_M = B_{D,M} S B_{D,M}^T, \quad
 *     B_{D,M} = (B_M D^{-1} B_M^T)^{-1} B_M D^{-1}. @f]
 * @f$G_M@f$ are the columns of G in M. Parts are built when first used.
 * All members are collective; all multi-vectors have n_owned rows.
 */
class FreeSet
{
public:
  virtual ~FreeSet() = default;

  /// The set M.
  virtual const RowSet &rows() const = 0;

  /// x <- P_M x (zero off M).
  virtual void project(MultiVector &x) const = 0;

  /**
   * x <- x - C (C'FC)^{-1} C'F x, F-orthogonal to directions C that are
   * known for every face; without any x stays.
   * @return the squares of the F-norms of what was removed, one per column.
   */
  virtual std::vector<double> deflate(MultiVector &x) const
  {
    return std::vector<double>(x.n_columns(), 0.);
  }

  /// Minimize over the span of C: lambda += C (C'FC)^{-1} C'r, and
  /// r = d - F lambda with it.
  virtual void minimize_over_deflated(MultiVector &, MultiVector &) const {}

  /// z = M^{-1}_M r (zero off M, not projected). Counts r.n_columns.
  virtual MultiVector precondition(const MultiVector &r) const = 0;

  /// (G_M G_M')^+ G_M x: rigid amplitudes (n_kernel x k), on all ranks.
  virtual MultiVector amplitudes(const MultiVector &x) const = 0;

  /**
   * x <- x + G_M' (G_M G_M')^+ (e - G_M x), after zeroing x off M.
   * @return the norms ||G x - e|| left over, one per column: not small
   *   where M cannot hold the load e (n_kernel x k, on all ranks).
   */
  virtual std::vector<double> make_feasible(MultiVector &x, const MultiVector &e) const = 0;

  /**
   * Rates (G'v)_i at which the contacts close under v, the part of
   * @p e - G_M x that M cannot hold; n_owned entries. Positive closes.
   */
  virtual std::vector<double> gap_closing_rates(const MultiVector &e) const = 0;
};

/**
 * The dual problem of Total FETI,
 * @f[ \min_\lambda \tfrac12 \lambda^T F \lambda - \lambda^T d
 *     \quad\text{s.t.}\quad \lambda_I \ge 0,\ G \lambda = e. @f]
 *
 * | symbol | meaning                                 | size              |
 * |--------|-----------------------------------------|-------------------|
 * | F      | B K^+ B', dual operator                 | n x n             |
 * | d      | B K^+ f - g                             | n                 |
 * | G      | R' B', natural coarse space             | n_kernel x n      |
 * | e      | R' f                                    | n_kernel          |
 *
 * n rows are distributed over ranks; n_kernel vectors are equal on all.
 */
class DualProblem
{
public:
  virtual ~DualProblem() = default;

  virtual RunContext &context() const = 0;

  /// Number of dual rows on this rank.
  virtual unsigned int n_owned() const = 0;

  /// Flag of the rows with lambda_i >= 0 (contact).
  virtual const RowSet &bounded() const = 0;

  /// One column.
  virtual const MultiVector &d() const = 0;

  /// One column, n_kernel rows, equal on all ranks.
  virtual const MultiVector &e() const = 0;

  /// Positive estimates of F_ii in its units [displacement / force].
  virtual const std::vector<double> &diagonal() const = 0;

  /// y = F x. Collective. Counts x.n_columns F-mults.
  virtual MultiVector apply(const MultiVector &x) const = 0;

  /// G x (n_kernel x k), equal on all ranks. Collective.
  virtual MultiVector apply_G(const MultiVector &x) const = 0;

  /// G' alpha.
  virtual MultiVector apply_Gt(const MultiVector &alpha) const = 0;

  /// max_s || |R_s|' |f_s| || + ||G|| @p force, loads before they cancel: the
  /// size ||G lambda - e|| is compared with, force being that of lambda.
  /// Collective.
  virtual double feasibility_scale(double force) const = 0;

  virtual std::unique_ptr<FreeSet> free_set(const RowSet &free) const = 0;

  /// Equality rows and the contacts that are expected to carry, a guess:
  /// residuals are measured and active sets begin with them.
  virtual RowSet expected_rows() const { return RowSet(n_owned(), 1); }
};
} // namespace snug::qp

#endif
