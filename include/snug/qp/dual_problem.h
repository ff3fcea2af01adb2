#ifndef snug_qp_dual_problem_h
#define snug_qp_dual_problem_h

#include <snug/base/run_context.h>
#include <snug/qp/free_rows.h>

#include <memory>
#include <string>

namespace snug::qp {
/**
 * This class is the face of the feasible set on which the multipliers of the rows of a set M may
 * change and all other multipliers are zero. It provides the projector and the preconditioner of
 * the face,
 * @f[ P_M = I_M - G_M^T (G_M G_M^T)^+ G_M, \qquad
 *     M^{-1}_M = B_{D,M} S B_{D,M}^T, \quad
 *     B_{D,M} = (B_M D^{-1} B_M^T)^{-1} B_M D^{-1}. @f]
 * @f$G_M@f$ are the columns of G in M. Factorizations are computed at their first use. All members
 * are collective. All multi-vectors have n_owned rows.
 *
 * Where contacts slip, FreeRows has two maps: equations are those of @f$Z_0@f$ and multipliers
 * those of Z. G_M is then @f$G Z_0@f$ for equations and @f$G Z@f$ for multipliers, exchanged in the
 * transposed system.
 */
class FreeSet
{
public:
  virtual ~FreeSet() = default;

  virtual const FreeRows &free_rows() const = 0;

  /// Return whether contacts of any rank slip, so that the linear problem is not symmetric.
  virtual bool has_slips() const = 0;

  /// Set x <- P_M x, which is zero outside M, with the G_M of the equations.
  virtual void project(MultiVector &x) const = 0;

  /// Set y <- P_M y with the G_M of the multipliers, so that G lambda does not change along y.
  virtual void project_multipliers(MultiVector &y) const { project(y); }

  /**
   * Set x <- x - C (C'FC)^{-1} C'F x, which is F-orthogonal to the directions C. The directions C
   * are the same for every face. By default there are none, and x does not change.
   * @return the square of the F-norm of the removed part, for each column.
   */
  virtual std::vector<double> deflate(MultiVector &x) const
  {
    return std::vector<double>(x.n_columns(), 0.);
  }

  /// Minimize over the span of C: lambda += C (C'FC)^{-1} C'r, and update r = d - F lambda.
  virtual void minimize_over_deflated(MultiVector &, MultiVector &) const {}

  /// Return z = M^{-1}_M r, which is zero outside M and not projected. Add r.n_columns() to the
  /// count of applications of the preconditioner. It is that of Z_0 where contacts slip.
  virtual MultiVector precondition(const MultiVector &r) const = 0;

  /// Return the rigid amplitudes (G_M G_M')^+ G_M x (n_kernel x k) of equations, on all ranks.
  virtual MultiVector amplitudes(const MultiVector &x) const = 0;

  /**
   * Set x to zero outside M, then x <- x + G_M' (G_M G_M')^+ (e - G_M x). Where contacts slip, x is
   * Z y for the values y of x, and G_M is that of the multipliers.
   * @return the remaining norm ||G x - e|| of each column. It is not small if M cannot hold the
   * load e (n_kernel x k, on all ranks).
   */
  virtual std::vector<double> make_feasible(MultiVector &x, const MultiVector &e) const = 0;

  /// Return an orthonormal basis V of the motions G_M' V = 0 that no equation resists (n_kernel x
  /// their number, equal on all ranks). G'v are the rates at which contacts close, if positive.
  virtual const MultiVector &unresisted_motions() const = 0;
};

/**
 * This class is the interface to the dual problem of Total FETI,
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
 * The n rows are distributed over ranks. Vectors of size n_kernel are equal on all ranks.
 */
class DualProblem
{
public:
  virtual ~DualProblem() = default;

  virtual RunContext &context() const = 0;

  /// Return the number of dual rows on this rank.
  virtual unsigned int n_owned() const = 0;

  /// Return the flags of the rows with lambda_i >= 0 (contact).
  virtual const RowSet &bounded() const = 0;

  /// Return the contacts with friction; by default there are none. With friction, the problem is
  /// no quadratic program but the conditions of DualSolution.
  virtual const FrictionCones &cones() const
  {
    static const FrictionCones none;
    return none;
  }

  /// Return d, one column.
  virtual const MultiVector &d() const = 0;

  /// Return e, one column with n_kernel rows, equal on all ranks.
  virtual const MultiVector &e() const = 0;

  /// Return positive estimates of F_ii in its units [displacement / force]. They may be much lower
  /// than F_ii.
  virtual const std::vector<double> &diagonal() const = 0;

  /// Return F x. Collective. Counts x.n_columns F-mults.
  virtual MultiVector apply(const MultiVector &x) const = 0;

  /// Return G x (n_kernel x k), equal on all ranks. Collective.
  virtual MultiVector apply_G(const MultiVector &x) const = 0;

  /// Return G' alpha.
  virtual MultiVector apply_Gt(const MultiVector &alpha) const = 0;

  /// Return max_s || |R_s|' |f_s| || + ||G|| @p force, the scale of ||G lambda - e||. It takes
  /// loads before they cancel. @p force is the norm of lambda. Collective.
  virtual double feasibility_scale(double force) const = 0;

  virtual std::unique_ptr<FreeSet> free_set(const FreeRows &free) const = 0;

  /// Return the name of the body that moves most in the motion @p v (n_kernel x 1), with its
  /// motion, for messages.
  virtual std::string describe_motion(const MultiVector &) const { return "a body moves"; }

  /// Return a guess of the rows that carry a force: all equality rows and the expected contacts,
  /// with their tangential rows.
  /// Residuals are scaled with these rows, and active sets begin with them.
  virtual RowSet initial_active_set() const { return RowSet(n_owned(), 1); }
};
} // namespace snug::qp

#endif
