#ifndef snug_qp_packed_columns_h
#define snug_qp_packed_columns_h

#include <snug/qp/multi_vector.h>

#include <algorithm>
#include <array>

namespace snug::qp {
/**
 * Eight columns of a multi-vector, or what is left of them and zeros, with the numbers of a row
 * side by side: loops over the entries of a sparse matrix read it once for all eight, and the
 * compiler knows their number.
 */
class PackedColumns
{
public:
  static constexpr unsigned int width = 8;
  using Row                           = std::array<double, width>;

  /// Columns [first, first + width) of @p x, as far as there are.
  PackedColumns(const MultiVector &x, const unsigned int first_column)
    : first(first_column), rows(x.n_rows())
  {
    for (unsigned int k = first; k < end(x); ++k)
      for (unsigned int i = 0; i < x.n_rows(); ++i)
        rows[i][k - first] = x(i, k);
  }

  Row       &operator[](const unsigned int i) { return rows[i]; }
  const Row &operator[](const unsigned int i) const { return rows[i]; }

  /// Put them back into @p x.
  void unpack(MultiVector &x) const
  {
    for (unsigned int k = first; k < end(x); ++k)
      for (unsigned int i = 0; i < x.n_rows(); ++i)
        x(i, k) = rows[i][k - first];
  }

  /// y += a x
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
