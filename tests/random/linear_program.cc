#include <random/linear_program.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace snug::test {
namespace {
/// Minimum gain of a column that enters, and minimum pivot.
const double pays = 1e-9, least_pivot = 1e-7;
const double equal_ratios = 1e-10;

/// The equations A'y + p - n = c with columns y, p and n. Everything is made of
/// the basis anew in each step, so that rounding does not add up.
class Simplex
{
public:
  Simplex(const Matrix &A, const Vector &c) : k(c.size()), m(A.m()), A(A), c(c)
  {
    // p_i or n_i is what c_i needs to be reached by a sum of positive numbers
    for (unsigned int i = 0; i < k; ++i)
      basis.push_back(c(i) < 0. ? m + k + i : m + i);
    invert_basis();
  }

  /// The column that pays most enters; after many steps without end the first
  /// that pays, Bland's rule, which cannot cycle.
  void solve()
  {
    for (unsigned int step = 0; step < 20000; ++step)
      {
        const Vector y      = multipliers();
        unsigned int column = m + 2 * k, row = k;
        double       most = pays;
        for (unsigned int j = 0; j < m + 2 * k && (step < 2000 || row == k); ++j)
          {
            const double gain = y * entries(j) - cost(j);
            // Costs are not below zero: a column that pays without end is rounding.
            const unsigned int leaving = gain > most ? leaving_row(j) : k;
            if (leaving < k)
              {
                column = j;
                row    = leaving;
                most   = gain;
              }
          }
        if (row == k)
          return;
        basis[row] = column;
        invert_basis();
      }
    throw std::runtime_error("the linear program does not end");
  }

  Vector multipliers() const
  {
    Vector costs(k), y(k);
    for (unsigned int i = 0; i < k; ++i)
      costs(i) = cost(basis[i]);
    inverse.Tvmult(y, costs);
    return y;
  }

  double value() const
  {
    Vector x(k);
    inverse.vmult(x, c);
    double sum = 0.;
    for (unsigned int i = 0; i < k; ++i)
      sum += cost(basis[i]) * x(i);
    return sum;
  }

private:
  double cost(unsigned int column) const { return column < m ? 0. : 1.; }

  Vector entries(unsigned int column) const
  {
    Vector result(k);
    for (unsigned int i = 0; i < k && column < m; ++i)
      result(i) = A(column, i);
    if (column >= m)
      result((column - m) % k) = column < m + k ? 1. : -1.;
    return result;
  }

  void invert_basis()
  {
    Matrix B(k, k);
    for (unsigned int j = 0; j < k; ++j)
      {
        const Vector column = entries(basis[j]);
        for (unsigned int i = 0; i < k; ++i)
          B(i, j) = column(i);
      }
    inverse = B;
    inverse.gauss_jordan();
  }

  /// Return the leaving row; for equal ratios the row of the largest pivot, because of rounding.
  unsigned int leaving_row(unsigned int column) const
  {
    Vector x(k), direction(k);
    inverse.vmult(x, c);
    inverse.vmult(direction, entries(column));
    unsigned int row   = k;
    double       least = 0.;
    for (unsigned int i = 0; i < k; ++i)
      if (direction(i) > least_pivot)
        {
          const double ratio = std::max(0., x(i)) / direction(i);
          if (row == k || ratio < least - equal_ratios ||
              (ratio < least + equal_ratios && direction(i) > direction(row)))
            {
              row   = i;
              least = ratio;
            }
        }
    return row;
  }

  unsigned int              k, m;
  const Matrix             &A;
  const Vector             &c;
  std::vector<unsigned int> basis;
  Matrix                    inverse;
};
} // namespace

Optimum largest(const Matrix &A, const Vector &c)
{
  Optimum optimum{0., Vector(c.size()), 0.};
  if (c.size() == 0)
    return optimum;
  Simplex simplex(A, c);
  simplex.solve();
  optimum.r     = simplex.multipliers();
  optimum.error = std::max(0., optimum.r.linfty_norm() - 1.);
  optimum.value = c * optimum.r;
  optimum.error = std::max(optimum.error, std::abs(optimum.value - simplex.value()));
  for (unsigned int j = 0; j < A.m(); ++j)
    {
      double opening = 0.;
      for (unsigned int i = 0; i < c.size(); ++i)
        opening += A(j, i) * optimum.r(i);
      optimum.error = std::max(optimum.error, opening);
    }
  return optimum;
}
} // namespace snug::test
