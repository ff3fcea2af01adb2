#include <snug/sensitivity/sensitivity_qp.h>

namespace snug::sensitivity {
/// A face of the state's problem in terms of the rows of the sensitivity problem.
class SensitivityQp::PartOfFreeSet : public qp::FreeSet
{
public:
  PartOfFreeSet(const SensitivityQp &problem, const qp::FreeRows &free)
    : problem(problem), free(free)
  {
    qp::RowSet of_all(problem.feti.n_owned(), 0);
    for (unsigned int i = 0; i < free.rows().size(); ++i)
      of_all[problem.row[i]] = free.rows()[i];
    whole = problem.feti.free_set(of_all);
  }

  const qp::FreeRows &free_rows() const override { return free; }

  bool has_slips() const override { return whole->has_slips(); }

  void project(qp::MultiVector &x) const override
  {
    auto all = problem.extended(x);
    whole->project(all);
    x = problem.restricted(all);
  }

  qp::MultiVector precondition(const qp::MultiVector &r) const override
  {
    return problem.restricted(whole->precondition(problem.extended(r)));
  }

  qp::MultiVector amplitudes(const qp::MultiVector &x) const override
  {
    return whole->amplitudes(problem.extended(x));
  }

  std::vector<double> make_feasible(qp::MultiVector &x, const qp::MultiVector &e) const override
  {
    auto all  = problem.extended(x);
    auto left = whole->make_feasible(all, e);
    x         = problem.restricted(all);
    return left;
  }

  const qp::MultiVector &unresisted_motions() const override { return whole->unresisted_motions(); }

private:
  const SensitivityQp         &problem;
  const qp::FreeRows           free;
  std::unique_ptr<qp::FreeSet> whole;
};

SensitivityQp::SensitivityQp(const feti::LoadedProblem &feti,
                             const qp::RowSet          &strong,
                             const qp::RowSet          &weak,
                             const KktVectors          &data)
  : feti(feti)
{
  for (unsigned int i = 0; i < feti.n_owned(); ++i)
    if (strong[i] || weak[i])
      {
        row.push_back(i);
        is_weak.push_back(weak[i]);
        F_diagonal.push_back(feti.diagonal()[i]);
      }
  auto d = feti.linearization().multiply_B(feti.linearization().apply_inverse(data.primal));
  d.add(-1., data.dual);
  dual_load  = restricted(d);
  rigid_load = feti.linearization().rigid_part(data.primal);
  gross_load = feti.linearization().gross_rigid_part(data.primal)[0];
}

qp::MultiVector SensitivityQp::restricted(const qp::MultiVector &x) const
{
  qp::MultiVector part(row.size(), x.n_columns());
  for (unsigned int j = 0; j < x.n_columns(); ++j)
    for (unsigned int i = 0; i < row.size(); ++i)
      part(i, j) = x(row[i], j);
  return part;
}

qp::MultiVector SensitivityQp::extended(const qp::MultiVector &x) const
{
  qp::MultiVector all(feti.n_owned(), x.n_columns());
  for (unsigned int j = 0; j < x.n_columns(); ++j)
    for (unsigned int i = 0; i < row.size(); ++i)
      all(row[i], j) = x(i, j);
  return all;
}

std::unique_ptr<qp::FreeSet> SensitivityQp::free_set(const qp::FreeRows &free) const
{
  return std::make_unique<PartOfFreeSet>(*this, free);
}
} // namespace snug::sensitivity
