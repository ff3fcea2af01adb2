#ifndef snug_feti_total_feti_h
#define snug_feti_total_feti_h

#include <snug/base/narrow.h>
#include <snug/feti/coarse_space.h>
#include <snug/feti/deflation.h>
#include <snug/feti/feti_parameters.h>
#include <snug/feti/generalized_inverse.h>
#include <snug/feti/local_schur.h>
#include <snug/feti/row_gram.h>

#include <memory>

namespace snug::feti {
/**
 * This class is the dual problem of Total FETI for bodies torn into floating subdomains,
 * @f[ F = B K^+ B^T,\quad G = R^T B^T,\quad d = B K^+ f - g,\quad
 *     e = R^T f. @f]
 * update() takes the matrices of a design and factorizes only the subdomains that have changed. It
 * reuses the symbolic factorizations of their patterns. Subdomains with equal matrices share one
 * factorization.
 *
 * Source: Dostál, Horák, Kučera, Commun. Numer. Meth. Engng 22 (2006).
 */
class TotalFeti : public qp::DualProblem
{
public:
  /// Set up the patterns of the coarse space and of the Gram matrix. @p systems, @p layout and
  /// @p context must outlive this object. Collective.
  TotalFeti(const std::vector<SubdomainSystem> &systems,
            const RowLayout                    &layout,
            const SubdomainTable               &table,
            const FetiParameters               &parameters,
            RunContext                         &context);

  /// Take the present matrices from the systems. set_loads() must follow, which updates the
  /// preconditioner. Collective.
  /// @param[in] changed flags of the subdomains of this rank whose K or R has changed.
  void update(const std::vector<bool> &changed);

  /// Return whether find_soft_modes() must still be called: soft modes are enabled, and at least
  /// one subdomain may have some. Equal on all ranks.
  bool misses_soft_modes() const { return !knows_soft_modes; }

  /**
   * Find the soft modes of the subdomains with their present matrices. PCPG is deflated by the
   * vectors of these modes in all later solves, also when the matrices change. Collective.
   */
  void find_soft_modes();

  /// Take the loads f from the systems and update the preconditioner. Collective.
  /// @param[in] g right-hand side of the owned rows [length].
  /// @throws SolveError if no contact forces balance the loads. The error names the body that
  /// escapes and its motion.
  void set_loads(const qp::MultiVector &g);

  RunContext            &context() const override { return run; }
  unsigned int           n_owned() const override { return layout.n_owned(); }
  const qp::RowSet      &bounded() const override { return layout.bounded(); }
  const qp::MultiVector &d() const override { return dual_load; }
  const qp::MultiVector &e() const override { return rigid_load; }
  /// Return (B D^{-1} B')_ii with D = diag K: the compliance of the unknowns of row i with their
  /// neighbours held. It is often far below F_ii, because the neighbours are held: a thousandth of
  /// F_ii where Poisson's ratio is 0.4999.
  const std::vector<double> &diagonal() const override { return F_diagonal; }
  qp::MultiVector            apply(const qp::MultiVector &x) const override;
  qp::MultiVector            apply_G(const qp::MultiVector &x) const override
  {
    return coarse.multiply(x, nullptr);
  }
  qp::MultiVector apply_Gt(const qp::MultiVector &alpha) const override
  {
    return coarse.transpose_multiply(alpha, nullptr);
  }
  double feasibility_scale(double force) const override
  {
    return gross_load + coarse_norm() * force;
  }
  /// Return ||G||. Collective.
  double                       coarse_norm() const { return coarse.norm(); }
  std::unique_ptr<qp::FreeSet> free_set(const qp::RowSet &free) const override;

  qp::RowSet expected_rows() const override { return expected; }

  /// Set the result of expected_rows(). The next set_loads() resets it to all rows.
  void expect(const qp::RowSet &rows) { expected = rows; }

  /// Return one line for each body that the equality rows and the contacts in @p rows leave free to
  /// move, with the motions of the body. Collective.
  std::vector<std::string> free_bodies(const qp::RowSet &rows) const;

  /// Return B v of primal vectors on the owned rows. Collective.
  qp::MultiVector multiply_B(const PrimalVectors &v) const;

  /// Return B' lambda. Collective.
  PrimalVectors multiply_Bt(const qp::MultiVector &lambda) const;

  /// Return K^+ applied to primal vectors.
  PrimalVectors apply_inverse(const PrimalVectors &right_hand_side) const;

  /// Return R' b of primal vectors, n_kernel x k on all ranks. Collective.
  qp::MultiVector rigid_part(const PrimalVectors &b) const;

  /// Return max_s || |R_s|' |b_s| || for every column. The rounding error of the rigid part is
  /// relative to this value, however much of the rigid part cancels. Collective.
  std::vector<double> gross_rigid_part(const PrimalVectors &b) const;

  /// Return u = K^+ (b - B' lambda) + R alpha. Collective.
  PrimalVectors
  recover(PrimalVectors b, const qp::MultiVector &lambda, const qp::MultiVector &alpha) const;

  /**
   * Move the bodies along the motions that the rows @p loaded leave free: u += R d and @p alpha +=
   * d. @p loaded are the equality rows and the contacts with a force. d is chosen such that the
   * part of R'u in these motions has minimum norm, among the d that keep the other contacts from
   * closing further. Collective.
   */
  void settle(const qp::RowSet &loaded, PrimalVectors &u, qp::MultiVector &alpha) const;

  /// Return the loads f of the systems.
  PrimalVectors loads() const;

  const qp::MultiVector &g() const { return gap; }

  const std::vector<SubdomainSystem> &subdomains() const { return systems; }

  unsigned int n_bodies() const
  {
    return narrow<unsigned int>(coarse.subdomains().body_names.size());
  }

  /// Return the number of rows of G, that is of rigid modes of all subdomains.
  unsigned int n_kernel() const { return coarse.n_kernel(); }

private:
  class FetiFreeSet;

  /// Return the number of values that gather_entries() sends for each entry of B.
  unsigned int        entry_width() const { return 2 + coarse.subdomains().n_modes; }
  std::vector<double> gather_entries() const;
  void                update_deflation();
  void                gather_rows();
  void                weight_rows();
  void                check_equilibrium() const;
  void                update_preconditioner();
  void                precondition(qp::MultiVector &x) const;
  void                add_rigid(const qp::MultiVector &alpha, PrimalVectors &u) const;

  const std::vector<SubdomainSystem>              &systems;
  const RowLayout                                 &layout;
  FetiParameters                                   parameters;
  RunContext                                      &run;
  CoarseSpace                                      coarse;
  RowGram                                          gram;
  FillOrderings                                    orderings;
  SharedPatterns                                   patterns;
  FactorPool                                       inverse_factors, inner_factors;
  std::vector<std::unique_ptr<GeneralizedInverse>> inverses;
  std::vector<std::unique_ptr<LocalSchur>>         schur;
  /// B D^{-1} of each subdomain, numbered by the boundary positions of its schur.
  std::vector<std::vector<BEntry>> weighted_B;
  std::vector<bool> outdated; ///< flags of subdomains whose preconditioner is not of the present K
  bool              knows_soft_modes = true;
  std::unique_ptr<Deflation> deflation; ///< null: disabled, not found yet, or no soft mode exists
  bool                       deflation_outdated = false;
  qp::MultiVector            gap, dual_load, rigid_load;
  double                     gross_load = 0.;
  std::vector<double>        F_diagonal;
  qp::RowSet                 expected;
};
} // namespace snug::feti

#endif
