#ifndef snug_mesh_refined_cells_h
#define snug_mesh_refined_cells_h

#include <snug/mesh/body_mesh.h>

#include <deal.II/grid/cell_id.h>

#include <set>
#include <vector>

namespace snug::mesh {
/// Levels of a cell above its coarse cell.
unsigned int level(const dealii::CellId &cell);

/// The cell that has @p cell as a child. @p cell must not be a coarse one.
dealii::CellId parent(const dealii::CellId &cell);

/// Add a cell and all its ancestors to those that have children.
void refine(const dealii::CellId &cell, std::set<dealii::CellId> &refined);

/// The cells of all ranks, each once and ascending. Collective.
std::vector<dealii::CellId> gather_cells(const std::vector<dealii::CellId> &mine,
                                         MPI_Comm                           communicator);

/// Those of @p cells of this rank, of all ranks. Collective.
template <int dim>
std::vector<dealii::CellId> gather_cells(const BodyMesh<dim>             &mesh,
                                         const std::vector<unsigned int> &cells);

/// All active cells, ascending: an order that does not depend on the ranks. Collective.
template <int dim>
std::vector<dealii::CellId> all_cells(const BodyMesh<dim> &mesh);

/// Values of this rank's cells in the order of all_cells(). Collective.
template <int dim>
std::vector<double> gather_values(const BodyMesh<dim>               &mesh,
                                  const std::vector<dealii::CellId> &all,
                                  const std::vector<double>         &of_cells);
} // namespace snug::mesh

#endif
