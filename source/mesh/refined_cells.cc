#include <snug/base/gather.h>
#include <snug/mesh/refined_cells.h>

#include <deal.II/base/mpi.h>

#include <boost/serialization/array.hpp>

#include <algorithm>
#include <numeric>

namespace snug::mesh {
unsigned int level(const dealii::CellId &cell)
{
  return cell.get_child_indices().size();
}

dealii::CellId parent(const dealii::CellId &cell)
{
  const auto path = cell.get_child_indices();
  return {cell.get_coarse_cell_id(), std::vector<std::uint8_t>(path.begin(), path.end() - 1)};
}

void refine(const dealii::CellId &cell, std::set<dealii::CellId> &refined)
{
  dealii::CellId above = cell;
  while (refined.insert(above).second && level(above) > 0)
    above = parent(above);
}

/// Ids are packed with the bits per child of 3D, which suffice in 2D as well.
std::vector<dealii::CellId> gather_cells(const std::vector<dealii::CellId> &mine,
                                         MPI_Comm                           communicator)
{
  std::vector<dealii::CellId::binary_type> packed;
  for (const auto &cell : mine)
    packed.push_back(cell.to_binary<3>());
  std::vector<dealii::CellId> all;
  for (const auto &of_rank : all_gather(communicator, packed))
    for (const auto &cell : of_rank)
      all.emplace_back(cell);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

template <int dim>
std::vector<dealii::CellId> gather_cells(const BodyMesh<dim>             &mesh,
                                         const std::vector<unsigned int> &cells)
{
  std::vector<dealii::CellId> ids;
  for (const unsigned int cell : cells)
    ids.push_back(mesh.cell_id(cell));
  return gather_cells(ids, mesh.communicator());
}

template <int dim>
std::vector<dealii::CellId> all_cells(const BodyMesh<dim> &mesh)
{
  std::vector<unsigned int> all(mesh.cells().size());
  std::iota(all.begin(), all.end(), 0u);
  return gather_cells(mesh, all);
}

template <int dim>
std::vector<double> gather_values(const BodyMesh<dim>               &mesh,
                                  const std::vector<dealii::CellId> &all,
                                  const std::vector<double>         &of_cells)
{
  std::vector<double> values(all.size(), 0.);
  for (unsigned int cell = 0; cell < of_cells.size(); ++cell)
    values[std::lower_bound(all.begin(), all.end(), mesh.cell_id(cell)) - all.begin()] =
      of_cells[cell];
  dealii::Utilities::MPI::sum(values, mesh.communicator(), values);
  return values;
}

#define SNUG_INSTANTIATE(dim)                                                             \
  template std::vector<dealii::CellId> gather_cells(const BodyMesh<dim> &,                \
                                                    const std::vector<unsigned int> &);   \
  template std::vector<dealii::CellId> all_cells(const BodyMesh<dim> &);                  \
  template std::vector<double>         gather_values(const BodyMesh<dim> &,               \
                                                     const std::vector<dealii::CellId> &, \
                                                     const std::vector<double> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::mesh
