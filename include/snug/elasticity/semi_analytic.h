#ifndef snug_elasticity_semi_analytic_h
#define snug_elasticity_semi_analytic_h

#include <snug/elasticity/element.h>
#include <snug/elasticity/finite_difference.h>

namespace snug::elasticity {
/**
 * Derivatives of element quantities along node velocities V by finite differences. They serve
 * elements without exact derivatives, and show the cost saved by exact derivatives.
 *
 * The step moves nodes, relative to each other, by at most @p step of the element's size.
 * Translations that change nothing are subtracted from V first.
 *
 * The product K' u vanishes on rigid motions u, but the product of a difference of K with u does
 * not vanish on the rigid motions of the displaced element. In slender bodies u is nearly rigid
 * in each element, so the error grows as (L/H)^2 (Barthelemy, Haftka, Struct. Optim. 2, 1990).
 * The refined difference takes the rigid part R c of u exactly, from (K R)' = 0:
 * @f[ K'u = \frac{\Delta K}{h} (u - R c) - K R' c,\qquad
 *     c = (R^T R)^{-1} R^T u @f]
 * (van Keulen, de Boer, Int. J. Numer. Meth. Engng 42, 1998; exact numerical differentiation of
 * Olhoff, Rasmussen, Lund, Mech. Struct. Mach. 21, 1993).
 */
template <int dim>
class SemiAnalytic
{
public:
  using Nodes = std::vector<dealii::Tensor<1, dim>>;

  SemiAnalytic(const Stencil            &stencil,
               bool                      refined,
               double                    step,
               const mesh::Idealization &idealization);

  /// Compute r = K'(X; V) u.
  void internal_force_derivative(const Element<dim> &element,
                                 const Nodes        &X,
                                 const Nodes        &V,
                                 const Material     &material,
                                 const Nodes        &u,
                                 Nodes              &r) const;

  /// Return f'(X; V) of a load f.
  Nodes load_derivative(const NodeFunction<dim> &f, const Nodes &X, const Nodes &V) const;

private:
  Stencil            stencil;
  bool               refined;
  double             step;
  mesh::Idealization idealization;
};
} // namespace snug::elasticity

#endif
