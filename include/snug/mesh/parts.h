#ifndef snug_mesh_parts_h
#define snug_mesh_parts_h

#include <snug/mesh/idealization.h>
#include <snug/mesh/partition.h>

namespace snug::mesh {
/// Parts of each body, and their numbers of cells on all ranks together.
struct Parts
{
  std::vector<Partition>                  of_body;
  std::vector<std::vector<unsigned long>> cells;
};

/// Of a part by size.
struct CellsPerSubdomain
{
  double compact; ///< where subdomains are cubes of nearly cubic cells, which have no soft modes
  double other;
};

/**
 * Cells of a subdomain that keep factorizations, iterations, soft modes and
 * coarse problem in balance: 5 Q1 cells per edge in 3D and 12 in 2D where
 * subdomains are compact, else 6.3 and 14. Fewer cells of higher degree, by
 * their nodes. Axisymmetric subdomains can all but turn and move along the
 * radius, the motion along the axis being their only rigid one: with 64
 * cells per edge few soft modes are left.
 */
CellsPerSubdomain
cells_per_subdomain(unsigned int dim, unsigned int degree, const Idealization &idealization);

/**
 * The factor of cells_per_subdomain() of a nearly incompressible body: twice as many cells per edge
 * in 3D. Jumps of the displacement between subdomains that change the volume of cells are stiff;
 * at Poisson's ratio 0.499, two blocks of 20^3 cells take 33 F-mults instead of 91 so.
 */
double larger_subdomains(unsigned int dim);

/**
 * The parts into which the bodies are torn, of the cells of each in @p sets. Parts by size have
 * the cells of @p by_size; there are as many parts as ranks where there are cells enough.
 * Collective.
 */
template <int dim>
Parts decide_parts(const std::vector<CellSet<dim>> &sets,
                   const TearingParameters         &parameters,
                   const CellsPerSubdomain         &by_size);

/**
 * Ranks of the parts, body by body: @p cells[b][p] is the number of cells
 * of part p of body b. Each body's parts go to the ranks in runs; the
 * shares even out what the bodies before have left unbalanced.
 */
std::vector<std::vector<unsigned int>>
ranks_of_parts(const std::vector<std::vector<unsigned long>> &cells, unsigned int n_ranks);
} // namespace snug::mesh

#endif
