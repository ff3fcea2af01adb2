#ifndef snug_mesh_distribute_h
#define snug_mesh_distribute_h

#include <snug/mesh/parts.h>
#include <snug/mesh/triangulate.h>

#include <deal.II/distributed/fully_distributed_tria.h>

namespace snug::mesh {
/**
 * Decide the parts into which the bodies are torn and give whole parts to
 * the ranks, so that subdomains do not depend on the number of ranks.
 *
 * Parts by size have the cells of @p by_size; there are as many parts as
 * ranks where there are cells enough. Every body is
 * spread over all ranks in runs of consecutive parts; ranks differ by at
 * most about two parts in their numbers of cells.
 *
 * @param refined cells of @p coarse and their children.
 * @param result the same cells, empty before.
 * @return the parts of this rank's cells of @p result, numbered body by
 *   body.
 *
 * Collective.
 */
template <int dim>
std::vector<unsigned int>
distribute(const CoarseMesh<dim>                                   &coarse,
           const TearingParameters                                 &parameters,
           const CellsPerSubdomain                                 &by_size,
           const dealii::parallel::distributed::Triangulation<dim> &refined,
           dealii::parallel::fullydistributed::Triangulation<dim>  &result);

/// The same for the coarse cells themselves, without a forest of p4est.
template <int dim>
std::vector<unsigned int>
distribute(const CoarseMesh<dim>                                  &coarse,
           const TearingParameters                                &parameters,
           const CellsPerSubdomain                                &by_size,
           dealii::parallel::fullydistributed::Triangulation<dim> &result);
} // namespace snug::mesh

#endif
