#ifndef snug_mesh_tearing_h
#define snug_mesh_tearing_h

#include <snug/mesh/body_mesh.h>
#include <snug/mesh/clusters.h>

#include <vector>

namespace snug::mesh {
/// One subdomain of this rank. A reference point has a subdomain without cells and nodes.
struct Subdomain
{
  unsigned int              body;
  std::vector<unsigned int> cells; ///< indices into BodyMesh::cells()
  /// local indices of the unconstrained nodes on which the cells depend, ascending
  std::vector<unsigned int> nodes;
};

/// The subdomains into which the bodies are torn. Ids are contiguous on each rank.
struct Tearing
{
  std::vector<Subdomain>    subdomains; ///< of this rank
  unsigned int              first_id = 0;
  unsigned int              n_global = 0;
  unsigned int              n_points = 0;     ///< of n_global: of reference points, the last ones
  std::vector<unsigned int> first_id_of_rank; ///< n_ranks + 1 entries
  Clusters                  clusters;         ///< without the subdomains of reference points
};

/**
 * Tear the bodies into subdomains, which are the face-connected pieces of the parts
 * of the mesh, and divide the subdomains into clusters, see find_clusters(). Collective.
 */
template <int dim>
Tearing tear(const BodyMesh<dim> &mesh, unsigned int cluster_edge = 0);
} // namespace snug::mesh

#endif
