#ifndef snug_feti_coarse_space_h
#define snug_feti_coarse_space_h

#include <snug/base/narrow.h>
#include <snug/feti/factor_pool.h>
#include <snug/feti/row_layout.h>
#include <snug/feti/subdomain_system.h>

namespace snug::feti {
/// Body and cluster of every subdomain, equal on all ranks, and the joints of the subdomains of
/// this rank.
struct SubdomainTable
{
  /// The face that a subdomain shares with another subdomain of its cluster.
  struct Joint
  {
    unsigned int              other; ///< global id of the other subdomain
    std::vector<unsigned int> dofs;  ///< common unknowns, ordered alike in both subdomains
    /// n_modes orthonormal motions of the face, equal in both subdomains, which distinguish all
    /// rigid motions
    qp::MultiVector motions;
  };

  unsigned int              n_modes = 0; ///< number of rigid modes of each subdomain
  unsigned int              first   = 0; ///< global id of the first subdomain of this rank
  std::vector<unsigned int> body;        ///< body of each global subdomain
  std::vector<std::string>  body_names;
  unsigned int              n_rigid = 0; ///< number of subdomains without stiffness, the last ones
  /// cluster of each global subdomain, in the order of their first subdomains; empty if every
  /// subdomain is a cluster
  std::vector<unsigned int>       clusters;
  std::vector<unsigned int>       first_subdomains; ///< of the clusters, if they have several
  std::vector<std::vector<Joint>> joints;           ///< of each subdomain of this rank, by other
  /// whether soft modes are found although clusters cannot use them, because the clusters were not
  /// chosen by the user, see Linearization::prefers_subdomains()
  bool compares_soft_modes = false;

  unsigned int cluster_of(unsigned int subdomain) const
  {
    return clusters.empty() ? subdomain : clusters[subdomain];
  }
  unsigned int first_of_cluster(unsigned int cluster) const
  {
    return clusters.empty() ? cluster : first_subdomains[cluster];
  }
  unsigned int n_clusters() const
  {
    return narrow<unsigned int>(clusters.empty() ? body.size() : first_subdomains.size());
  }

  /// Return whether a global subdomain has no stiffness (SubdomainSystem::is_rigid()).
  bool is_rigid(unsigned int subdomain) const { return subdomain + n_rigid >= body.size(); }

  unsigned int n_kernel() const { return n_clusters() * n_modes; }

  unsigned int n_bodies() const { return narrow<unsigned int>(body_names.size()); }
};

/**
 * This class describes coarse vectors, which have n_modes numbers per cluster, and the structure
 * of the matrices on them: the blocks of G, the pattern of G G', and the entries of G G' to which
 * contact rows contribute. It belongs to a pairing. Coarse vectors are equal on all ranks.
 */
class CoarseStructure
{
public:
  /// Build the patterns for @p layout. The coarse problem is factorized by @p n_ranks ranks, see
  /// coarse_group(). Collective.
  CoarseStructure(const RowLayout &layout, SubdomainTable table, unsigned int n_ranks);

  /// Sum @p contributions to coarse vectors over ranks. Collective.
  void sum(qp::MultiVector &contributions) const;

  /// Return the norm of each column of the coarse vectors @p c.
  std::vector<double> norms(const qp::MultiVector &c) const;

  const RowLayout          &layout;
  const SubdomainTable      table;
  std::vector<unsigned int> block_start;     ///< first block of each owned row
  std::vector<unsigned int> block_cluster;   ///< cluster of each block
  std::vector<unsigned int> block_of_entry;  ///< block of each gathered entry
  std::vector<unsigned int> representatives; ///< coarse coordinates of one cluster per body
  /// clusters that are coupled in G G', by rows or as representatives of bodies
  CsrPattern couplings;
  CsrPattern contact_couplings; ///< clusters that contact rows couple
  FactorPool factors;           ///< factorizations of G_M G_M' of the faces

  /// Return the pattern of G G', which has a full block of n_modes^2 entries for each coupling.
  std::shared_ptr<const CsrPattern> gram_pattern() const;

  /// Entries of a block of G G'. Its rows are @p length apart.
  struct Block
  {
    std::size_t first, length;
  };
  /// Return the place in gram_pattern() of the block of the coupled clusters @p a and @p b.
  Block block(unsigned int a, unsigned int b) const;

private:
  void find_couplings();
};

/**
 * The natural coarse space @f$G = R^T B^T@f$ (n_kernel x n) at a geometry. It is stored by columns,
 * one for each row of B that this rank owns. This class also holds the data that all faces share:
 * the contribution of the equality rows to G G', and the rigid modes of the bodies in coarse
 * coordinates.
 */
class CoarseSpace
{
public:
  /**
   * Compute G and the body modes. Collective.
   * @param[in] structure must outlive this object.
   * @param[in] G_entries holds, for each gathered entry of B (RowLayout), the n_modes products
   *   B_entry * R(unknown, :), preceded by @p offset other numbers. R are the rigid modes of the
   *   clusters.
   * @param[in] body_modes Z of the clusters whose first subdomain is on this rank, for each
   *   subdomain of this rank: R Z are the rigid modes of the body. Empty for other subdomains.
   */
  CoarseSpace(const CoarseStructure              &structure,
              const std::vector<double>          &G_entries,
              unsigned int                        offset,
              const std::vector<qp::MultiVector> &body_modes);

  const CoarseStructure &structure() const { return pattern; }

  /// Return G x summed over ranks (n_kernel x k). Collective.
  qp::MultiVector multiply(const qp::MultiVector &x) const;

  /// Return G' alpha on the owned rows.
  qp::MultiVector transpose_multiply(const qp::MultiVector &alpha) const;

  /// Return G_M G_M' of the multipliers of @p free, G_M = G Z, in the pattern of
  /// CoarseStructure::gram_pattern(). Collective.
  CsrMatrix gram(const qp::FreeRows &free) const;

  /// Return the orthonormal body modes in coarse coordinates, n_kernel x (n_bodies n_modes). They
  /// are equal on all ranks.
  const qp::MultiVector &body_modes() const { return modes; }

  /// Orthonormal motions of the bodies that the rows M of A = G_M G_M' do not resist or hardly
  /// resist, in coordinates of body_modes().
  struct NearKernel
  {
    qp::MultiVector kernel; ///< motions without resistance by any row of M
    qp::MultiVector weak;   ///< weakly resisted, as by nearly parallel normals
  };

  /// Return the bases of both kinds of motions for the matrix @p A = G_M G_M'.
  NearKernel near_kernel(const CsrMatrix &A) const;

  /// Return the Frobenius norm of G. Collective.
  double norm() const;

private:
  void set_body_modes(const std::vector<qp::MultiVector> &Z);
  template <typename Place>
  void                add_column(unsigned int row, const double *column, const Place &place) const;
  std::vector<double> combined_column(const qp::FrictionCone      &cone,
                                      double                       of_normal,
                                      const std::array<double, 2> &of_tangents) const;

  const CoarseStructure &pattern;
  const RowLayout       &layout;
  std::vector<double>    blocks;        ///< n_modes numbers per block of G
  std::vector<double>    equality_gram; ///< in CoarseStructure::gram_pattern()
  qp::MultiVector        modes;
};
} // namespace snug::feti

#endif
