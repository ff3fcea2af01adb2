#ifndef snug_mesh_parts_h
#define snug_mesh_parts_h

#include <snug/mesh/idealization.h>
#include <snug/mesh/partition.h>

#include <functional>

namespace snug::mesh {
/// Parts of each body, and the numbers of cells of the parts on all ranks together.
struct Parts
{
  std::vector<Partition>                  of_body;
  std::vector<std::vector<unsigned long>> cells;
};

/// Number of cells of a part if the number of subdomains is chosen by size.
struct CellsPerSubdomain
{
  double compact; ///< for cubes of nearly cubic cells, which have no soft modes
  double other;   ///< for all other parts
};

/**
 * Return the numbers of cells of a subdomain that balance the costs of factorizations,
 * iterations, soft modes and coarse problem. Compact subdomains have 5 Q1 cells per edge in 3D and
 * 12 in 2D, other subdomains have 6.3 and 14. For higher degrees, the number of cells per edge is
 * divided by the degree. In axisymmetric subdomains the motion along the axis is the only rigid
 * motion, but rotations and motions along the radius cost little energy and are soft modes. With 64
 * cells per edge few soft modes are left.
 */
CellsPerSubdomain
cells_per_subdomain(unsigned int dim, unsigned int degree, const Idealization &idealization);

/**
 * Return the factor on cells_per_subdomain() for a nearly incompressible body, which means twice
 * as many cells per edge in 3D. Jumps of the displacement between subdomains are stiff if they
 * change the volume of cells, and larger subdomains have fewer such jumps. With this factor, two
 * blocks of 20^3 cells at Poisson's ratio 0.499 take 33 F-mults instead of 91.
 */
double larger_subdomains(unsigned int dim);

/// Cells of a body, which decide the sizes of its parts.
struct CellsOfBody
{
  unsigned long n_global;  ///< number of cells
  unsigned long n_slender; ///< number of cells with CellShape::is_slender()
  bool          layered;   ///< see CellSet
  /// mean number of unknowns of a cell divided by that of a cell of no element
  double work = 1.;
};

/**
 * Call @p make with the numbers of cells of the parts of each body, until it has made as many parts
 * with cells, whose number it returns, as there are ranks or cells. The numbers are halved from
 * call to call. @p make returns the same number on all ranks.
 */
void make_parts(unsigned int                                                     dim,
                const std::vector<CellsOfBody>                                  &bodies,
                const TearingParameters                                         &parameters,
                const CellsPerSubdomain                                         &by_size,
                unsigned int                                                     n_ranks,
                const std::function<unsigned long(const std::vector<double> &)> &make);

/**
 * Decide the parts into which the bodies are torn. @p sets holds the cells of each body. If the
 * number of subdomains is chosen by size, parts have about the number of cells of @p by_size.
 * There are at least as many parts as ranks if there are enough cells. Collective.
 */
template <int dim>
Parts decide_parts(const std::vector<CellSet<dim>> &sets,
                   const TearingParameters         &parameters,
                   const CellsPerSubdomain         &by_size);

/**
 * The ranks of the parts of bodies, one body after the other. The parts of each body are assigned
 * to the ranks in runs. The share of a rank in a body compensates the imbalance of the bodies
 * before.
 */
class RankRuns
{
public:
  explicit RankRuns(unsigned int n_ranks) : load(n_ranks, 0.) {}

  /// Return the first part of each rank, and then the number of parts of the next body.
  /// @p cells_before returns the number of cells of the parts before a part, or of all parts.
  std::vector<unsigned int>
  next_body(unsigned int n_parts, const std::function<unsigned long(unsigned int)> &cells_before);

private:
  std::vector<double> load;     ///< cells of each rank
  double              all = 0.; ///< cells of all ranks
};

/**
 * Return the ranks of the parts, body by body. @p cells[b][p] is the number of cells
 * of part p of body b. The ranks are those of RankRuns.
 */
std::vector<std::vector<unsigned int>>
ranks_of_parts(const std::vector<std::vector<unsigned long>> &cells, unsigned int n_ranks);
} // namespace snug::mesh

#endif
