#ifndef snug_mesh_distribute_h
#define snug_mesh_distribute_h

#include <snug/mesh/forest.h>
#include <snug/mesh/parts.h>
#include <snug/mesh/quadratic_elements.h>

#include <deal.II/distributed/fully_distributed_tria.h>

namespace snug::mesh {
/// The cells of this rank after the distribution.
template <int dim>
struct LocalCells
{
  std::vector<unsigned int> parts;    ///< of the owned cells, numbered body by body
  QuadraticElements<dim>    elements; ///< of the owned cells and the ghost cells at least
  /// of all bodies, with the owned cells and the ghost cells at least
  std::shared_ptr<const Geometries<dim>> geometries;
};

/**
 * Decide the parts into which the bodies are torn and give whole parts to
 * the ranks, so that subdomains do not depend on the number of ranks.
 *
 * If the number of subdomains is chosen by size, parts have about the number of cells of
 * @p by_size. There are at least as many parts as ranks if there are enough cells. Every body is
 * distributed over all ranks in runs of consecutive parts. The numbers of cells of two ranks
 * differ by at most about two parts.
 *
 * The cells of an element of @p elements that is whole are in one part.
 *
 * @param refined cells of @p coarse and their children.
 * @param result an empty triangulation, which receives the same cells.
 * @return the parts of this rank's cells of @p result, numbered body by
 *   body.
 *
 * Collective.
 */
template <int dim>
std::vector<unsigned int>
distribute_refined(const CoarseMesh<dim>                                   &coarse,
                   const QuadraticElements<dim>                            &elements,
                   const TearingParameters                                 &parameters,
                   const CellsPerSubdomain                                 &by_size,
                   const dealii::parallel::distributed::Triangulation<dim> &refined,
                   dealii::parallel::fullydistributed::Triangulation<dim>  &result);

/// Distribute the coarse cells themselves in the same way, without a forest of p4est. Rank 0
/// decides the parts and sends all other ranks their cells, so that only rank 0 needs the coarse
/// mesh, the @p elements and the cells of mesh files. Collective.
/// @throws InputError if a formula of a geometry is not finite.
template <int dim>
LocalCells<dim> distribute_coarse(const Forest<dim>            &forest,
                                  const QuadraticElements<dim> &elements,
                                  const TearingParameters      &parameters,
                                  const CellsPerSubdomain      &by_size,
                                  dealii::parallel::fullydistributed::Triangulation<dim> &result);

/// Distribute the coarse cells themselves to the same ranks and parts by the row "grid" of
/// partition_table(). All bodies must have grids. A rank computes its own cells and their
/// neighbours from the grids, so that no rank has the coarse mesh. Collective.
/// @throws InputError if a formula of a geometry is not finite.
template <int dim>
std::vector<unsigned int>
distribute_grids(const Geometries<dim>                                  &geometries,
                 const TearingParameters                                &parameters,
                 const CellsPerSubdomain                                &by_size,
                 dealii::parallel::fullydistributed::Triangulation<dim> &result);

/// Distribute the cells of a forest by the function above that needs least. Collective.
/// @throws InputError if a formula of a geometry is not finite.
template <int dim>
LocalCells<dim> distribute(const Forest<dim>                                      &forest,
                           const QuadraticElements<dim>                           &elements,
                           const TearingParameters                                &parameters,
                           const CellsPerSubdomain                                &by_size,
                           dealii::parallel::fullydistributed::Triangulation<dim> &result);
} // namespace snug::mesh

#endif
