#ifndef snug_qp_mprgp_h
#define snug_qp_mprgp_h

#include <snug/qp/kkt.h>

namespace snug::qp {
/**
 * Modified proportioning with reduced gradient projections for the inner
 * problem of SMALSE-M,
 * @f[ \min_{\lambda_I \ge 0} \tfrac12 x^T A x - x^T (b - q), \quad
 *     A = P F P + \varrho Q, \quad b = P (d - F \lambda_{Im}), \quad
 *     x = \lambda - \lambda_{Im}, @f]
 * where Q = I - P and q = G_b' mu carries the multipliers of
 * G_b x = 0, G_b = (G G')^{-1/2} G, as a dual vector in the range of Q.
 * Conjugate gradients on the free rows, preconditioned in the face by
 * @f$P M_F^{-1} P + Q / \varrho@f$; an infeasible step is projected
 * (projCG expansion), and the set of free rows grows by proportioning.
 *
 * Source: Dostál, Schöberl, Minimizing quadratic functions subject to
 * bound constraints, Comput. Optim. Appl. 30 (2005); projCG: PERMON.
 */
class Mprgp
{
public:
  /// rho: penalty; norm: of P F P. Both in units of F.
  struct Sizes
  {
    double norm = 0.;
    double rho  = 0.;
  };

  /// When an inner solve ends.
  struct Stop
  {
    double        gradient_factor = 0.; ///< ||g^P|| <= this ||G_b x||, and
    double        gradient_cap    = 0.; ///< ||g^P|| <= this; or
    double        gradient_floor  = 0.; ///< ||g^P|| <= this alone
    unsigned long f_mults         = 0;  ///< counter of the context not to pass
  };

  /**
   * @p lambda >= 0 on bounded rows is the start. @p equality must outlive
   * this object. Costs one F-mult unless lambda = lambda_Im.
   */
  Mprgp(const DualProblem  &problem,
        const EqualityPart &equality,
        const Sizes        &sizes,
        const MultiVector  &lambda);

  /// Collective.
  void minimize(const Stop &stop);

  /// q <- q + rho Q x: the multiplier step; no F-mult.
  void update_multipliers();

  /// Go on with another rho; no F-mult.
  void set_penalty(double rho);

  /// Set q, a vector in the range of Q.
  void set_multipliers(const MultiVector &q);

  /// q + rho Q x, with which the gradient is g = q + rho Q x - P r.
  MultiVector multipliers() const;

  /// ||Q x|| = ||G_b x||. Collective.
  double infeasibility() const { return norms(Qx, comm)[0]; }

  /// The augmented Lagrangian at the iterate, without constants.
  double value() const;

  /// FreeSet of the free rows: equality rows and lambda_i > 0.
  const FreeSet &free_set() const { return *free_face; }

  const RowSet &free_rows() const { return free; }

  /// lambda_Im + P x: feasible in G, not quite in the bounds.
  MultiVector feasible_lambda() const;

  /// d - F feasible_lambda().
  const MultiVector &residual() const { return r; }

private:
  struct Gradient
  {
    MultiVector phi, beta; ///< free and chopped
    double      phi_reduced = 0., beta_beta = 0., norm = 0.;
  };

  /// A p, and what belongs to it.
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
