#ifndef snug_io_patch_list_h
#define snug_io_patch_list_h

#include <deal.II/base/tensor.h>

#include <memory>
#include <string>
#include <vector>

namespace snug::io {
/// A nodal quantity: 1 component for a scalar, dim for a vector, 9 (row by
/// row) for a tensor.
struct Quantity
{
  std::string  name;
  unsigned int components;
};

/**
 * Cells of dimension @p d in space of dimension @p dim with nodal values,
 * and their VTU text. A cell of degree p is drawn as p^d cells; neighbours
 * do not share points. Numbers are written in single precision.
 */
template <int d, int dim>
class PatchList
{
public:
  explicit PatchList(const std::vector<Quantity> &quantities);
  ~PatchList();

  /**
   * Add a cell.
   * @param[in] points Its (p+1)^d nodes, tensor-product order, first
   *   coordinate fastest [length].
   * @param[in] values Per node, the components of all quantities in turn.
   */
  void add(const std::vector<dealii::Tensor<1, dim>> &points,
           const std::vector<std::vector<double>>    &values);

  std::string vtu() const;

  /// The PVTU text that joins the VTU files @p pieces.
  std::string pvtu(const std::vector<std::string> &pieces) const;

private:
  struct Data;
  std::unique_ptr<Data> data;
};

/// The PVD text of a series of (time, file).
std::string pvd(const std::vector<std::pair<double, std::string>> &series);
} // namespace snug::io

#endif
