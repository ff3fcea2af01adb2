#ifndef snug_feti_feti_free_set_h
#define snug_feti_feti_free_set_h

#include <snug/feti/coarse_problem.h>
#include <snug/feti/linearization.h>

namespace snug::feti {
/// This class is a face of the dual problem of Total FETI. Its parts are made at their first use.
class Linearization::FetiFreeSet : public qp::FreeSet
{
public:
  FetiFreeSet(const Linearization &feti, const qp::RowSet &free);

  const qp::RowSet   &rows() const override;
  void                project(qp::MultiVector &x) const override;
  std::vector<double> deflate(qp::MultiVector &x) const override;
  void minimize_over_deflated(qp::MultiVector &lambda, qp::MultiVector &residual) const override;
  qp::MultiVector     precondition(const qp::MultiVector &r) const override;
  qp::MultiVector     amplitudes(const qp::MultiVector &x) const override;
  std::vector<double> make_feasible(qp::MultiVector &x, const qp::MultiVector &e) const override;
  std::vector<double> gap_closing_rates(const qp::MultiVector &e) const override;

private:
  const CoarseProblem &coarse_problem() const;
  void restrict(qp::MultiVector &x) const;
  void subtract_rigid_part(qp::MultiVector &x, qp::MultiVector &alpha) const;

  const Linearization                     &feti;
  qp::RowSet                               free;
  mutable std::unique_ptr<CoarseProblem>   problem;
  mutable std::unique_ptr<RowGram::Factor> gram;
};
} // namespace snug::feti

#endif
