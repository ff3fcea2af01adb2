#ifndef snug_feti_coarse_space_h
#define snug_feti_coarse_space_h

#include <snug/base/narrow.h>
#include <snug/feti/factor_pool.h>
#include <snug/feti/row_layout.h>
#include <snug/feti/subdomain_system.h>

#include <memory>

namespace snug::feti {
/// Body and rank of every subdomain, equal on all ranks.
struct SubdomainTable
{
  unsigned int              n_modes = 0; ///< number of rigid modes of each subdomain
  unsigned int              first   = 0; ///< global id of the first subdomain of this rank
  std::vector<unsigned int> body;        ///< body of each global subdomain
  std::vector<std::string>  body_names;
};

/**
 * The natural coarse space @f$G = R^T B^T@f$ (n_kernel x n). It is stored by columns, one for each
 * row of B that this rank owns. This class also holds the data that all faces share: the pattern of
 * G G', the contribution of the equality rows to G G', and the rigid modes of the bodies in coarse
 * coordinates.
 */
class CoarseSpace
{
public:
  /// Build the patterns for @p layout. The coarse problem is factorized by @p n_ranks ranks, see
  /// coarse_team(). Collective.
  CoarseSpace(const RowLayout &layout, const SubdomainTable &table, unsigned int n_ranks);

  /**
   * Set the values of G and the body modes. Collective.
   * @param[in] G_entries holds, for each gathered entry of B (RowLayout), the n_modes products
   *   B_entry * R(unknown, :). The products of consecutive entries begin @p stride numbers apart.
   * @param[in] Z of the subdomains of this rank.
   */
  void update(const std::vector<double>          &G_entries,
              unsigned int                        stride,
              const std::vector<qp::MultiVector> &Z);

  unsigned int n_kernel() const { return narrow<unsigned int>(table.body.size()) * table.n_modes; }

  /// Return G_M x summed over ranks (n_kernel x k). M is the set of all rows if @p free is null.
  /// Collective.
  qp::MultiVector multiply(const qp::MultiVector &x, const qp::RowSet *free) const;

  /// Return G_M' alpha on the owned rows. It is zero on rows outside M.
  qp::MultiVector transpose_multiply(const qp::MultiVector &alpha, const qp::RowSet *free) const;

  /// Return the values of G_M G_M' in the pattern of pattern(). Collective.
  std::vector<double> gram_values(const qp::RowSet &free) const;

  /// Return a matrix with the pattern of G G', in which the representatives of all bodies are
  /// coupled.
  const CsrMatrix &pattern() const { return gram; }

  /// Return the pool from which faces take their factorizations.
  const FactorPool &factors() const { return factor_pool; }

  /// Return the orthonormal body modes in coarse coordinates, n_kernel x (n_bodies n_modes). They
  /// are equal on all ranks.
  const qp::MultiVector &body_modes() const { return modes; }

  /// Orthonormal motions of the bodies that the rows M of A = G_M G_M' do not resist or hardly
  /// resist, in coordinates of body_modes().
  struct HardlySeen
  {
    qp::MultiVector unseen; ///< motions without resistance by any row of M
    qp::MultiVector weak;   ///< weakly resisted, as by nearly parallel normals
  };

  /// Return the bases of both kinds of motions for the matrix @p A = G_M G_M'.
  HardlySeen hardly_seen_motions(const CsrMatrix &A) const;

  /// Return the coarse coordinates of one representative subdomain per body.
  const std::vector<unsigned int> &representatives() const { return representative; }

  const SubdomainTable &subdomains() const { return table; }

  /// Return the Frobenius norm of G. Collective.
  double norm() const;

private:
  void build_pattern();

  const RowLayout          &layout;
  SubdomainTable            table;
  std::vector<unsigned int> block_start;     ///< first block of each owned row
  std::vector<unsigned int> block_subdomain; ///< subdomain of each block
  std::vector<unsigned int> block_of_entry;  ///< block of each gathered entry
  std::vector<double>       blocks;          ///< n_modes numbers per block of G
  CsrMatrix                 gram;
  std::vector<std::size_t>  bounded_places; ///< positions in gram to which contact rows contribute
  std::vector<double>       equality_gram;
  FactorPool                factor_pool;
  qp::MultiVector           modes;
  std::vector<unsigned int> representative;

  void add_row(unsigned int row, std::vector<double> &values) const;
};

/**
 * This class holds the factorized coarse problem G_M G_M' of one face, its kernel N and the motions
 * W. The rows of M hardly resist the motions W, which are scaled to W' G_M G_M' W = I. The
 * factorized matrix is
 * A = G_M G_M' + rho V_f (V_f' V_f)^{-1} V_f'
 * on the representatives f, where the columns of V span the kernel and the hardly resisted motions.
 */
class CoarseProblem
{
public:
  /// Assemble and factorize the coarse problem of the face @p free. Collective.
  CoarseProblem(const CoarseSpace &space, const qp::RowSet &free);

  /// Return the number of steps of solve(): one, or five if some motions are hardly resisted.
  unsigned int n_steps() const { return W.n_columns() > 0 ? 5 : 1; }

  /**
   * Return the contribution of step @p step to (G_M G_M')^+ c for every column, orthogonal to N. A
   * single step returns the whole solution if W is empty. Otherwise the solution is a sum over
   * steps: even steps return W W'c, the part along W, and odd steps return A^{-1} c without its
   * part in N. Each step takes the c that remains after the previous steps.
   */
  qp::MultiVector solve(const qp::MultiVector &c, unsigned int step) const;

  /// Return N N' c.
  qp::MultiVector kernel_part(const qp::MultiVector &c) const;

private:
  std::shared_ptr<const SparseFactor> A;
  qp::MultiVector                     N; ///< orthonormal kernel, n_kernel x (its dimension)
  qp::MultiVector                     W;
};
} // namespace snug::feti

#endif
