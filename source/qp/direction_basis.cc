#include <snug/base/narrow.h>
#include <snug/qp/direction_basis.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>

namespace snug::qp {
namespace {
/// Singular values below this part of the longest column are rounding errors.
const double null_rounding = 1e-12;

/// Return whether row @p row of x has a nonzero entry. Only exact zeros count as zero: a row that
/// no direction has ever touched puts no condition on combinations.
bool is_nonzero(const MultiVector &x, unsigned int row)
{
  for (unsigned int j = 0; j < x.n_columns(); ++j)
    if (x(row, j) != 0.)
      return true;
  return false;
}
} // namespace

MultiVector null_space(const MultiVector &A, const double cut)
{
  const unsigned int m = A.n_rows(), n = A.n_columns();
  // A table of deal.II without rows has no columns either. An added row of zeros has no effect.
  dealii::LAPACKFullMatrix<double> svd(std::max(m, 1u), n);
  for (unsigned int j = 0; j < n; ++j)
    for (unsigned int i = 0; i < m; ++i)
      svd(i, j) = A(i, j);
  svd.compute_svd();
  unsigned int rank = 0;
  while (rank < n && svd.singular_value(rank) > cut)
    ++rank;
  MultiVector N(n, n - rank);
  for (unsigned int j = 0; j < N.n_columns(); ++j)
    for (unsigned int i = 0; i < n; ++i)
      N(i, j) = svd.get_svd_vt()(rank + j, i);
  return N;
}

DirectionBasis DirectionBasis::off(const RowSet &rows, MPI_Comm comm) const
{
  const unsigned int        n = P.n_columns();
  std::vector<unsigned int> mine;
  for (unsigned int i = 0; i < rows.size(); ++i)
    if (rows[i] && is_nonzero(P, i))
      mine.push_back(i);
  unsigned int count = narrow<unsigned int>(mine.size()), first = 0, total = 0;
  MPI_Scan(&count, &first, 1, MPI_UNSIGNED, MPI_SUM, comm);
  first -= count; // MPI_Exscan leaves the result undefined on the first rank
  MPI_Allreduce(&count, &total, 1, MPI_UNSIGNED, MPI_SUM, comm);
  if (total == 0)
    return *this;
  // As many conditions as directions leave no combination in general, so skip the work.
  if (total >= n)
    return DirectionBasis();
  // Every rank gets all these rows and computes the same null space, so the combinations need no
  // further communication. The sum only collects the rows and is exact.
  MultiVector on_rows(total, n);
  for (unsigned int j = 0; j < n; ++j)
    for (unsigned int i = 0; i < count; ++i)
      on_rows(first + i, j) = P(mine[i], j);
  MPI_Allreduce(MPI_IN_PLACE, on_rows.column(0), total * n, MPI_DOUBLE, MPI_SUM, comm);
  // The cut is relative to these rows, because all of them may be small compared with other rows.
  const auto        lengths = norms(on_rows, MPI_COMM_SELF);
  const MultiVector N =
    null_space(on_rows, null_rounding * *std::max_element(lengths.begin(), lengths.end()));
  DirectionBasis result = {times(P, N), times(FP, N), unit};
  // Rounding errors on these rows would be forces on rows outside the face, which must be zero.
  for (unsigned int j = 0; j < result.P.n_columns(); ++j)
    for (const unsigned int i : mine)
      result.P(i, j) = 0.;
  return result;
}
} // namespace snug::qp
