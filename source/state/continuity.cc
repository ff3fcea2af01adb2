#include <snug/state/continuity.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace snug::state {
std::vector<double> energy_norms(const feti::LoadedProblem &feti, const feti::PrimalVectors &u)
{
  // A rank may have no subdomain, so take the number of columns from all ranks.
  const unsigned int  n = u.n_columns();
  std::vector<double> squares(dealii::Utilities::MPI::max(n, feti.context().communicator()), 0.);
  for (unsigned int s = 0; s < u.size(); ++s)
    {
      qp::MultiVector Ku(u[s].n_rows(), n);
      feti.linearization().subdomains()[s].K.multiply_add(1., u[s], Ku);
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < Ku.n_rows(); ++i)
          squares[j] += u[s](i, j) * Ku(i, j);
    }
  MPI_Allreduce(MPI_IN_PLACE, squares.data(), squares.size(), MPI_DOUBLE, MPI_SUM,
                feti.context().communicator());
  for (double &square : squares)
    square = std::sqrt(std::max(0., square));
  return squares;
}

void make_continuous(const feti::LoadedProblem &feti,
                     const qp::MultiVector     *g,
                     feti::PrimalVectors       &u)
{
  auto jumps = feti.linearization().multiply_B(u);
  if (g)
    jumps.add(-1., *g);
  for (unsigned int i = 0; i < jumps.n_rows(); ++i)
    // Springs have a length of their own.
    if (feti.linearization().contact_rows()[i] || feti.linearization().compliance(i) > 0.)
      for (unsigned int j = 0; j < jumps.n_columns(); ++j)
        jumps(i, j) = 0.;
  u.add(-1., feti.linearization().multiply_Bt(jumps));
}
} // namespace snug::state
