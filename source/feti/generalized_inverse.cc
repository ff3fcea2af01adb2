#include <snug/base/narrow.h>
#include <snug/feti/dense.h>
#include <snug/feti/generalized_inverse.h>

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

GeneralizedInverse::GeneralizedInverse(const SubdomainSystem &the_system,
                                       const std::string     &package,
                                       RunContext            &the_context)
  : system(the_system), context(the_context), K_rho(coupled_pattern(the_system))
{
  const CsrMatrix &K = system.K;
  // Where each value of K goes in K_rho is the same for all designs: looked up once.
  for (unsigned int i = 0; i < system.n_dofs(); ++i)
    for (PetscInt p = K.row_start[i]; p < K.row_start[i + 1]; ++p)
      place_of_K.push_back(K_rho.position(i, K.columns[p]));
  for (const unsigned int i : system.fixing_dofs)
    for (const unsigned int j : system.fixing_dofs)
      place_of_fixing.push_back(K_rho.position(i, j));
  factor = std::make_unique<SparseFactor>(K_rho, package);
  ++context.work.symbolic_factorizations;
}

void GeneralizedInverse::factorize(const std::string &what)
{
  const auto        &fixing = system.fixing_dofs;
  const unsigned int n_fix = narrow<unsigned int>(fixing.size()), n_modes = system.R.n_columns();
  qp::MultiVector    R_f_transposed(n_modes, n_fix);
  for (unsigned int i = 0; i < n_fix; ++i)
    for (unsigned int mode = 0; mode < n_modes; ++mode)
      R_f_transposed(mode, i) = system.R(fixing[i], mode);
  // R_f'R_f is regular only if no rigid motion leaves the fixing nodes in place: in space, three or
  // more of them not on one line. Nodes close to each other make it, and K_rho, ill conditioned.
  qp::MultiVector gram(n_modes, n_modes);
  for (unsigned int a = 0; a < n_modes; ++a)
    for (unsigned int b = 0; b < n_modes; ++b)
      for (unsigned int i = 0; i < n_fix; ++i)
        gram(a, b) += R_f_transposed(a, i) * R_f_transposed(b, i);
  const auto Q = dense::transpose_product(R_f_transposed, dense::solve_spd(gram, R_f_transposed));
  // The mean of diag K is of the size of K: a much smaller rho loses digits of K^+, a much larger
  // one worsens the condition number. Neither changes K K^+ K = K.
  double rho = 0.;
  for (unsigned int i = 0; i < system.n_dofs(); ++i)
    rho += system.K.diagonal(i) / system.n_dofs();

  std::fill(K_rho.values.begin(), K_rho.values.end(), 0.);
  for (std::size_t p = 0; p < place_of_K.size(); ++p)
    K_rho.values[place_of_K[p]] = system.K.values[p];
  for (unsigned int i = 0; i < n_fix; ++i)
    for (unsigned int j = 0; j < n_fix; ++j)
      K_rho.values[place_of_fixing[i * n_fix + j]] += rho * Q(i, j);
  factor->factorize(what);
  ++context.work.numeric_factorizations;
}

void GeneralizedInverse::apply(const qp::MultiVector &b, qp::MultiVector &x) const
{
  factor->solve(b, x);
}
} // namespace snug::feti
