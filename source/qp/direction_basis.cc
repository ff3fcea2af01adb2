#include <snug/base/narrow.h>
#include <snug/qp/direction_basis.h>

#include <algorithm>
#include <cmath>

namespace snug::qp {
namespace {
/// Part of the largest entry below which a row is rounding.
const double rounding = 1e-12;

/// A <- A (I - 2 v v' / v'v)
void reflect(const std::vector<double> &v, MultiVector &A)
{
  double square = 0.;
  for (const double entry : v)
    square += entry * entry;
  for (unsigned int i = 0; i < A.n_rows(); ++i)
    {
      double product = 0.;
      for (unsigned int j = 0; j < v.size(); ++j)
        product += A(i, j) * v[j];
      for (unsigned int j = 0; j < v.size(); ++j)
        A(i, j) -= 2. * product / square * v[j];
    }
}

/// Exact zeros are meant: rows that no direction has ever touched put no condition on combinations.
bool is_nonzero(const MultiVector &x, unsigned int row)
{
  for (unsigned int j = 0; j < x.n_columns(); ++j)
    if (x(row, j) != 0.)
      return true;
  return false;
}
} // namespace

MultiVector null_space(MultiVector A)
{
  const unsigned int m = A.n_rows(), n = A.n_columns();
  MultiVector        Q(n, n); // product of the reflections
  double             largest = 0.;
  for (unsigned int j = 0; j < n; ++j)
    {
      Q(j, j) = 1.;
      for (unsigned int i = 0; i < m; ++i)
        largest = std::max(largest, std::abs(A(i, j)));
    }
  unsigned int rank = 0;
  for (unsigned int row = 0; row < m && rank < n; ++row)
    {
      std::vector<double> v(n, 0.); // of the reflection
      double              square = 0.;
      for (unsigned int j = rank; j < n; ++j)
        {
          v[j] = A(row, j);
          square += v[j] * v[j];
        }
      if (std::sqrt(square) <= rounding * largest)
        continue;
      // The sign that adds avoids the cancellation in v.
      v[rank] += std::copysign(std::sqrt(square), v[rank]);
      reflect(v, A);
      reflect(v, Q);
      ++rank;
    }
  return Q.columns_from(rank, n - rank);
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
  first -= count; // MPI_Exscan leaves it undefined on the first rank
  MPI_Allreduce(&count, &total, 1, MPI_UNSIGNED, MPI_SUM, comm);
  // As many conditions as directions leave nothing in general: spare the work.
  if (total >= n)
    return DirectionBasis();
  // Every rank gets all these rows (the sum only puts them side by side, exactly) and computes the
  // same null space, so that the combinations need no further communication.
  MultiVector on_rows(total, n);
  for (unsigned int j = 0; j < n; ++j)
    for (unsigned int i = 0; i < count; ++i)
      on_rows(first + i, j) = P(mine[i], j);
  MPI_Allreduce(MPI_IN_PLACE, on_rows.column(0), total * n, MPI_DOUBLE, MPI_SUM, comm);
  const MultiVector N      = null_space(on_rows);
  DirectionBasis    result = {times(P, N), times(FP, N), unit};
  // Rounding left on these rows would put forces on rows off the face, which are taken to be zero.
  for (unsigned int j = 0; j < result.P.n_columns(); ++j)
    for (const unsigned int i : mine)
      result.P(i, j) = 0.;
  return result;
}
} // namespace snug::qp
