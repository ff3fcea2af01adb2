#ifndef snug_response_pressure_measures_h
#define snug_response_pressure_measures_h

#include <vector>

namespace snug::response {
/**
 * The pressure between two sides, one value per contact row: q_i = p_i / A_i with force p_i
 * [force] and tributary area A_i > 0 [length^2]. Integrals over the slave side are sums,
 * int f(q) dA = sum_i A_i f(q_i).
 */
struct PressureRows
{
  std::vector<double> force, area;
};

/// A function J(p, A) of the pressure rows and its derivatives. If all pressures are zero, J and
/// all derivatives are zero.
struct Measured
{
  double              value = 0.;
  std::vector<double> by_force, by_area;
};

/**
 * Compute int (1 + e^2) q^2 / (q^2 + (e m)^2) dA [length^2] with
 * m = int q^2 dA / int q dA, the mean pressure weighted by the force. The value is the area with a
 * pressure above e m, in a smooth form. For a uniform pressure, it is exactly the loaded
 * area. The function stays smooth where contacts open.
 */
Measured contact_area(const PressureRows &rows, double e);

/// Compute (int q^p dA)^(1/p) [pressure length^(2/p)], p >= 1.
Measured pressure_norm(const PressureRows &rows, double p);

/**
 * Compute (int q^p q dA / int q dA)^(1/p) [pressure], p >= 1: the p-norm of the pressure in the
 * measure q dA / int q dA. In this measure the whole side has the weight 1 and its open parts have
 * the weight 0. The value grows with p to the maximum q_i, and equals q if q is uniform.
 */
Measured peak_pressure(const PressureRows &rows, double p);

/// Compute int q dA [force].
Measured total(const PressureRows &rows);

/// Compute int (q - m)^2 dA / int dA [pressure^2] with m = int q dA / int dA. The integrals
/// extend over the whole side, including its open parts.
Measured pressure_variance(const PressureRows &rows);
} // namespace snug::response

#endif
