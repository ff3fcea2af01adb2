#include <snug/base/narrow.h>
#include <snug/feti/generalized_inverse.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <cmath>

namespace snug::feti {
namespace {
/// Unit to which entries of orthonormal modes are rounded. The differences between congruent
/// subdomains are far smaller.
const double step_of_modes = 0x1p-26;

/// Return K with explicit zeros at pairs of fixing unknowns that K does not couple.
CsrMatrix with_coupled(const CsrMatrix &K, const std::vector<unsigned int> &fixing_dofs)
{
  CsrPattern          pattern;
  std::vector<double> values;
  const std::size_t   most =
    K.columns().size() + std::size_t(fixing_dofs.size()) * fixing_dofs.size();
  pattern.n_rows = pattern.n_columns = K.n_rows();
  pattern.row_start.reserve(K.n_rows() + 1);
  pattern.columns.reserve(most);
  values.reserve(most);
  auto fixing = fixing_dofs.begin();
  for (unsigned int i = 0; i < K.n_rows(); ++i)
    {
      const bool is_fixing = fixing != fixing_dofs.end() && *fixing == i;
      auto       j         = is_fixing ? fixing_dofs.begin() : fixing_dofs.end();
      for (PetscInt p = K.row_start()[i]; p < K.row_start()[i + 1]; ++p)
        {
          for (; j != fixing_dofs.end() && PetscInt(*j) <= K.columns()[p]; ++j)
            if (PetscInt(*j) < K.columns()[p])
              {
                pattern.columns.push_back(narrow<PetscInt>(*j));
                values.push_back(0.);
              }
          pattern.columns.push_back(K.columns()[p]);
          values.push_back(K.values[p]);
        }
      for (; j != fixing_dofs.end(); ++j)
        {
          pattern.columns.push_back(narrow<PetscInt>(*j));
          values.push_back(0.);
        }
      fixing += is_fixing;
      pattern.row_start.push_back(narrow<PetscInt>(pattern.columns.size()));
    }
  return {std::make_shared<const CsrPattern>(std::move(pattern)), std::move(values)};
}

/// Return the rows of the orthonormal R at the fixing unknowns, rounded.
qp::MultiVector rounded_rows(const qp::MultiVector &R, const std::vector<unsigned int> &dofs)
{
  qp::MultiVector rows = rows_of(R, dofs);
  for (unsigned int j = 0; j < rows.n_columns(); ++j)
    for (unsigned int i = 0; i < rows.n_rows(); ++i)
      // Adding 0 turns -0 into +0, because their bits differ.
      rows(i, j) = std::round(rows(i, j) / step_of_modes) * step_of_modes + 0.;
  return rows;
}
} // namespace

void fix_kernel(CsrMatrix &A, const std::vector<unsigned int> &f, const qp::MultiVector &rows)
{
  const double mean = A.mean_diagonal();
  fix_kernel(A, f, rows, mean > 0. ? mean : 1.);
}

void fix_kernel(CsrMatrix                       &A,
                const std::vector<unsigned int> &f,
                const qp::MultiVector           &rows,
                const double                     rho)
{
  const auto n = rows.n_rows(), r = rows.n_columns();
  if (r == 0)
    return;
  dealii::LAPACKFullMatrix<double> N_f(n, r), N_f_transposed(r, n), gram(r, r), Q(n, n);
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < r; ++j)
      N_f(i, j) = N_f_transposed(j, i) = rows(i, j);
  // N_f'N_f is regular only if every rigid motion moves a fixing node: in space, three or more
  // nodes that are not on one line. Fixing nodes close to each other make N_f'N_f and A ill
  // conditioned.
  N_f.Tmmult(gram, N_f);
  gram.set_property(dealii::LAPACKSupport::symmetric);
  gram.compute_cholesky_factorization();
  gram.solve(N_f_transposed);
  N_f.mmult(Q, N_f_transposed);
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n; ++j)
      A.values[A.position(f[i], f[j])] += rho * Q(i, j);
}

GeneralizedInverse::GeneralizedInverse(const SubdomainSystem &system,
                                       const FactorPool      &factors,
                                       RunContext            &the_context,
                                       const std::string     &what)
  : context(the_context)
{
  if (system.is_rigid())
    return; // K^+ = 0
  auto K_rho = with_coupled(system.K, system.fixing_dofs);
  fix_kernel(K_rho, system.fixing_dofs, rounded_rows(system.R, system.fixing_dofs));
  factor = factors.factorize(K_rho, what);
}

void GeneralizedInverse::apply(const qp::MultiVector &b, qp::MultiVector &x) const
{
  // Skip the solve for zero loads: most subdomains carry no load.
  const bool is_zero = !factor || std::all_of(b.column(0), b.column(b.n_columns()),
                                              [](const double value) { return value == 0.; });
  if (is_zero)
    {
      std::fill(x.column(0), x.column(x.n_columns()), 0.);
      return;
    }
  context.work.subdomain_solves += b.n_columns();
  const AddedSeconds timer(context.work.subdomain_solve_seconds);
  factor->solve(b, x);
}
} // namespace snug::feti
