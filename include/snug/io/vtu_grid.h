#ifndef snug_io_vtu_grid_h
#define snug_io_vtu_grid_h

#include <deal.II/base/tensor.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace snug::io {
/// A quantity with 1 component for a scalar, dim for a vector, or 6 for a symmetric tensor in the
/// order of VTK: XX, YY, ZZ, XY, YZ, XZ.
struct Quantity
{
  std::string              name;
  unsigned int             components;
  std::vector<std::string> names = {}; ///< of the components; empty: the axes
};

/**
 * Cells of dimension @p d in space of dimension @p dim that share points, with values at the
 * points and of the cells, and their text in VTU files. A cell of degree p is drawn as p^d cells,
 * which are linear between their points, simplices of degree 2 as they are. Numbers are written in
 * single precision, vectors with three components.
 *
 * Source: VTK file formats, https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html
 */
template <int d, int dim>
class VtuGrid
{
public:
  VtuGrid(const std::vector<Quantity> &at_points, const std::vector<Quantity> &of_cells);

  /// Add a point. @param[in] values The components of all quantities in turn. @return the number
  /// of the point.
  unsigned int add_point(const dealii::Tensor<1, dim> &x, const std::vector<double> &values);

  /// Add a cell. @param[in] points Points of its (p+1)^d nodes, tensor-product order, first
  /// coordinate fastest.
  void add_cell(const std::vector<unsigned int> &points, const std::vector<double> &values);

  /// Add a simplex of degree 2. @param[in] points Points of its corners, then of the middles of its
  /// edges, in the order of VTK: 01, 12, 02 and in space 03, 13, 23.
  void add_simplex(const std::vector<unsigned int> &points, const std::vector<double> &values);

  /// Return the grid's piece of the text of a VTU file. @param[in] compression Level of zlib, 0
  /// (none) to 9.
  std::string piece(unsigned int compression) const;

  /// Return whether there is no cell.
  bool is_empty() const { return types.empty(); }

  /// Return the declarations of the arrays for pvtu().
  std::string declarations() const;

private:
  /// One quantity at all points, or of all cells.
  struct Array
  {
    std::string              name;
    unsigned int             components; ///< number of given components
    std::vector<std::string> names;      ///< of the written components; empty for a scalar
    std::vector<float>       values;

    std::size_t n_written() const { return names.empty() ? 1 : names.size(); }
  };

  static std::vector<Array> arrays(const std::vector<Quantity> &quantities);
  static void               append(const std::vector<double> &values, std::vector<Array> &to);

  std::vector<Array>        at_points, of_cells;
  Array                     places{"", dim, {"X", "Y", "Z"}, {}};
  std::vector<std::int32_t> corners; ///< points of the drawn cells, in the order of VTK
  std::vector<std::int32_t> ends;    ///< of the points of each drawn cell
  std::vector<std::uint8_t> types;   ///< of the drawn cells

  void end_cell(std::uint8_t type, const std::vector<double> &values);
};

/// @name VTU text around pieces with the same quantities, as those of several ranks
/// @{
std::string vtu_begin();
std::string vtu_end();
/// @}

/// Return the PVTU text that joins VTU files with the same arrays. @param[in] declarations Those of
/// a grid with these arrays.
std::string pvtu(const std::string &declarations, const std::vector<std::string> &files);

/// Return the PVD text of a series of (time, file).
std::string pvd(const std::vector<std::pair<double, std::string>> &series);
} // namespace snug::io

#endif
