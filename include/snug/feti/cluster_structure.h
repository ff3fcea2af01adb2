#ifndef snug_feti_cluster_structure_h
#define snug_feti_cluster_structure_h

#include <snug/feti/coarse_space.h>

#include <functional>

namespace snug::feti {
/**
 * This class describes the clusters of subdomains: which rank holds the equations of the joints of
 * a cluster, and their pattern. The equations of a cluster are on its home, the rank of its first
 * subdomain. A joint of two subdomains has n_modes unknowns, the moments of the displacements of
 * the face that both share.
 */
class ClusterStructure
{
public:
  /// Build the structure. Collective.
  ClusterStructure(const SubdomainTable &table, MPI_Comm communicator);

  MPI_Comm communicator() const { return comm; }

  /// Return whether any cluster of any rank has joints.
  bool any() const { return has_joints; }

  /// A subdomain of a cluster at the home of the cluster.
  struct Member
  {
    unsigned int              subdomain; ///< global
    std::vector<unsigned int> unknowns;  ///< of the cluster, joint by joint
  };

  /// A cluster whose home is this rank.
  struct Cluster
  {
    std::vector<unsigned int>         members; ///< indices into members(), by subdomain
    std::shared_ptr<const CsrPattern> pattern; ///< of the equations of the joints
  };

  const std::vector<Cluster> &clusters() const { return at_home; }
  const std::vector<Member>  &members() const { return of_home; }

  /// Numbers of one subdomain or member.
  using Numbers = std::vector<double>;

  /// Send the numbers of each subdomain of this rank to its home, and return those of the members.
  /// @p size returns how many numbers a subdomain with k joint unknowns sends. Subdomains without
  /// joints send nothing. Collective.
  std::vector<Numbers> to_homes(const std::vector<Numbers>                        &of_subdomains,
                                const std::function<unsigned int(unsigned int k)> &size) const;

  /// Send the numbers of each member to its subdomain. Collective.
  std::vector<Numbers> to_subdomains(const std::vector<Numbers>                        &of_members,
                                     const std::function<unsigned int(unsigned int k)> &size) const;

  FactorPool factors{MatrixKind::clusters}; ///< of the equations of the joints

private:
  /// Subdomains or members that this rank and another rank have in common, ascending.
  struct Neighbour
  {
    int                       rank;
    std::vector<unsigned int> numbers;
  };

  /// The subdomains of this rank, or the members at this home.
  struct Side
  {
    std::vector<Neighbour>    neighbours;
    std::vector<unsigned int> n_unknowns; ///< of the joints of each subdomain or member
  };

  std::vector<Numbers> exchange(const Side                                        &from,
                                const std::vector<Numbers>                        &sent,
                                const Side                                        &to,
                                const std::function<unsigned int(unsigned int k)> &size) const;
  void                 number_unknowns(const std::vector<std::vector<unsigned int>> &others,
                                       const SubdomainTable                         &table);

  MPI_Comm             comm;
  bool                 has_joints = false;
  std::vector<Cluster> at_home;
  std::vector<Member>  of_home;
  Side                 subdomain_side, member_side;
};
} // namespace snug::feti

#endif
