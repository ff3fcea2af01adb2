#ifndef snug_qp_mprgp_h
#define snug_qp_mprgp_h

#include <snug/qp/kkt.h>

namespace snug::qp {
/**
 * Modified proportioning with reduced gradient projections for the inner problem of SMALSE-M,
 * @f[ \min_{\lambda_I \ge 0} \tfrac12 x^T A x - x^T (b - q), \quad
 *     A = P F P + \varrho Q, \quad b = P (d - F \lambda_{Im}), \quad
 *     x = \lambda - \lambda_{Im}, @f]
 * where Q = I - P and q = G_b' mu holds the multipliers of G_b x = 0, G_b = (G G')^{-1/2} G, as a
 * dual vector in the range of Q. The method is conjugate gradients on the free rows, preconditioned
 * in the face by @f$P M_F^{-1} P + Q / \varrho@f$. An infeasible step is projected (projCG
 * expansion), and the set of free rows grows by proportioning.
 *
 * Source: Dostál, Schöberl, Minimizing quadratic functions subject to bound constraints, Comput.
 * Optim. Appl. 30 (2005); projCG: PERMON.
 */
class Mprgp
{
public:
  /// The norm of P F P and the penalty rho, both in units of F.
  struct Sizes
  {
    double norm = 0.;
    double rho  = 0.;
  };

  /// Stopping criterion of an inner solve. The solve ends if ||g^P|| <= max(min(gradient_factor
  /// ||G_b x||, gradient_cap), gradient_floor), or at f_mults.
  struct Stop
  {
    double        gradient_factor = 0.; ///< factor of ||G_b x||
    double        gradient_cap    = 0.; ///< maximum of the tolerance of ||g^P||
    double        gradient_floor  = 0.; ///< minimum of the tolerance of ||g^P||
    unsigned long f_mults         = 0;  ///< limit of the context's counter
  };

  /**
   * Start from @p lambda, which is >= 0 on bounded rows. @p equality must outlive this object.
   * Costs one F-mult unless lambda = lambda_Im.
   */
  Mprgp(const DualProblem  &problem,
        const EqualityPart &equality,
        const Sizes        &sizes,
        const MultiVector  &lambda);

  /// Solve the inner problem until @p stop holds or no decrease is left. Collective.
  void minimize(const Stop &stop);

  /// Update the multipliers, q <- q + rho Q x; no F-mult.
  void update_multipliers();

  /// Continue with another rho; no F-mult.
  void set_penalty(double rho);

  /// Set q, a vector in the range of Q.
  void set_multipliers(const MultiVector &q);

  /// Return q + rho Q x. The gradient is g = q + rho Q x - P r.
  MultiVector multipliers() const;

  /// Return ||Q x|| = ||G_b x||. Collective.
  double infeasibility() const { return norms(Qx, comm)[0]; }

  /// Return the augmented Lagrangian at the iterate, without constants. Collective.
  double value() const;

  /// Return the face of the free rows: equality rows and rows with lambda_i > 0.
  const FreeSet &free_set() const { return *free_face; }

  const RowSet &free_rows() const { return free; }

  /// Return lambda_Im + P x, which satisfies G lambda = e but may violate the bounds slightly.
  MultiVector feasible_lambda() const;

  /// Return d - F feasible_lambda().
  const MultiVector &residual() const { return r; }

private:
  struct Gradient
  {
    MultiVector phi, beta; ///< free and chopped gradient
    double      phi_reduced = 0., beta_beta = 0., norm = 0.;
  };

  /// A p, its parts and its inner products.
  struct Image
  {
    MultiVector FPp, Qp, Ap;
    double      p_Ap = 0., p_g = 0.;
  };

  Gradient    projected_gradient() const;
  Image       apply(const MultiVector &p) const;
  MultiVector precondition(const MultiVector &phi) const;
  double      largest_feasible_step(const MultiVector &p) const;
  void        step(double a, const MultiVector &p, const Image &image);
  bool        conjugate_step(const Gradient &gradient);
  void        expand(double a, double a_feasible);
  void        proportion(const Gradient &gradient);
  void        recompute();
  void        renew_face();
  double      dot(const MultiVector &x, const MultiVector &y) const
  {
    return inner_products(x, y, comm)(0);
  }

  const DualProblem       &problem;
  const EqualityPart      &equality;
  Sizes                    sizes;
  const MPI_Comm           comm;
  MultiVector              lambda, r, Qx, q, g, direction;
  RowSet                   free;
  std::unique_ptr<FreeSet> free_face;
};
} // namespace snug::qp

#endif
