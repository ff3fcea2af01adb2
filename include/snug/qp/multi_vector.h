#ifndef snug_qp_multi_vector_h
#define snug_qp_multi_vector_h

#include <mpi.h>

#include <vector>

namespace snug::qp {
/**
 * This class holds this rank's rows of @p k vectors, stored column by column. One vector is the
 * case k = 1. Blocks of right-hand sides share every operation.
 */
class MultiVector
{
public:
  explicit MultiVector(unsigned int n_rows = 0, unsigned int n_columns = 1);

  unsigned int n_rows() const { return rows; }

  unsigned int n_columns() const { return columns; }

  double &operator()(unsigned int i, unsigned int j = 0)
  {
    return values[i + std::size_t(j) * rows];
  }

  double operator()(unsigned int i, unsigned int j = 0) const
  {
    return values[i + std::size_t(j) * rows];
  }

  double *column(unsigned int j) { return values.data() + std::size_t(j) * rows; }

  const double *column(unsigned int j) const { return values.data() + std::size_t(j) * rows; }

  /// Add factor * x, of equal size, to this multi-vector.
  void add(double factor, const MultiVector &x);

  /// Add factor * x * C to this multi-vector, with C (x.n_columns x n_columns).
  void add_product(double factor, const MultiVector &x, const MultiVector &C);

  /// Append the columns of @p x, which has as many rows. Start from MultiVector(n_rows, 0), because
  /// the default has one column.
  void append(const MultiVector &x);

  /// Reserve memory for @p n columns. Until then append() copies no earlier columns, and unused
  /// memory is not touched.
  void reserve(unsigned int n);

  /// Return the columns [first, first + n).
  MultiVector columns_from(unsigned int first, unsigned int n) const;

private:
  unsigned int        rows;
  unsigned int        columns;
  std::vector<double> values;
};

/// Return X' Y summed over ranks (X.n_columns x Y.n_columns), equal on all ranks. Collective.
MultiVector inner_products(const MultiVector &X, const MultiVector &Y, MPI_Comm comm);

/// Return X' Y of the rows of this rank alone.
MultiVector transpose_times(const MultiVector &X, const MultiVector &Y);

/// Return the Euclidean norms of the columns, equal on all ranks. Collective.
std::vector<double> norms(const MultiVector &X, MPI_Comm comm);

/// Return x C with C (x.n_columns x n).
MultiVector times(const MultiVector &x, const MultiVector &C);

/// Return the rows of x with the given numbers.
MultiVector rows_of(const MultiVector &x, const std::vector<unsigned int> &numbers);
} // namespace snug::qp

#endif
