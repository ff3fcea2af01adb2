#ifndef snug_feti_linearization_h
#define snug_feti_linearization_h

#include <snug/feti/cluster_inverse.h>
#include <snug/feti/deflation.h>
#include <snug/feti/dual_structure.h>
#include <snug/feti/jump_operator.h>

#include <memory>

namespace snug::feti {
/// Operators that depend on K and the equality rows alone. The linearizations of several positions
/// of the bodies at one geometry share them, and those of later geometries share a part. Null: to
/// be computed.
struct SharedOperators
{
  explicit SharedOperators(unsigned int n_subdomains = 0)
    : factors(n_subdomains), joints(n_subdomains)
  {}

  FactorsOfSubdomains                       factors;    ///< of the subdomains of this rank
  JointsOfSubdomains                        joints;     ///< of the subdomains of this rank
  std::shared_ptr<const ClusterInverse>     clusters;   ///< of the geometry
  std::shared_ptr<const DeflationStructure> soft_modes; ///< of the pairing
  std::shared_ptr<const DeflationVectors>   deflation;  ///< of the geometry
};

/**
 * This class holds the operators of Total FETI at one geometry, for bodies torn into floating
 * subdomains,
 * @f[ F = B K^+ B^T + D,\quad G = R^T B^T, @f]
 * the preconditioner and the soft modes. D is the diagonal matrix of the compliances of springs,
 * zero on other rows. A spring acts like a further subdomain with one unknown, the stiffness 1/D
 * and no rigid motion, which is glued to the body by its row. All loads of the geometry share one
 * Linearization. Subdomains with equal matrices share one factorization. Where subdomains form
 * clusters, K^+ and R are those of the clusters (ClusterInverse).
 *
 * Source: Dostál, Horák, Kučera, Commun. Numer. Meth. Engng 22 (2006).
 */
class Linearization
{
public:
  /**
   * Factorize the subdomains, compute G, G G' and B D^-1 B', and deflate by the soft modes. All
   * references must outlive this object, and the systems must not change. Collective.
   * @param[in] B of the subdomains of this rank.
   * @param[in] shared operators of a linearization with equal K and equality rows. Soft modes are
   *   found with these matrices if they are null and DualStructure::seeks_soft_modes().
   * @param[in] D of the owned rows; empty: no springs.
   * @throws SolveError where a matrix is not positive definite.
   */
  Linearization(const DualStructure                &structure,
                const std::vector<SubdomainSystem> &systems,
                ConstraintRows                      B,
                SharedOperators                     shared,
                std::vector<double>                 D = {});

  RunContext                         &context() const { return structure.cache.context; }
  const RowLayout                    &layout() const { return structure.layout; }
  unsigned int                        n_owned() const { return layout().n_owned(); }
  const qp::RowSet                   &contact_rows() const { return layout().contact_rows(); }
  const SubdomainTable               &table() const { return structure.coarse.table; }
  const std::vector<SubdomainSystem> &subdomains() const { return systems; }
  const ConstraintRows               &B() const { return rows; }

  /// Return the operators that other linearizations may share. The soft modes are never null, and
  /// the deflation is null without soft modes.
  const SharedOperators &shared() const { return operators; }

  const CoarseSpace &coarse() const { return *coarse_space; }

  /// Return D of an owned row, which is zero except for springs.
  double compliance(unsigned int row) const { return D.empty() ? 0. : D[row]; }

  /// Add factor * D x to y, on the owned rows.
  void add_compliance(double factor, const qp::MultiVector &x, qp::MultiVector &y) const;

  /// Return (B (diag K)^{-1} B' + D)_ii: the compliance of the unknowns of row i with their
  /// neighbours held. It is often far below F_ii, because the neighbours are held: a thousandth of
  /// F_ii where Poisson's ratio is 0.4999.
  const std::vector<double> &diagonal() const { return F_diagonal; }

  /// Return F x. Collective.
  qp::MultiVector apply(const qp::MultiVector &x) const;

  /// Return the face on which the rows @p free are free. Collective.
  std::unique_ptr<qp::FreeSet> free_set(const qp::FreeRows &free) const;

  /// Return B v of primal vectors on the owned rows. Collective.
  qp::MultiVector multiply_B(const PrimalVectors &v) const;

  /// Return B' lambda. Collective.
  PrimalVectors multiply_Bt(const qp::MultiVector &lambda) const;

  /// Return K^+ applied to primal vectors. Collective.
  PrimalVectors apply_inverse(const PrimalVectors &right_hand_side) const;

  /// Return R' b of primal vectors, n_kernel x k on all ranks. Collective.
  qp::MultiVector rigid_part(const PrimalVectors &b) const;

  /// Return max_s || |R_s|' |b_s| || for every column. The rounding error of the rigid part is
  /// relative to this value, however much of the rigid part cancels. Collective.
  std::vector<double> gross_rigid_part(const PrimalVectors &b) const;

  /// Return u = K^+ (b - B' lambda) + R alpha. Where subdomains form clusters, add the forces of
  /// their joints to the multipliers @p lambda of the gluing rows, so that K u = b - B' lambda
  /// holds for every subdomain. F does not see these forces. Collective.
  PrimalVectors
  recover(PrimalVectors b, qp::MultiVector &lambda, const qp::MultiVector &alpha) const;

  /// Return whether the soft modes of single subdomains are worth more than clusters: clusters
  /// cannot use them, and they save more iterations than clusters cost.
  bool prefers_subdomains() const { return clustered() && operators.soft_modes->n_vectors > 0; }

  /// Add R alpha to u.
  void add_rigid(const qp::MultiVector &alpha, PrimalVectors &u) const;

private:
  class FetiFreeSet;

  bool                   clustered() const { return structure.clusters.any(); }
  const qp::MultiVector &rigid_modes(unsigned int s) const;
  PrimalVectors          solve_subdomains(const PrimalVectors &b) const;
  qp::MultiVector        gluing_forces(const PrimalVectors &forces) const;
  void                   factorize();
  std::vector<double>    gather_entries();
  void                   weight_ground(const std::vector<double> &entries);
  std::vector<RowForces> find_soft_modes(const std::vector<double> &entries) const;
  void                   weight_rows();
  void                   precondition(qp::MultiVector &x) const;

  const DualStructure                &structure;
  const std::vector<SubdomainSystem> &systems;
  const ConstraintRows                rows;
  const std::vector<double>           D;
  SharedOperators                     operators;
  std::unique_ptr<const CoarseSpace>  coarse_space;
  std::unique_ptr<const RowGram>      gram;
  std::vector<double>                 F_diagonal;
  std::vector<double>                 ground; ///< compliances of springs as D^-1 weights copies
  /// B D^{-1} of each subdomain, numbered by the boundary positions of its Schur complement
  ConstraintRows                   weighted_B;
  std::unique_ptr<const Deflation> deflation; ///< null without soft modes
};
} // namespace snug::feti

#endif
