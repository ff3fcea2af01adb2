#include <snug/sensitivity/kkt_vectors.h>

#include <algorithm>

namespace snug::sensitivity {
qp::MultiVector products(const KktVectors &x, const KktVectors &y, MPI_Comm comm)
{
  auto       sum = qp::inner_products(x.dual, y.dual, MPI_COMM_SELF);
  const auto n   = std::min(x.primal.size(), y.primal.size());
  for (unsigned int s = 0; s < n; ++s)
    sum.add(1., qp::inner_products(x.primal[s], y.primal[s], MPI_COMM_SELF));
  if (x.given.n_columns() > 0 && y.given.n_columns() > 0)
    sum.add(1., qp::inner_products(x.given, y.given, MPI_COMM_SELF));
  MPI_Allreduce(MPI_IN_PLACE, sum.column(0), sum.n_rows() * sum.n_columns(), MPI_DOUBLE, MPI_SUM,
                comm);
  return sum;
}

void add_row(const qp::MultiVector &products, unsigned int i, std::vector<double> &values)
{
  for (unsigned int j = 0; j < values.size(); ++j)
    values[j] += products(i, j);
}
} // namespace snug::sensitivity
