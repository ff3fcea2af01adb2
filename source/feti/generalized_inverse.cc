#include <snug/base/narrow.h>
#include <snug/feti/generalized_inverse.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>

namespace snug::feti {
namespace {
/// Pattern of K with all fixing unknowns coupled to each other.
CsrMatrix coupled_pattern(const SubdomainSystem &system)
{
  std::vector<std::vector<PetscInt>> rows(system.n_dofs());
  const CsrMatrix                   &K = system.K;
  for (unsigned int i = 0; i < system.n_dofs(); ++i)
    rows[i].assign(K.columns.begin() + K.row_start[i], K.columns.begin() + K.row_start[i + 1]);
  for (const unsigned int i : system.fixing_dofs)
    {
      rows[i].insert(rows[i].end(), system.fixing_dofs.begin(), system.fixing_dofs.end());
      std::sort(rows[i].begin(), rows[i].end());
      rows[i].erase(std::unique(rows[i].begin(), rows[i].end()), rows[i].end());
    }
  return CsrMatrix::from_rows(rows, system.n_dofs());
}
} // namespace

void fix_kernel(CsrMatrix &A, const std::vector<unsigned int> &f, const qp::MultiVector &N)
{
  const auto n = narrow<unsigned int>(f.size()), r = N.n_columns();
  if (r == 0)
    return;
  // The mean of diag A is of the size of A: a much smaller rho loses digits of A^+, a much larger
  // one worsens the condition number. Neither changes A A^+ A = A. A is zero, and any rho will do,
  // where no row is left: bodies in one piece that nothing holds or touches.
  const double                     mean = A.mean_diagonal(), rho = mean > 0. ? mean : 1.;
  dealii::LAPACKFullMatrix<double> N_f(n, r), N_f_transposed(r, n), gram(r, r), Q(n, n);
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < r; ++j)
      N_f(i, j) = N_f_transposed(j, i) = N(f[i], j);
  // N_f'N_f is regular only if no motion leaves the fixing nodes in place: in space, three or more
  // of them not on one line. Nodes close to each other make it, and A, ill conditioned.
  N_f.Tmmult(gram, N_f);
  gram.set_property(dealii::LAPACKSupport::symmetric);
  gram.compute_cholesky_factorization();
  gram.solve(N_f_transposed);
  N_f.mmult(Q, N_f_transposed);
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n; ++j)
      A.values[A.position(f[i], f[j])] += rho * Q(i, j);
}

GeneralizedInverse::GeneralizedInverse(const SubdomainSystem &the_system,
                                       const Factorization    package,
                                       FillOrderings         &orderings,
                                       RunContext            &the_context)
  : system(the_system), context(the_context), K_rho(coupled_pattern(the_system))
{
  const CsrMatrix &K = system.K;
  // Where each value of K goes in K_rho is the same for all designs: looked up once.
  for (unsigned int i = 0; i < system.n_dofs(); ++i)
    for (PetscInt p = K.row_start[i]; p < K.row_start[i + 1]; ++p)
      place_of_K.push_back(K_rho.position(i, K.columns[p]));
  factor = std::make_unique<SparseFactor>(K_rho, FactorOf::kplus, package, &orderings);
  ++context.work.symbolic_factorizations;
}

void GeneralizedInverse::factorize(const std::string &what)
{
  std::fill(K_rho.values.begin(), K_rho.values.end(), 0.);
  for (std::size_t p = 0; p < place_of_K.size(); ++p)
    K_rho.values[place_of_K[p]] = system.K.values[p];
  fix_kernel(K_rho, system.fixing_dofs, system.R);
  factor->factorize(what);
  ++context.work.numeric_factorizations;
}

void GeneralizedInverse::apply(const qp::MultiVector &b, qp::MultiVector &x) const
{
  context.work.subdomain_solves += b.n_columns();
  factor->solve(b, x);
}
} // namespace snug::feti
