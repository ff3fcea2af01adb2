#ifndef snug_io_vtu_grid_h
#define snug_io_vtu_grid_h

#include <deal.II/base/tensor.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace snug::io {
/// A quantity with 1 component for a scalar, dim for a vector, or 9 (row by row) for a tensor.
struct Quantity
{
  std::string  name;
  unsigned int components;
};

/**
 * Cells of dimension @p d in space of dimension @p dim that share points, with values at the
 * points and of the cells, and their text in VTU files. A cell of degree p is drawn as p^d cells,
 * which are linear between their points. Numbers are written in single precision, vectors with
 * three components.
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

  /// Return the grid's piece of the text of a VTU file. @param[in] compression Level of zlib, 0
  /// (none) to 9.
  std::string piece(unsigned int compression) const;

  /// Return the PVTU text that joins VTU files.
  std::string pvtu(const std::vector<std::string> &files) const;

private:
  /// One quantity at all points, or of all cells.
  struct Array
  {
    std::string        name;
    unsigned int       components; ///< number of given components
    unsigned int       written;    ///< number of components including zeros
    std::vector<float> values;
  };

  static std::vector<Array> arrays(const std::vector<Quantity> &quantities);
  static void               append(const std::vector<double> &values, std::vector<Array> &to);

  std::vector<Array>        at_points, of_cells;
  Array                     places{"", dim, 3, {}};
  std::vector<std::int32_t> corners; ///< 2^d corners of each drawn cell, in the order of VTK
};

/// Return the VTU text of pieces with the same quantities, as those of several ranks.
std::string vtu(const std::vector<std::string> &pieces);

/// Return the PVD text of a series of (time, file).
std::string pvd(const std::vector<std::pair<double, std::string>> &series);
} // namespace snug::io

#endif
