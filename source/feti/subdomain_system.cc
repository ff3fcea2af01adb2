#include <snug/feti/subdomain_system.h>

namespace snug::feti {
void add_product(const std::vector<BEntry> &B, const qp::MultiVector &x, qp::MultiVector &y)
{
  for (unsigned int j = 0; j < x.n_columns(); ++j)
    {
      const double *from = x.column(j);
      double       *to   = y.column(j);
      for (const BEntry &entry : B)
        to[entry.row] += entry.value * from[entry.dof];
    }
}

void add_transposed(const std::vector<BEntry> &B, const qp::MultiVector &x, qp::MultiVector &y)
{
  for (unsigned int j = 0; j < x.n_columns(); ++j)
    {
      const double *from = x.column(j);
      double       *to   = y.column(j);
      for (const BEntry &entry : B)
        to[entry.dof] += entry.value * from[entry.row];
    }
}
} // namespace snug::feti
