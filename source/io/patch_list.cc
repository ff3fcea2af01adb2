#include <snug/io/patch_list.h>

#include <deal.II/base/data_out_base.h>

#include <cmath>
#include <sstream>

namespace snug::io {
/// One patch per cell: deal.II draws it as n_subdivisions^d cells, linear between the nodes.
template <int d, int dim>
struct PatchList<d, dim>::Data
{
  /// First and last component, name and kind, as DataOutBase wants them.
  using Ranges =
    std::vector<std::tuple<unsigned int,
                           unsigned int,
                           std::string,
                           dealii::DataComponentInterpretation::DataComponentInterpretation>>;

  std::vector<std::string>                        names;
  Ranges                                          ranges;
  std::vector<dealii::DataOutBase::Patch<d, dim>> patches;
};

template <int d, int dim>
PatchList<d, dim>::PatchList(const std::vector<Quantity> &quantities)
  : data(std::make_unique<Data>())
{
  using namespace dealii::DataComponentInterpretation;
  for (const auto &quantity : quantities)
    {
      const unsigned int first = data->names.size();
      // every component bears the name of its quantity; the ranges tell which belong together
      data->names.insert(data->names.end(), quantity.components, quantity.name);
      if (quantity.components > 1)
        // scalars need no range; deal.II pads vectors in 2D to 3 components
        data->ranges.emplace_back(first, first + quantity.components - 1, quantity.name,
                                  quantity.components == 9 ? component_is_part_of_tensor
                                                           : component_is_part_of_vector);
    }
}

template <int d, int dim>
PatchList<d, dim>::~PatchList() = default;

template <int d, int dim>
void PatchList<d, dim>::add(const std::vector<dealii::Tensor<1, dim>> &points,
                            const std::vector<std::vector<double>>    &values)
{
  const unsigned int n_components = data->names.size();
  // nodes per edge
  const unsigned int n = std::lround(std::pow(points.size(), 1. / d));
  AssertDimension(points.size(), values.size());
  AssertDimension(dealii::Utilities::fixed_power<d>(n), points.size());

  dealii::DataOutBase::Patch<d, dim> patch;
  patch.patch_index    = data->patches.size();
  patch.n_subdivisions = n - 1;
  // The last dim rows of data are then coordinates, and the vertices of the patch are not used.
  patch.points_are_available = true;
  patch.reference_cell       = dealii::ReferenceCells::get_hypercube<d>();
  patch.data.reinit(n_components + dim, points.size());
  for (unsigned int a = 0; a < points.size(); ++a)
    {
      AssertDimension(values[a].size(), n_components);
      for (unsigned int c = 0; c < n_components; ++c)
        patch.data(c, a) = values[a][c];
      for (unsigned int c = 0; c < dim; ++c)
        patch.data(n_components + c, a) = points[a][c];
    }
  data->patches.push_back(patch);
}

template <int d, int dim>
std::string PatchList<d, dim>::vtu() const
{
  std::ostringstream out;
  dealii::DataOutBase::write_vtu(data->patches, data->names, data->ranges,
                                 dealii::DataOutBase::VtkFlags(), out);
  return out.str();
}

/// It names the quantities but has no points, so any rank can write it.
template <int d, int dim>
std::string PatchList<d, dim>::pvtu(const std::vector<std::string> &pieces) const
{
  std::ostringstream out;
  dealii::DataOutBase::write_pvtu_record(out, pieces, data->names, data->ranges,
                                         dealii::DataOutBase::VtkFlags());
  return out.str();
}

/// ParaView's list of time steps; file names are relative to it.
std::string pvd(const std::vector<std::pair<double, std::string>> &series)
{
  std::ostringstream out;
  dealii::DataOutBase::write_pvd_record(out, series);
  return out.str();
}

template class PatchList<1, 2>;
template class PatchList<2, 2>;
template class PatchList<2, 3>;
template class PatchList<3, 3>;
} // namespace snug::io
