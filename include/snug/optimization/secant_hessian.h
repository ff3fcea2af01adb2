#ifndef snug_optimization_secant_hessian_h
#define snug_optimization_secant_hessian_h

#include <vector>

namespace snug::optimization {
/**
 * A positive semidefinite approximation B of the Hessian of a Lagrangian, or of the part of it
 * that a prediction does not have, from differences of gradients: damped BFGS, Powell, A fast
 * algorithm for nonlinearly constrained optimization calculations (1978).
 */
class SecantHessian
{
public:
  /// B = 0 for @p n_all variables. B remains zero for the variables behind the first @p
  /// n_nonlinear.
  SecantHessian(unsigned int n_all, unsigned int n_nonlinear)
    : n(n_all), rows(n_nonlinear, std::vector<double>(n_nonlinear, 0.))
  {}

  /// Return whether a difference of gradients was measured since guess().
  bool is_measured() const { return measured; }

  /// B = @p curvature I until a difference is measured.
  void guess(double curvature);

  /// Make d'Bd at least @p product.
  void raise(const std::vector<double> &d, double product);

  /**
   * A step @p s changed the gradient by @p y. The first step after guess() begins with
   * B = |y|/|s| I: between y's/s's and y'y/y's, the curvatures that the step and the change saw.
   * Where a later step saw less curvature than B has along it, all of B is scaled down by that, but
   * at most to 0.6: B began as stiff as the stiffest directions. Source: Al-Baali, Numerical
   * experience with a class of self-scaling quasi-Newton algorithms (1998).
   */
  void update(std::vector<double> s, std::vector<double> y);

  /// B d.
  std::vector<double> times(const std::vector<double> &d) const;

private:
  const unsigned int               n;
  std::vector<std::vector<double>> rows;
  bool                             measured = false;

  /// Return the entries of nonlinear variables.
  std::vector<double> nonlinear(const std::vector<double> &v) const;
  void                add(double factor, const std::vector<double> &v);
};
} // namespace snug::optimization

#endif
