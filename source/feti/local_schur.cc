#include <snug/base/narrow.h>
#include <snug/feti/local_schur.h>
#include <snug/qp/direction_basis.h>

#include <algorithm>

namespace snug::feti {
namespace {
/// A rigid motion leaves the boundary at rest if the squared singular value of R on the boundary is
/// below this value, relative to the longest column of the Gram matrix.
const double rank_cut = 1e-12;
} // namespace

LocalSchur::LocalSchur(const SubdomainSystem &system,
                       const bool             lumped,
                       const FactorCache     &cache,
                       const std::string     &what)
  : context(cache.context)
{
  std::vector<bool> in_boundary(system.n_dofs(), false);
  for (const unsigned int dof : system.boundary)
    in_boundary[dof] = true;
  number(in_boundary);
  if (!boundary_holds(system.R))
    {
      for (const unsigned int dof : system.fixing_dofs)
        in_boundary[dof] = true;
      number(in_boundary);
    }
  bb = cache.patterns.of(extract(system.K, true, true));
  if (lumped)
    return;
  ib = cache.patterns.of(extract(system.K, false, true));
  if (n_i > 0)
    factor = cache.interiors.factorize(extract(system.K, false, false), what);
}

/// Number the unknowns of b and the others.
void LocalSchur::number(const std::vector<bool> &in_boundary)
{
  const auto n = narrow<unsigned int>(in_boundary.size());
  n_i          = narrow<unsigned int>(std::count(in_boundary.begin(), in_boundary.end(), false));
  n_b          = n - n_i;
  position_b.assign(n, n_b);
  position_i.assign(n, n);
  unsigned int b = 0, i = 0;
  for (unsigned int dof = 0; dof < n; ++dof)
    if (in_boundary[dof])
      position_b[dof] = b++;
    else
      position_i[dof] = i++;
}

/// Return whether every rigid motion moves b. Otherwise K_ii would be singular. The number of
/// unknowns in b does not decide this: contact rows along one axis leave the other directions free,
/// and two nodes leave a rotation free.
bool LocalSchur::boundary_holds(const qp::MultiVector &R) const
{
  const auto R_b = on_boundary(R, *this);
  // The Gram matrix is at most 6 x 6. The singular vectors of R_b would have as many rows as b.
  const auto gram    = transpose_times(R_b, R_b);
  const auto lengths = norms(gram, MPI_COMM_SELF);
  const auto longest = *std::max_element(lengths.begin(), lengths.end());
  return qp::null_space(gram, rank_cut * longest).n_columns() == 0;
}

CsrMatrix LocalSchur::extract(const CsrMatrix &K,
                              const bool       rows_on_boundary,
                              const bool       columns_on_boundary) const
{
  CsrPattern          pattern;
  std::vector<double> values;
  pattern.n_rows    = rows_on_boundary ? n_b : n_i;
  pattern.n_columns = columns_on_boundary ? n_b : n_i;
  for (unsigned int i = 0; i < K.n_rows(); ++i)
    {
      if ((position_b[i] < n_b) != rows_on_boundary)
        continue;
      for (PetscInt p = K.row_start()[i]; p < K.row_start()[i + 1]; ++p)
        {
          const PetscInt j = K.columns()[p];
          if ((position_b[j] < n_b) != columns_on_boundary)
            continue;
          if (rows_on_boundary && j > PetscInt(i))
            continue; // see CsrMatrix::add_symmetric_product()
          pattern.columns.push_back(
            narrow<PetscInt>(columns_on_boundary ? position_b[j] : position_i[j]));
          values.push_back(K.values[p]);
        }
      pattern.row_start.push_back(narrow<PetscInt>(pattern.columns.size()));
    }
  // Both arrays are kept, so release their unused memory.
  pattern.columns.shrink_to_fit();
  values.shrink_to_fit();
  return {std::make_shared<const CsrPattern>(std::move(pattern)), std::move(values)};
}

qp::MultiVector LocalSchur::apply(const qp::MultiVector &x) const
{
  qp::MultiVector y(n_b, x.n_columns());
  if (bb.columns().empty())
    return y; // K = 0
  bb.add_symmetric_product(x, y);
  if (!factor)
    return y;
  qp::MultiVector load(n_i, x.n_columns()), inner(n_i, x.n_columns());
  ib.multiply_add(1., x, load);
  context.work.subdomain_solves += x.n_columns();
  const AddedSeconds timer(context.work.subdomain_solve_seconds);
  factor->solve(load, inner);
  ib.transpose_multiply_add(-1., inner, y);
  return y;
}

qp::MultiVector on_boundary(const qp::MultiVector &x, const LocalSchur &schur)
{
  qp::MultiVector result(schur.n_boundary(), x.n_columns());
  const auto     &position = schur.boundary_position();
  for (unsigned int k = 0; k < x.n_columns(); ++k)
    for (unsigned int i = 0; i < x.n_rows(); ++i)
      if (position[i] < schur.n_boundary())
        result(position[i], k) = x(i, k);
  return result;
}
} // namespace snug::feti
