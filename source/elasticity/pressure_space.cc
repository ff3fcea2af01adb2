#include <snug/base/assertions.h>
#include <snug/elasticity/pressure_space.h>


#include <cmath>

namespace snug::elasticity {
template <int dim>
PressureSpace<dim>::PressureSpace(const unsigned int                     degree,
                                  const std::vector<dealii::Point<dim>> &points,
                                  const std::vector<double>             &dV)
  : dV(dV)
{
  SNUG_ASSERT_EQUAL(points.size(), dV.size());
  // Apply Gram-Schmidt to 1, xi_1 - 1/2, and so on. If the cell is not very distorted, these
  // functions are nearly orthogonal at the start, so one pass is enough.
  std::vector<std::vector<unsigned int>> axes = {{}}; // of the factors
  for (unsigned int i = 0; degree > 1 && i < dim; ++i)
    axes.push_back({i});
  for (unsigned int i = 0; degree > 2 && i < dim; ++i)
    for (unsigned int j = 0; j <= i; ++j)
      axes.push_back({i, j});
  for (const auto &of_function : axes)
    {
      std::vector<double> f(points.size(), 1.);
      for (unsigned int q = 0; q < f.size(); ++q)
        // Use reference coordinates, so that the functions move with the cell.
        for (const unsigned int axis : of_function)
          f[q] *= points[q][axis] - 0.5;
      for (const auto &g : orthonormal)
        {
          const double part = product(f, g);
          for (unsigned int q = 0; q < f.size(); ++q)
            f[q] -= part * g[q];
        }
      const double norm = std::sqrt(product(f, f));
      for (double &value : f)
        value /= norm;
      orthonormal.push_back(f);
    }
}

template <int dim>
void PressureSpace<dim>::project(std::vector<double> &values) const
{
  std::vector<double> projection(values.size(), 0.);
  for (const auto &f : orthonormal)
    {
      const double part = product(f, values);
      for (unsigned int q = 0; q < values.size(); ++q)
        projection[q] += part * f[q];
    }
  values = projection;
}

/// Return (f, g) = sum_q f_q g_q dV_q.
template <int dim>
double PressureSpace<dim>::product(const std::vector<double> &f, const std::vector<double> &g) const
{
  SNUG_ASSERT_EQUAL(f.size(), dV.size());
  SNUG_ASSERT_EQUAL(g.size(), dV.size());
  double sum = 0.;
  for (unsigned int q = 0; q < dV.size(); ++q)
    sum += f[q] * g[q] * dV[q];
  return sum;
}

template class PressureSpace<2>;
template class PressureSpace<3>;
} // namespace snug::elasticity
