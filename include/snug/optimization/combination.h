#ifndef snug_optimization_combination_h
#define snug_optimization_combination_h

#include <snug/optimization/optimization_parameters.h>

#include <vector>

namespace snug::optimization {
/// One objective made of several: its value and d value / d J_c.
struct Combined
{
  double              value = 0.;
  std::vector<double> factors;
};

/**
 * J from the objectives J_c of load cases, their
 * weights w_c and the largest abs(w_c J_c) of the first design, s.
 *
 * worst is the smooth maximum of Kreisselmeier and Steinhauser,
 * @f[ J = m + \frac{s}{p} \ln \sum_c e^{p (w_c J_c - m) / s}, \quad
 *     m = \max_c w_c J_c, \quad p = 100, @f]
 * at most s ln(n)/p above m, for any sign of the J_c. A single objective
 * is left as it is, but for its weight.
 *
 * Source: Kreisselmeier, Steinhauser, Systematic control design by
 * optimizing a vector performance index, IFAC CADCS (1979).
 */
Combined combined(Combination                combination,
                  const std::vector<double> &values,
                  const std::vector<double> &weights,
                  double                     scale);
} // namespace snug::optimization

#endif
