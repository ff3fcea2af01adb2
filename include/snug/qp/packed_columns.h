#ifndef snug_qp_packed_columns_h
#define snug_qp_packed_columns_h

#include <snug/qp/multi_vector.h>

#include <algorithm>
#include <array>

namespace snug::qp {
/**
 * Eight columns of a multi-vector, or the remaining columns and zeros, with the numbers of a row
 * side by side. A loop over the entries of a sparse matrix then reads the matrix once for all eight
 * columns, and the compiler knows their number.
 */
class PackedColumns
{
public:
  static constexpr unsigned int width = 8;
  using Row                           = std::array<double, width>;

  /// Copy the columns [first, first + width) of @p x, as far as they exist.
  PackedColumns(const MultiVector &x, const unsigned int first_column)
    : first(first_column), rows(x.n_rows())
  {
    for (unsigned int k = first; k < end(x); ++k)
      for (unsigned int i = 0; i < x.n_rows(); ++i)
        rows[i][k - first] = x(i, k);
  }

  Row       &operator[](const unsigned int i) { return rows[i]; }
  const Row &operator[](const unsigned int i) const { return rows[i]; }

  /// Copy the columns back into @p x.
  void unpack(MultiVector &x) const
  {
    for (unsigned int k = first; k < end(x); ++k)
      for (unsigned int i = 0; i < x.n_rows(); ++i)
        x(i, k) = rows[i][k - first];
  }

  /// Add a x to y.
  static void add(const double a, const Row &x, Row &y)
  {
    for (unsigned int k = 0; k < width; ++k)
      y[k] += a * x[k];
  }

private:
  unsigned int end(const MultiVector &x) const { return std::min(first + width, x.n_columns()); }

  unsigned int     first;
  std::vector<Row> rows;
};
} // namespace snug::qp

#endif
