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
 * Total FETI: the dual problem of bodies torn into floating subdomains,
 * @f[ F = B K^+ B^T,\quad G = R^T B^T,\quad d = B K^+ f - g,\quad
 *     e = R^T f. @f]
 * update() brings a design's numbers and factorizes only the subdomains that changed, with the
 * symbolic factorizations of their patterns; subdomains with equal numbers share one.
 *
 * Source: Dostál, Horák, Kučera, Commun. Numer. Meth. Engng 22 (2006).
 */
class TotalFeti : public qp::DualProblem
{
public:
  /// @p systems and @p layout must outlive this object. Collective.
  TotalFeti(const std::vector<SubdomainSystem> &systems,
            const RowLayout                    &layout,
            const SubdomainTable               &table,
            const FetiParameters               &parameters,
            RunContext                         &context);

  /// Take new matrices from the systems; set_loads() must follow, which
  /// brings the preconditioner. Collective.
  /// @param[in] changed subdomains of this rank whose K and R changed.
  void update(const std::vector<bool> &changed);

  /// Whether find_soft_modes() is still to be called: it is wanted, and has work.
  bool misses_soft_modes() const { return !knows_soft_modes; }

  /**
   * Find the soft modes of the subdomains with their present matrices; the
   * coarse vectors of PCPG are theirs from now on, whatever the matrices.
   * Collective.
   */
  void find_soft_modes();

  /// Take the loads f from the systems. Collective.
  /// @param[in] g right-hand side of the owned rows [length].
  /// @throws SolveError if no contact forces balance them: names the body
  ///   that escapes, and its motion.
  void set_loads(const qp::MultiVector &g);

  RunContext            &context() const override { return run; }
  unsigned int           n_owned() const override { return layout.n_owned(); }
  const qp::RowSet      &bounded() const override { return layout.bounded(); }
  const qp::MultiVector &d() const override { return dual_load; }
  const qp::MultiVector &e() const override { return rigid_load; }
  /// (B D^{-1} B')_ii with D = diag K: the compliance of the row's
  /// unknowns with their neighbours held.
  /// Often far below F_ii, as the neighbours of the unknowns are held: a thousandth of it where
  /// Poisson's ratio is 0.4999.
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
  /// ||G||. Collective.
  double                       coarse_norm() const { return coarse.norm(); }
  std::unique_ptr<qp::FreeSet> free_set(const qp::RowSet &free) const override;

  qp::RowSet expected_rows() const override { return expected; }

  /// The guess until the next set_loads(), which takes it back to all rows.
  void expect(const qp::RowSet &rows) { expected = rows; }

  /// One line for each body that the equality rows and those of @p rows
  /// leave free to move, with its motions. Collective.
  std::vector<std::string> free_bodies(const qp::RowSet &rows) const;

  /// B v of primal vectors, owned rows. Collective.
  qp::MultiVector multiply_B(const PrimalVectors &v) const;

  /// B' lambda. Collective.
  PrimalVectors multiply_Bt(const qp::MultiVector &lambda) const;

  /// K^+ applied to primal vectors.
  PrimalVectors apply_inverse(const PrimalVectors &right_hand_side) const;

  /// R' b of primal vectors, n_kernel x k on all ranks. Collective.
  qp::MultiVector rigid_part(const PrimalVectors &b) const;

  /// max_s || |R_s|' |b_s| || of every column: what the rounding of the rigid
  /// part is measured by, however much of it cancels. Collective.
  std::vector<double> gross_rigid_part(const PrimalVectors &b) const;

  /// u = K^+ (b - B' lambda) + R alpha. Collective.
  PrimalVectors
  recover(PrimalVectors b, const qp::MultiVector &lambda, const qp::MultiVector &alpha) const;

  /**
   * Of the motions that the rows @p loaded leave free (equality rows and
   * contacts with a force) take the least: u += R d and @p alpha += d, so that
   * R'u has the least part in them that keeps the other contacts from
   * closing further. Collective.
   */
  void settle(const qp::RowSet &loaded, PrimalVectors &u, qp::MultiVector &alpha) const;

  /// The loads f of the systems.
  PrimalVectors loads() const;

  const qp::MultiVector &g() const { return gap; }

  const std::vector<SubdomainSystem> &subdomains() const { return systems; }

  unsigned int n_bodies() const
  {
    return narrow<unsigned int>(coarse.subdomains().body_names.size());
  }

  /// Rows of G: rigid modes of all subdomains.
  unsigned int n_kernel() const { return coarse.n_kernel(); }

private:
  class FetiFreeSet;

  /// Numbers that gather_entries() has for each.
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
  /// B D^{-1} of each subdomain on the boundary positions of its schur
  std::vector<std::vector<BEntry>> weighted_B;
  std::vector<bool>                outdated; ///< preconditioners of subdomains
  bool                             knows_soft_modes = true;
  std::unique_ptr<Deflation>       deflation; ///< null: not wanted, or no mode is soft
  bool                             deflation_outdated = false;
  qp::MultiVector                  gap, dual_load, rigid_load;
  double                           gross_load = 0.;
  std::vector<double>              F_diagonal;
  qp::RowSet                       expected;
};
} // namespace snug::feti

#endif
