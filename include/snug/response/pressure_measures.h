#ifndef snug_response_pressure_measures_h
#define snug_response_pressure_measures_h

#include <vector>

namespace snug::response {
/**
 * The pressure between two sides, one value per contact row:
 * q_i = p_i / A_i with force p_i [force] and tributary area A_i > 0
 * [length^2]. Integrals over the slave side are sums,
 * int f(q) dA = sum_i A_i f(q_i).
 */
struct PressureRows
{
  std::vector<double> force, area;
};

/// A function J(p, A) of these rows and its derivatives. Without any
/// pressure J and all derivatives are zero.
struct Measured
{
  double              value = 0.;
  std::vector<double> by_force, by_area;
};

/**
 * int (1 + e^2) q^2 / (q^2 + (e m)^2) dA [length^2],
 * m = int q^2 dA / int q dA: the area with a pressure above the part e of
 * its mean m, as the force sees it; exactly the area of an even pressure.
 * It stays smooth where contacts open.
 */
Measured contact_area(const PressureRows &rows, double e);

/// (int q^p dA)^(1/p) [pressure length^(2/p)], p >= 1.
Measured pressure_norm(const PressureRows &rows, double p);

/**
 * (int q^p q dA / int q dA)^(1/p) [pressure], p >= 1: the p-norm of the
 * pressure in the measure q dA / int q dA, in which all of the side
 * weighs 1 and open parts weigh nothing. It grows with p to the largest
 * q_i, and is q where q is even.
 */
Measured peak_pressure(const PressureRows &rows, double p);

/// int (q - m)^2 dA / int dA [pressure^2], m = int q dA / int dA, over all
/// of the side, open parts included.
Measured pressure_variance(const PressureRows &rows);
} // namespace snug::response

#endif
