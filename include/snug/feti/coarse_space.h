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
  unsigned int              n_modes = 0; ///< rigid modes of each
  unsigned int              first   = 0; ///< global id of this rank's first
  std::vector<unsigned int> body;        ///< per global subdomain
  std::vector<std::string>  body_names;
};

/**
 * The natural coarse space @f$G = R^T B^T@f$ (n_kernel x n), stored by
 * columns with the rows of B this rank owns, and what all its faces
 * share: the pattern of G G', the part of the equality rows, the rigid
 * modes of the bodies in coarse coordinates.
 */
class CoarseSpace
{
public:
  /// Patterns for @p layout. Factorized by @p n_ranks, see coarse_team(). Collective.
  CoarseSpace(const RowLayout &layout, const SubdomainTable &table, unsigned int n_ranks);

  /**
   * New numbers. Collective.
   * @param[in] G_entries per gathered entry of B (RowLayout), n_modes
   *   products B_entry * R(unknown, :), @p stride numbers apart.
   * @param[in] Z of this rank's subdomains.
   */
  void update(const std::vector<double>          &G_entries,
              unsigned int                        stride,
              const std::vector<qp::MultiVector> &Z);

  unsigned int n_kernel() const { return narrow<unsigned int>(table.body.size()) * table.n_modes; }

  /// G_M x summed over ranks (n_kernel x k); M = all rows if null.
  qp::MultiVector multiply(const qp::MultiVector &x, const qp::RowSet *free) const;

  /// G_M' alpha on the owned rows; zero off M.
  qp::MultiVector transpose_multiply(const qp::MultiVector &alpha, const qp::RowSet *free) const;

  /// Values of G_M G_M' in the pattern of pattern(). Collective.
  std::vector<double> gram_values(const qp::RowSet &free) const;

  /// Pattern of G G' with the representatives of all bodies coupled.
  const CsrMatrix &pattern() const { return gram; }

  /// Where faces find their factorization.
  const FactorPool &factors() const { return factor_pool; }

  /// Orthonormal body modes in coarse coordinates, n_kernel x n_bodies
  /// n_modes; equal on all ranks.
  const qp::MultiVector &body_modes() const { return modes; }

  /// Orthonormal motions of the bodies, in coordinates of body_modes().
  struct HardlySeen
  {
    qp::MultiVector unseen; ///< by the rows M of A = G_M G_M'
    qp::MultiVector weak;   ///< hardly seen, as across normals that are nearly parallel
  };

  HardlySeen hardly_seen_motions(const CsrMatrix &A) const;

  /// Coarse coordinates of one representative subdomain per body.
  const std::vector<unsigned int> &representatives() const { return representative; }

  const SubdomainTable &subdomains() const { return table; }

  /// Frobenius norm of G. Collective.
  double norm() const;

private:
  void build_pattern();

  const RowLayout          &layout;
  SubdomainTable            table;
  std::vector<unsigned int> block_start;     ///< per owned row
  std::vector<unsigned int> block_subdomain; ///< of each block
  std::vector<unsigned int> block_of_entry;  ///< of gathered entries
  std::vector<double>       blocks;          ///< n_modes per block of G
  CsrMatrix                 gram;
  std::vector<std::size_t>  bounded_places; ///< in gram of contact rows
  std::vector<double>       equality_gram;
  FactorPool                factor_pool;
  qp::MultiVector           modes;
  std::vector<unsigned int> representative;

  void add_row(unsigned int row, std::vector<double> &values) const;
};

/**
 * G_M G_M' of one face, factorized, with its kernel N and the motions W
 * that its rows hardly see, scaled to W' G_M G_M' W = I:
 * A = G_M G_M' + rho V_f (V_f' V_f)^{-1} V_f' on the representatives f,
 * where V spans both.
 */
class CoarseProblem
{
public:
  /// Collective.
  CoarseProblem(const CoarseSpace &space, const qp::RowSet &free);

  /// Of solve(): one step, or more where motions are hardly seen.
  unsigned int n_steps() const { return W.n_columns() > 0 ? 5 : 1; }

  /**
   * (G_M G_M')^+ c for every column, orthogonal to N. Where motions are
   * hardly seen it is a sum: even steps give the part along W, W W'c, odd
   * ones A^{-1} c, with the c that the steps before left.
   */
  qp::MultiVector solve(const qp::MultiVector &c, unsigned int step) const;

  /// N N' c.
  qp::MultiVector kernel_part(const qp::MultiVector &c) const;

private:
  std::shared_ptr<const SparseFactor> A;
  qp::MultiVector                     N; ///< orthonormal kernel, n_kernel x (its dimension)
  qp::MultiVector                     W;
};
} // namespace snug::feti

#endif
