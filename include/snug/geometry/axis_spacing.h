#ifndef snug_geometry_axis_spacing_h
#define snug_geometry_axis_spacing_h

namespace snug::geometry {
/**
 * Sizes of the n cells along one axis of a box. The logical coordinate xi of
 * the axis is mapped to the fraction f(xi) of the length of the axis. The map is smooth within
 * the fine part and within the rest, so that refined cells keep the
 * spacing:
 *
 * - graded by the ratio r of the last to the first size,
 *     f(xi) = (q^(n xi) - 1) / (q^n - 1),  q = r^(1/(n-1));
 * - with a fine part of length c (a fraction): m cells, half of n rounded
 *   up, are equal and fill c. The sizes of the other cells grow by the
 *   ratio q with which these cells fill the rest,
 *     f(xi) = c n xi / m  for  n xi <= m,
 *     f(xi) = c + c/m q (q^(n xi - m) - 1) / (q - 1)  beyond.
 */
class AxisSpacing
{
public:
  /// Construct cells of equal sizes.
  explicit AxisSpacing(unsigned int n_cells = 1) : n(n_cells) {}

  /// Return sizes in geometric progression, @p ratio > 0. At least two cells are required
  /// unless @p ratio is 1.
  static AxisSpacing graded(unsigned int n_cells, double ratio);

  /// Return sizes with a fine part of length @p fine in (0, 1). At least two cells are required.
  static AxisSpacing with_fine_part(unsigned int n_cells, double fine);

  double fraction(double xi) const;

private:
  unsigned int n;          ///< number of cells
  unsigned int m     = 0;  ///< number of cells in the fine part
  double       first = 0.; ///< length of the fine part
  double       log_q = 0.; ///< logarithm of the ratio q
};
} // namespace snug::geometry

#endif
