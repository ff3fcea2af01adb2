#ifndef snug_geometry_axis_spacing_h
#define snug_geometry_axis_spacing_h

namespace snug::geometry {
/**
 * Sizes of the n cells along one axis of a box. Logical coordinate xi of
 * the axis is mapped to the fraction f(xi) of its length, smooth within
 * the fine part and within the rest, such that refined cells keep the
 * spacing:
 *
 * - graded by the ratio r of the last to the first size,
 *     f(xi) = (q^(n xi) - 1) / (q^n - 1),  q = r^(1/(n-1));
 * - with a fine part of length c (a fraction): half of the cells, rounded
 *   up, m of them, are equal and fill c, and sizes grow from there by the
 *   ratio q that makes them fill the rest,
 *     f(xi) = c n xi / m  for  n xi <= m,
 *     f(xi) = c + c/m q (q^(n xi - m) - 1) / (q - 1)  beyond.
 */
class AxisSpacing
{
public:
  /// Equal sizes.
  explicit AxisSpacing(unsigned int n_cells = 1) : n(n_cells) {}

  /// Sizes in geometric progression, @p ratio > 0; at least two cells
  /// unless it is 1.
  static AxisSpacing graded(unsigned int n_cells, double ratio);

  /// @p fine in (0, 1); at least two cells.
  static AxisSpacing with_fine_part(unsigned int n_cells, double fine);

  double fraction(double xi) const;

private:
  unsigned int n;          ///< cells
  unsigned int m     = 0;  ///< of them in the fine part
  double       first = 0.; ///< length of the fine part
  double       log_q = 0.; ///< growth of sizes beyond
};
} // namespace snug::geometry

#endif
