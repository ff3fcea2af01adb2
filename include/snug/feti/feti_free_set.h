#ifndef snug_feti_feti_free_set_h
#define snug_feti_feti_free_set_h

#include <snug/feti/coarse_problem.h>
#include <snug/feti/linearization.h>

namespace snug::feti {
/// This class is a face of the dual problem of Total FETI. Its parts are made at their first use.
class Linearization::FetiFreeSet : public qp::FreeSet
{
public:
  FetiFreeSet(const Linearization &feti, const qp::FreeRows &free);

  const qp::FreeRows &free_rows() const override { return free; }

  bool                has_slips() const override { return slides; }
  void                project(qp::MultiVector &x) const override;
  void                project_multipliers(qp::MultiVector &y) const override;
  std::vector<double> deflate(qp::MultiVector &x) const override;
  void minimize_over_deflated(qp::MultiVector &lambda, qp::MultiVector &residual) const override;
  qp::MultiVector        precondition(const qp::MultiVector &r) const override;
  qp::MultiVector        amplitudes(const qp::MultiVector &x) const override;
  std::vector<double>    make_feasible(qp::MultiVector &x, const qp::MultiVector &e) const override;
  const qp::MultiVector &unresisted_motions() const override;

private:
  /// One of the two maps of the free rows, M, with the coarse problem of G M.
  struct Side
  {
    qp::FreeRows                           free; ///< its multipliers are M y
    mutable std::unique_ptr<CoarseProblem> problem;
  };

  const CoarseProblem &coarse_problem(const Side &side) const;
  qp::MultiVector      multiply(const Side &side, qp::MultiVector y) const;
  qp::MultiVector      transpose_multiply(const Side &side, const qp::MultiVector &alpha) const;
  void subtract_rigid_part(const Side &side, qp::MultiVector &x, qp::MultiVector &alpha) const;
  void scale_slips(qp::MultiVector &z) const;
  /// Return the side of the multipliers. Without slips both sides have the same coarse problem.
  const Side &of_multipliers() const { return slides ? multipliers : equations; }

  const Linearization &feti;
  qp::FreeRows         free;
  bool                 slides; ///< whether a contact of any rank slips
  Side                 equations, multipliers;
  mutable bool         is_checked = false; ///< whether the free contact rows are different
};
} // namespace snug::feti

#endif
