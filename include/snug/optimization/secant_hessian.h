#ifndef snug_optimization_secant_hessian_h
#define snug_optimization_secant_hessian_h

#include <vector>

namespace snug::optimization {
/**
 * This class computes a positive semidefinite approximation B of the Hessian of a Lagrangian, or of
 * the part of the Hessian that a prediction lacks, from differences of gradients: damped BFGS,
 * Powell, A fast algorithm for nonlinearly constrained optimization calculations (1978).
 */
class SecantHessian
{
public:
  /// Set B = 0 for @p n_all variables. B remains zero for the variables behind the first @p
  /// n_nonlinear.
  SecantHessian(unsigned int n_all, unsigned int n_nonlinear)
    : n(n_all), rows(n_nonlinear, std::vector<double>(n_nonlinear, 0.))
  {}

  /// Return whether a difference of gradients was measured since guess().
  bool is_measured() const { return measured; }

  /// Set B = @p curvature I until a difference is measured.
  void guess(double curvature);

  /// Make d'Bd at least @p product.
  void raise(const std::vector<double> &d, double product);

  /**
   * Update B by a step @p s that changed the gradient by @p y. The first step after guess() begins
   * with B = |y|/|s| I, which lies between the curvatures y's/s's and y'y/y's along the step and
   * along the change. If a later step measures less curvature than B has along the step, B is
   * scaled by this ratio, but at least by 0.6, because B began with the curvature of the stiffest
   * directions. Source: Al-Baali, Numerical experience with a class of self-scaling quasi-Newton
   * algorithms (1998).
   */
  void update(std::vector<double> s, std::vector<double> y);

  /// Return B d.
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
