#ifndef snug_sensitivity_sensitivity_qp_h
#define snug_sensitivity_sensitivity_qp_h

#include <snug/feti/loaded_problem.h>
#include <snug/sensitivity/kkt_vectors.h>

namespace snug::sensitivity {
/**
 * The dual of equation (14) of Vondrák, Kozubek, Dostál in one direction: the
 * derivative (z, mu) of a state solves
 * @f[ \min_z \tfrac12 z^T K z - \tilde f^T z \quad\text{s.t.}\quad
 *     B_E z = \tilde c_E,\ B_s z = \tilde c_s,\ B_w z \le \tilde c_w, @f]
 * where s are the strongly active contacts and w the weakly active ones. The rows
 * of all other contacts are absent. The problem has the operator, the coarse space
 * and the factorizations of the state's problem, restricted to the rows E, s and w,
 * with mu_w >= 0.
 */
class SensitivityQp : public qp::DualProblem
{
public:
  /**
   * @param[in] feti the dual problem of the state; must outlive this.
   * @param[in] strong equality and strongly active rows.
   * @param[in] weak weakly active rows.
   * @param[in] data ft and ct, one column.
   * Collective.
   */
  SensitivityQp(const feti::LoadedProblem &feti,
                const qp::RowSet          &strong,
                const qp::RowSet          &weak,
                const KktVectors          &data);

  /// Return the entries of @p x at the rows of this problem. @p x has the rows of
  /// the state's problem.
  qp::MultiVector restricted(const qp::MultiVector &x) const;
  /// Return @p x on the rows of the state's problem, with zeros at the absent rows.
  qp::MultiVector extended(const qp::MultiVector &x) const;

  RunContext                &context() const override { return feti.context(); }
  unsigned int               n_owned() const override { return row.size(); }
  const qp::RowSet          &bounded() const override { return is_weak; }
  const qp::MultiVector     &d() const override { return dual_load; }
  const qp::MultiVector     &e() const override { return rigid_load; }
  const std::vector<double> &diagonal() const override { return F_diagonal; }
  qp::MultiVector            apply(const qp::MultiVector &x) const override
  {
    return restricted(feti.apply(extended(x)));
  }
  qp::MultiVector apply_G(const qp::MultiVector &x) const override
  {
    return feti.apply_G(extended(x));
  }
  qp::MultiVector apply_Gt(const qp::MultiVector &alpha) const override
  {
    return restricted(feti.apply_Gt(alpha));
  }
  double feasibility_scale(double force) const override
  {
    return gross_load + feti.linearization().coarse().norm() * force;
  }
  std::unique_ptr<qp::FreeSet> free_set(const qp::FreeRows &free) const override;

private:
  class PartOfFreeSet;

  const feti::LoadedProblem &feti;
  std::vector<unsigned int>  row; ///< row of the state's problem
  qp::RowSet                 is_weak;
  std::vector<double>        F_diagonal;
  qp::MultiVector            dual_load, rigid_load;
  double                     gross_load;
};
} // namespace snug::sensitivity

#endif
