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
  /// B = 0.
  explicit SecantHessian(unsigned int n) : rows(n, std::vector<double>(n, 0.)) {}

  /// Return whether a difference of gradients was measured since guess().
  bool is_measured() const { return measured; }

  /// B = @p curvature I until a difference is measured.
  void guess(double curvature);

  /// Make d'Bd / d'd at least @p curvature.
  void raise(const std::vector<double> &d, double curvature);

  /**
   * A step @p s changed the gradient by @p y. The first step after guess() begins with
   * B = |y|/|s| I: between y's/s's and y'y/y's, the curvatures that the step and the change saw.
   * Where a later step saw less curvature than B has along it, all of B is scaled down by that, but
   * at most to 0.6: B began as stiff as the stiffest directions. Source: Al-Baali, Numerical
   * experience with a class of self-scaling quasi-Newton algorithms (1998).
   */
  void update(const std::vector<double> &s, const std::vector<double> &y);

  /// B d.
  std::vector<double> times(const std::vector<double> &d) const;

private:
  std::vector<std::vector<double>> rows;
  bool                             measured = false;

  void add(double factor, const std::vector<double> &v);
};
} // namespace snug::optimization

#endif
