#ifndef snug_mesh_refined_cells_h
#define snug_mesh_refined_cells_h

#include <snug/mesh/body_mesh.h>

#include <deal.II/grid/cell_id.h>

#include <set>
#include <vector>

namespace snug::mesh {
/// Return the refinement level of a cell; coarse cells have level 0.
unsigned int level(const dealii::CellId &cell);

/// Return the parent of @p cell. @p cell must not be a coarse cell.
dealii::CellId parent(const dealii::CellId &cell);

/// Add a cell and all its ancestors to @p refined, the set of cells that have children.
void refine(const dealii::CellId &cell, std::set<dealii::CellId> &refined);

/// Return the cells of all ranks, each once and ascending. Collective.
std::vector<dealii::CellId> gather_cells(const std::vector<dealii::CellId> &mine,
                                         MPI_Comm                           communicator);

/// Return the ids of the cells @p cells of all ranks, each once and ascending. @p cells are indices
/// of BodyMesh::cells() on this rank. Collective.
template <int dim>
std::vector<dealii::CellId> gather_cells(const BodyMesh<dim>             &mesh,
                                         const std::vector<unsigned int> &cells);

/// Return all active cells in ascending order, which does not depend on the ranks. Collective.
template <int dim>
std::vector<dealii::CellId> all_cells(const BodyMesh<dim> &mesh);

/// Return the values of the cells of all ranks in the order of all_cells(). @p of_cells holds the
/// values of the cells of this rank. Collective.
template <int dim>
std::vector<double> gather_values(const BodyMesh<dim>               &mesh,
                                  const std::vector<dealii::CellId> &all,
                                  const std::vector<double>         &of_cells);
} // namespace snug::mesh

#endif
