#include <random/lemke.h>

#include <cmath>
#include <stdexcept>

namespace snug::test {
namespace {
const double same_ratio = 1e-12;

/// Equations w - M z - d z_0 = q. Columns w, z, z_0, q; those of w hold the
/// inverse of the basis, by which rows of equal ratio are told apart.
class Pivots
{
public:
  Pivots(const Matrix &M, const Vector &q, const Vector &d)
    : n(q.size()), values(n, 2 * n + 2), basis(n)
  {
    for (unsigned int i = 0; i < n; ++i)
      {
        basis[i]     = i;
        values(i, i) = 1.;
        for (unsigned int j = 0; j < n; ++j)
          values(i, n + j) = -M(i, j);
        values(i, cover())   = -d(i);
        values(i, 2 * n + 1) = q(i);
      }
  }

  unsigned int cover() const { return 2 * n; }

  /// The row of the smallest ratio of q to @p sign times @p column where that
  /// is positive; n if it is nowhere.
  unsigned int smallest_ratio(unsigned int column, double sign) const
  {
    unsigned int row = n;
    for (unsigned int i = 0; i < n; ++i)
      if (sign * values(i, column) > 1e-9 && (row == n || is_less(i, row, column, sign)))
        row = i;
    return row;
  }

  /// The variable that leaves.
  unsigned int pivot(unsigned int row, unsigned int column)
  {
    const double by = values(row, column);
    for (unsigned int j = 0; j < values.n(); ++j)
      values(row, j) /= by;
    for (unsigned int i = 0; i < n; ++i)
      if (i != row && values(i, column) != 0.)
        {
          const double factor = values(i, column);
          for (unsigned int j = 0; j < values.n(); ++j)
            values(i, j) -= factor * values(row, j);
        }
    const unsigned int left = basis[row];
    basis[row]              = column;
    return left;
  }

  Vector z() const
  {
    Vector result(n);
    for (unsigned int i = 0; i < n; ++i)
      if (basis[i] >= n && basis[i] < 2 * n)
        result(basis[i] - n) = values(i, 2 * n + 1);
    return result;
  }

  bool is_feasible() const
  {
    for (unsigned int i = 0; i < n; ++i)
      if (values(i, 2 * n + 1) < 0.)
        return false;
    return true;
  }

private:
  bool is_less(unsigned int a, unsigned int b, unsigned int column, double sign) const
  {
    const auto compare = [&](unsigned int j) {
      const double x = sign * values(a, j) / values(a, column);
      const double y = sign * values(b, j) / values(b, column);
      return std::abs(x - y) <= same_ratio * (1. + std::abs(x)) ? 0 : (x < y ? -1 : 1);
    };
    int less = compare(2 * n + 1);
    // Where q does not tell, the cover leaves first: that is the solution.
    if (less == 0 && (basis[a] == cover() || basis[b] == cover()))
      return basis[a] == cover();
    for (unsigned int j = 0; j < n && less == 0; ++j)
      less = compare(j);
    return less < 0;
  }

  unsigned int              n;
  Matrix                    values;
  std::vector<unsigned int> basis;
};
} // namespace

std::optional<Vector> lemke(const Matrix &M, const Vector &q, const Vector &d)
{
  const unsigned int n = q.size();
  Pivots             pivots(M, q, d);
  if (n == 0 || pivots.is_feasible())
    return Vector(n);
  // The cover enters where q / d is least: then all w are positive.
  unsigned int entering = pivots.cover();
  unsigned int row      = pivots.smallest_ratio(entering, -1.);
  for (unsigned int step = 0; step < 50 * n + 1000; ++step)
    {
      if (row == n)
        return std::nullopt;
      const unsigned int left = pivots.pivot(row, entering);
      if (left == pivots.cover())
        return pivots.z();
      entering = left < n ? left + n : left - n;
      row      = pivots.smallest_ratio(entering, 1.);
    }
  throw std::runtime_error("the complementary pivots do not end");
}
} // namespace snug::test
