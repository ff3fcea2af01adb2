#ifndef snug_mesh_clusters_h
#define snug_mesh_clusters_h

#include <snug/mesh/body_mesh.h>

#include <vector>

namespace snug::mesh {
struct Tearing;

/**
 * Clusters of neighbouring subdomains of one body (hybrid Total FETI). The subdomains of a cluster
 * are joined by the rigid motions of the faces that they share, so that only the cluster as a whole
 * floats and the coarse problem has unknowns for clusters instead of subdomains. Clusters depend
 * neither on the number of ranks nor on the design.
 */
struct Clusters
{
  /// The nodes that a subdomain shares with another subdomain of its cluster.
  struct Joint
  {
    unsigned int              other; ///< global id of the other subdomain
    std::vector<unsigned int> nodes; ///< positions in Subdomain::nodes, ascending
  };

  /// whether the parameter file gives the number of subdomains per edge
  bool is_chosen = false;
  /// cluster of every global subdomain, in the order of their first subdomains; empty if every
  /// subdomain is a cluster
  std::vector<unsigned int>       of_subdomain;
  std::vector<std::vector<Joint>> joints; ///< of each subdomain of this rank, by other
};

/// Number of subdomains up to which every subdomain is a cluster, if the number of subdomains per
/// edge is chosen by size. The coarse problem of up to 15,000 unknowns costs less than the
/// additional iterations of clusters.
inline constexpr unsigned int most_single_clusters = 2500;

/// Maximum number of clusters if the number of subdomains per edge is chosen by size: a coarse
/// problem of 6,000 unknowns in 3D.
inline constexpr unsigned int most_clusters = 1000;

/**
 * Divide the subdomains of each body into clusters of about @p edge^dim subdomains, or of the
 * fewest for which there are at most most_clusters, if @p edge is zero. The boxes of the subdomains
 * are cut into slabs axis by axis, at gaps between layers of subdomains where there are some. The
 * pieces that are joined by faces are the clusters. Collective.
 */
template <int dim>
Clusters find_clusters(const BodyMesh<dim> &mesh, const Tearing &tearing, unsigned int edge);
} // namespace snug::mesh

#endif
