#include <snug/base/narrow.h>
#include <snug/feti/csr_matrix.h>

#include <algorithm>

namespace snug::feti {
CsrMatrix CsrMatrix::from_rows(const std::vector<std::vector<PetscInt>> &columns_of_rows,
                               unsigned int                              n_columns)
{
  CsrMatrix matrix;
  matrix.n_rows    = narrow<unsigned int>(columns_of_rows.size());
  matrix.n_columns = n_columns;
  matrix.row_start.assign(1, 0);
  for (const auto &row : columns_of_rows)
    {
      matrix.columns.insert(matrix.columns.end(), row.begin(), row.end());
      matrix.row_start.push_back(narrow<PetscInt>(matrix.columns.size()));
    }
  matrix.values.assign(matrix.columns.size(), 0.);
  return matrix;
}

/// Binary search, as columns ascend. A place off the pattern gives that of another entry.
std::size_t CsrMatrix::position(PetscInt i, PetscInt j) const
{
  const auto begin = columns.begin() + row_start[i];
  const auto end   = columns.begin() + row_start[i + 1];
  return std::lower_bound(begin, end, j) - columns.begin();
}

double CsrMatrix::mean_diagonal() const
{
  double mean = 0.;
  for (unsigned int i = 0; i < n_rows; ++i)
    mean += diagonal(i) / n_rows;
  return mean;
}

void CsrMatrix::multiply_add(double factor, const qp::MultiVector &x, qp::MultiVector &y) const
{
  for (unsigned int k = 0; k < x.n_columns(); ++k)
    {
      const double *xk = x.column(k);
      double       *yk = y.column(k);
      for (unsigned int i = 0; i < n_rows; ++i)
        {
          double sum = 0.;
          for (PetscInt p = row_start[i]; p < row_start[i + 1]; ++p)
            // Column by column: the matrix is read k times, but x and y stay contiguous.
            sum += values[p] * xk[columns[p]];
          yk[i] += factor * sum;
        }
    }
}

void CsrMatrix::transpose_multiply_add(double                 factor,
                                       const qp::MultiVector &x,
                                       qp::MultiVector       &y) const
{
  for (unsigned int k = 0; k < x.n_columns(); ++k)
    {
      const double *xk = x.column(k);
      double       *yk = y.column(k);
      for (unsigned int i = 0; i < n_rows; ++i)
        {
          // Row i of A is column i of A', so that A' is never made.
          const double xi = factor * xk[i];
          for (PetscInt p = row_start[i]; p < row_start[i + 1]; ++p)
            yk[columns[p]] += values[p] * xi;
        }
    }
}
} // namespace snug::feti
