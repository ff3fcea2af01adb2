#ifndef snug_elasticity_pressure_space_h
#define snug_elasticity_pressure_space_h

#include <deal.II/base/point.h>

#include <vector>

namespace snug::elasticity {
/**
 * The polynomials of degree p-1 in the reference coordinates of a cell of degree p = 1, 2 or 3
 * (constants, linear or quadratic functions). They are given by their values at given points and
 * are orthonormal in the product @f$(f,g) = \sum_q f_q g_q dV_q@f$. Functions of lower degree
 * come first and span the space of lower p.
 */
template <int dim>
class PressureSpace
{
public:
  /// @p points lie on the reference cell and have the weights @p dV. Points with dV = 0 only
  /// receive values.
  PressureSpace(unsigned int                           degree,
                const std::vector<dealii::Point<dim>> &points,
                const std::vector<double>             &dV);

  /// Return the values at the points, [function][point].
  const std::vector<std::vector<double>> &functions() const { return orthonormal; }

  /// Replace the values at the points by their projection.
  void project(std::vector<double> &values) const;

private:
  std::vector<double>              dV;
  std::vector<std::vector<double>> orthonormal;

  double product(const std::vector<double> &f, const std::vector<double> &g) const;
};
} // namespace snug::elasticity

#endif
