#include <deal.II/lac/lapack_full_matrix.h>

#include <random/dense_algebra.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace snug::test {
NullSpace null_space(Matrix A, double cut)
{
  const unsigned int        n = A.n();
  std::vector<unsigned int> row_of(n, A.m()); // pivot row of each column
  std::vector<bool>         used(A.m(), false);
  NullSpace                 result{Matrix(), {}, {}, std::numeric_limits<double>::infinity(), 0.};
  unsigned int              rank = 0;
  for (;; ++rank)
    {
      unsigned int row = 0, column = 0;
      double       pivot = 0.;
      for (unsigned int i = 0; i < A.m(); ++i)
        for (unsigned int j = 0; j < n && !used[i]; ++j)
          if (row_of[j] == A.m() && std::abs(A(i, j)) > pivot)
            {
              pivot  = std::abs(A(i, j));
              row    = i;
              column = j;
            }
      if (pivot <= cut)
        {
          result.largest_left = pivot;
          break;
        }
      result.least_taken = pivot;
      used[row]          = true;
      result.pivot_rows.push_back(row);
      result.pivot_columns.push_back(column);
      row_of[column]  = row;
      const double by = A(row, column);
      for (unsigned int j = 0; j < n; ++j)
        A(row, j) /= by;
      for (unsigned int i = 0; i < A.m(); ++i)
        if (i != row && A(i, column) != 0.)
          {
            const double factor = A(i, column);
            for (unsigned int j = 0; j < n; ++j)
              A(i, j) -= factor * A(row, j);
          }
    }
  result.basis.reinit(n, n - rank);
  unsigned int k = 0;
  for (unsigned int free = 0; free < n; ++free)
    if (row_of[free] == A.m())
      {
        result.basis(free, k) = 1.;
        for (unsigned int j = 0; j < n; ++j)
          if (row_of[j] < A.m())
            result.basis(j, k) = -A(row_of[j], free);
        ++k;
      }
  return result;
}

void orthonormalise(Matrix &columns)
{
  const unsigned int n = columns.m();
  for (unsigned int j = 0; j < columns.n(); ++j)
    {
      for (unsigned int twice = 0; twice < 2; ++twice)
        for (unsigned int k = 0; k < j; ++k)
          {
            double product = 0.;
            for (unsigned int i = 0; i < n; ++i)
              product += columns(i, k) * columns(i, j);
            for (unsigned int i = 0; i < n; ++i)
              columns(i, j) -= product * columns(i, k);
          }
      double square = 0.;
      for (unsigned int i = 0; i < n; ++i)
        square += columns(i, j) * columns(i, j);
      for (unsigned int i = 0; i < n; ++i)
        columns(i, j) /= std::sqrt(square);
    }
}

Vector without(const Matrix &columns, Vector v)
{
  for (unsigned int k = 0; k < columns.n(); ++k)
    {
      double part = 0.;
      for (unsigned int i = 0; i < v.size(); ++i)
        part += columns(i, k) * v(i);
      for (unsigned int i = 0; i < v.size(); ++i)
        v(i) -= part * columns(i, k);
    }
  return v;
}

Vector least_squares(const Matrix &S, const Vector &b, double cut)
{
  Vector x(S.n());
  if (S.n() == 0)
    return x;
  dealii::LAPACKFullMatrix<double> inverse(S.m(), S.n());
  inverse = S;
  inverse.compute_inverse_svd(cut);
  inverse.vmult(x, b);
  return x;
}
} // namespace snug::test
