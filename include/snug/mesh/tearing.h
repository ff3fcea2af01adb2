#ifndef snug_mesh_tearing_h
#define snug_mesh_tearing_h

#include <snug/mesh/body_mesh.h>

#include <string>
#include <vector>

namespace snug
{
  namespace mesh
  {
    /// One subdomain of this rank.
    struct Subdomain
    {
      unsigned int              body;
      std::vector<unsigned int> cells; ///< indices into BodyMesh::cells()
      /// local indices of the unconstrained nodes its cells reach, ascending
      std::vector<unsigned int> nodes;
    };

    /// How the bodies are torn; ids are contiguous on each rank.
    struct Tearing
    {
      std::vector<Subdomain>    subdomains; ///< of this rank
      unsigned int              first_id = 0;
      unsigned int              n_global = 0;
      std::vector<unsigned int> first_id_of_rank; ///< n_ranks + 1 entries
    };

    /// Entries of `subsection Decomposition`.
    struct TearingParameters
    {
      unsigned int subdomains = 0;      ///< of all ranks, a target; 0: by size
      std::string  method     = "grid"; ///< a name of partition_table()
    };

    /**
     * Tear this rank's cells of each body into face-connected subdomains. The
     * number by size aims at 5 Q1 cells per subdomain edge in 3D, 12 in
     * 2D. There is at least one per rank and body. Collective.
     */
    template <int dim>
    Tearing
    tear(const BodyMesh<dim> &mesh, const TearingParameters &parameters);
  } // namespace mesh
} // namespace snug

#endif
