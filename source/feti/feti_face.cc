#include <snug/feti/feti_face.h>

namespace snug::feti {
TotalFeti::FetiFace::FetiFace(const TotalFeti &feti, const qp::RowSet &free)
  : feti(feti), free(free)
{}

const qp::RowSet &TotalFeti::FetiFace::rows() const
{
  return free;
}

const CoarseProblem &TotalFeti::FetiFace::coarse_problem() const
{
  if (!problem)
    problem = std::make_unique<CoarseProblem>(feti.coarse, free);
  return *problem;
}

void TotalFeti::FetiFace::restrict(qp::MultiVector &x) const
{
  for (unsigned int k = 0; k < x.n_columns(); ++k)
    for (unsigned int row = 0; row < x.n_rows(); ++row)
      if (!free[row])
        x(row, k) = 0.;
}

qp::MultiVector TotalFeti::FetiFace::amplitudes(const qp::MultiVector &x) const
{
  feti.run.work.coarse_solves += x.n_columns();
  return coarse_problem().solve(feti.coarse.multiply(x, &free));
}

void TotalFeti::FetiFace::project(qp::MultiVector &x) const
{
  const qp::MultiVector alpha = amplitudes(x);
  restrict(x);
  x.add(-1., feti.coarse.transpose_multiply(alpha, &free));
}

qp::MultiVector TotalFeti::FetiFace::precondition(const qp::MultiVector &r) const
{
  qp::MultiVector z = r;
  if (feti.schur.empty() && feti.parameters.preconditioner == "none")
    {
      restrict(z);
      return z;
    }
  feti.run.work.preconditioner_applications += r.n_columns();
  // dependent contact rows show on the rank that owns them alone
  if (!gram)
    everywhere(feti.run.communicator(),
               [&]() { gram = std::make_unique<RowGram::Factor>(feti.gram, free); });
  gram->solve(z);
  feti.precondition(z);
  gram->solve(z);
  return z;
}

std::vector<double> TotalFeti::FetiFace::make_feasible(qp::MultiVector       &x,
                                                       const qp::MultiVector &e) const
{
  restrict(x);
  qp::MultiVector missing = e;
  missing.add(-1., feti.coarse.multiply(x, &free));
  feti.run.work.coarse_solves += x.n_columns();
  x.add(1., feti.coarse.transpose_multiply(coarse_problem().solve(missing), &free));
  missing = e;
  missing.add(-1., feti.coarse.multiply(x, &free));
  return qp::norms(missing, MPI_COMM_SELF);
}

std::vector<double> TotalFeti::FetiFace::closing_rates(const qp::MultiVector &e) const
{
  const qp::MultiVector rates =
    feti.coarse.transpose_multiply(coarse_problem().kernel_part(e), nullptr);
  return std::vector<double>(rates.column(0), rates.column(0) + rates.n_rows());
}

std::unique_ptr<qp::Face> TotalFeti::face(const qp::RowSet &free_rows) const
{
  return std::make_unique<FetiFace>(*this, free_rows);
}
} // namespace snug::feti
