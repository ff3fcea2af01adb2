#ifndef snug_feti_cluster_inverse_h
#define snug_feti_cluster_inverse_h

#include <snug/feti/cluster_structure.h>
#include <snug/feti/subdomain_factors.h>

namespace snug::feti {
/// The joints of one subdomain s. C_s holds the moments of its displacements on the faces that it
/// shares with other subdomains of its cluster, one row for each motion of a face.
struct SubdomainJoints
{
  qp::MultiVector Y; ///< K_s^+ C_s'
  qp::MultiVector N; ///< C R
  /// Combinations of moments that vanish for all displacements, W'C = 0, scaled by the root of the
  /// compliance. Subdomains of few cells have some, and their moments q could not be prescribed.
  /// Springs of the compliance W W' are therefore between the moments of the subdomain and q. They
  /// have no force in the solution, where q are moments of displacements, and do not change it.
  qp::MultiVector W;
  /// inverse of [C K^+ C' + W W', -C R; -R' C', 0], (k + n_modes) square for k moments
  qp::MultiVector T;
  double          compliance = 0.; ///< largest diagonal entry of C K^+ C'
};

/// Joints of the subdomains of this rank. Linearizations share those of equal K and positions.
using JointsOfSubdomains = std::vector<std::shared_ptr<const SubdomainJoints>>;

/**
 * The generalized inverse of clusters of subdomains (hybrid Total FETI). It minimizes the energy of
 * the subdomains of a cluster with equal moments q on both sides of each joint. A subdomain with
 * given moments, C_s u_s = A_s q, has
 * @f[ u_s = v_s - Y_s \mu_s + R_s \alpha_s, \qquad
 *     \binom{\mu_s}{\alpha_s} = T_s \binom{C_s v_s - A_s q}{-R_s^T b_s}, \qquad v_s = K_s^+ b_s,
 * @f]
 * and the forces mu of both sides of a joint balance:
 * @f[ S_c q = \sum_s A_s^T T_{11} A_s q
 *           = \sum_s A_s^T (T_{11} C_s v_s - T_{12} R_s^T b_s). @f]
 * S_c has the rigid motions of the cluster as its kernel and is fixed at one joint, as K_s is at
 * nodes.
 *
 * Source: Klawonn, Rheinbach, ZAMM 90 (2010), for hybrid FETI with averages of faces.
 */
class ClusterInverse
{
public:
  /**
   * Compute the equations of the joints. @p structure, @p table and @p systems must outlive this
   * object. Collective.
   * @param[in,out] shared joints of the subdomains. Null: to be computed.
   * @throws SolveError where the equations of a cluster are singular.
   */
  ClusterInverse(const ClusterStructure             &structure,
                 const SubdomainTable               &table,
                 const std::vector<SubdomainSystem> &systems,
                 const FactorsOfSubdomains          &factors,
                 JointsOfSubdomains                 &shared);

  /// Return the rigid modes of the cluster of subdomain @p s of this rank, on the unknowns of the
  /// subdomain. They are orthonormal on the cluster.
  const qp::MultiVector &rigid_modes(unsigned int s) const { return R[s]; }

  /// Return Z of the cluster of subdomain @p s, see CoarseSpace::CoarseSpace().
  const qp::MultiVector &body_modes(unsigned int s) const { return Z[s]; }

  /// Change the solutions @p x = K_s^+ b of the subdomains to those of the clusters. Return the
  /// forces of the joints on the subdomains, mu. Collective.
  std::vector<qp::MultiVector> join(const PrimalVectors &b, PrimalVectors &x) const;

  /// Return C' mu, the forces of the joints on the unknowns, for @p n_columns columns.
  PrimalVectors forces(const std::vector<qp::MultiVector> &mu, unsigned int n_columns) const;

private:
  void set_rigid_modes();
  void factorize();
  std::vector<ClusterStructure::Numbers>
                  solve_moments(const std::vector<ClusterStructure::Numbers> &of_subdomains,
                                unsigned int                                  n_columns) const;
  qp::MultiVector prescribe_moments(unsigned int                     s,
                                    const ClusterStructure::Numbers &q,
                                    const qp::MultiVector           &e,
                                    qp::MultiVector                 &x) const;

  const ClusterStructure                          &structure;
  const SubdomainTable                            &table;
  const std::vector<SubdomainSystem>              &systems;
  JointsOfSubdomains                               joints;
  std::vector<qp::MultiVector>                     R, Z; ///< of the subdomains of this rank
  std::vector<std::shared_ptr<const SparseFactor>> S;    ///< of the clusters at this home
};
} // namespace snug::feti

#endif
