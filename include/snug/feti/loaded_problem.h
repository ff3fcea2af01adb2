#ifndef snug_feti_loaded_problem_h
#define snug_feti_loaded_problem_h

#include <snug/feti/linearization.h>

namespace snug::feti {
/// Pairs of the contact rows.
struct ContactPairs
{
  std::vector<unsigned int> of_row; ///< pair of each owned row, n for equality rows
  unsigned int              n = 0;
  unsigned int              dim; ///< of the space in which the pairs lie
};

/**
 * This class is the dual problem of Total FETI for the loads f and the gaps g at a linearization,
 * @f[ d = B K^+ f - g,\quad e = R^T f, @f]
 * with the active set from which a solver begins.
 */
class LoadedProblem : public qp::DualProblem
{
public:
  /**
   * Compute d and e. This costs a solve with each subdomain, but no F-mult. @p linearization and
   * @p f must outlive this object. Collective.
   * @param[in] g right-hand side of the owned rows [length].
   * @param[in] pairs for initial_active_set(); null: the active set begins with all rows.
   * @param[in] cones of the contacts with friction, one per contact.
   * @throws SolveError if no contact forces within the cones balance the loads. The error names the
   * body that escapes and its motion. Bounds of Tresca friction are not checked here.
   */
  LoadedProblem(const Linearization &linearization,
                const PrimalVectors &f,
                qp::MultiVector      g,
                const ContactPairs  *pairs = nullptr,
                qp::FrictionCones    cones = {});

  const Linearization &linearization() const { return linear; }
  const PrimalVectors &loads() const { return f; }

  const qp::MultiVector &g() const { return gap; }

  RunContext                &context() const override { return linear.context(); }
  unsigned int               n_owned() const override { return linear.n_owned(); }
  const qp::RowSet          &bounded() const override { return normal_rows; }
  const qp::FrictionCones   &cones() const override { return friction; }
  const qp::MultiVector     &d() const override { return dual_load; }
  const qp::MultiVector     &e() const override { return rigid_load; }
  const std::vector<double> &diagonal() const override { return linear.diagonal(); }
  qp::MultiVector apply(const qp::MultiVector &x) const override { return linear.apply(x); }
  qp::MultiVector apply_G(const qp::MultiVector &x) const override
  {
    return linear.coarse().multiply(x);
  }
  qp::MultiVector apply_Gt(const qp::MultiVector &alpha) const override
  {
    return linear.coarse().transpose_multiply(alpha);
  }
  double feasibility_scale(double force) const override
  {
    return gross_load + linear.coarse().norm() * force;
  }
  std::unique_ptr<qp::FreeSet> free_set(const qp::FreeRows &free) const override
  {
    return linear.free_set(free);
  }
  std::string describe_motion(const qp::MultiVector &v) const override;
  qp::RowSet  initial_active_set() const override { return initial; }

  /**
   * Move the bodies along the motions that the rows @p loaded leave free: u += R d and @p alpha +=
   * d. @p loaded are the equality rows and the contacts with a force. d is chosen such that the
   * part of R'u in these motions has minimum norm, among the d that keep the other contacts from
   * closing further. Collective.
   */
  void add_minimal_rigid_motion(const qp::RowSet &loaded,
                                PrimalVectors    &u,
                                qp::MultiVector  &alpha) const;

private:
  void check_equilibrium() const;

  const Linearization &linear;
  const PrimalVectors &f;
  qp::MultiVector      gap, rigid_load, dual_load;
  double               gross_load; ///< see gross_rigid_part()
  qp::FrictionCones    friction;
  qp::RowSet           normal_rows, initial;
};

/// Return one line for each body that the equality rows and the contacts in @p rows leave free to
/// move, with the motions of the body. Collective.
std::vector<std::string> free_bodies(const Linearization &linearization, const qp::RowSet &rows);
} // namespace snug::feti

#endif
