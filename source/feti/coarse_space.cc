#include <snug/base/narrow.h>
#include <snug/feti/coarse_space.h>
#include <snug/feti/couplings.h>
#include <snug/qp/direction_basis.h>
#include <snug/qp/packed_columns.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <cmath>

namespace snug::feti {
namespace {
using Columns = qp::PackedColumns;

/// Relative to the mean of diag A: eigenvalues of Z'AZ below are rounding of those of others, of
/// motions that the rows do not see.
const double kernel_cut = 1e-13;

/// Those below, of motions that the rows hardly see, would take too many digits from A^-1.
const double weak_cut = 1e-5;
} // namespace

CoarseSpace::CoarseSpace(const RowLayout      &the_layout,
                         const SubdomainTable &the_table,
                         const unsigned int    n_ranks)
  : layout(the_layout)
  , table(the_table)
  , factor_pool(FactorOf::coarse,
                Factorization::CHOLMOD,
                nullptr,
                nullptr,
                coarse_team(layout.communicator(), n_kernel(), FactorOf::coarse, n_ranks))
{
  // Entries are sorted by subdomain within a row: those of one subdomain make one block of G, the
  // n_modes numbers G(s, row) = R_s' B_s(row, :)'.
  const auto &start    = layout.entry_start();
  const auto &unknowns = layout.entry_unknowns();
  block_start.assign(1, 0);
  for (unsigned int row = 0; row < layout.n_owned(); ++row)
    {
      for (unsigned int e = start[row]; e < start[row + 1]; ++e)
        {
          if (e == start[row] || unknowns[e].first != unknowns[e - 1].first)
            block_subdomain.push_back(unknowns[e].first);
          block_of_entry.push_back(narrow<unsigned int>(block_subdomain.size()) - 1);
        }
      block_start.push_back(narrow<unsigned int>(block_subdomain.size()));
    }
  // A body's first subdomain stands for it: Z_s is regular, so that its n_modes coarse unknowns
  // tell all rigid motions of the body apart.
  const auto n_bodies = narrow<unsigned int>(table.body_names.size());
  for (unsigned int body = 0; body < n_bodies; ++body)
    {
      const auto s = narrow<unsigned int>(std::find(table.body.begin(), table.body.end(), body) -
                                          table.body.begin());
      for (unsigned int mode = 0; mode < table.n_modes; ++mode)
        representative.push_back(s * table.n_modes + mode);
    }
  build_pattern();
}

/// The pattern is that of all rows. Faces have fewer entries that are not zero, but one pattern
/// lets all of them share a symbolic factorization.
void CoarseSpace::build_pattern()
{
  const unsigned int m = table.n_modes, n_subdomains = narrow<unsigned int>(table.body.size());
  std::set<Coupling> couplings, bounded_couplings;
  // Also subdomains without rows have their place on the diagonal.
  for (unsigned int s = 0; s < n_subdomains; ++s)
    couplings.emplace(s, s);
  for (unsigned int row = 0; row < layout.n_owned(); ++row)
    for (unsigned int a = block_start[row]; a < block_start[row + 1]; ++a)
      for (unsigned int b = block_start[row]; b < block_start[row + 1]; ++b)
        {
          const Coupling pair(block_subdomain[a], block_subdomain[b]);
          couplings.insert(pair);
          // Contact rows come and go with the set: only the places they reach are summed per face.
          if (layout.bounded()[row])
            bounded_couplings.insert(pair);
        }
  // N_f (N_f'N_f)^-1 N_f' couples the representatives of all bodies: a kernel may move several.
  for (const unsigned int i : representative)
    for (const unsigned int j : representative)
      couplings.emplace(i / m, j / m);
  const auto                         pairs = unite(couplings, layout.communicator());
  std::vector<std::vector<PetscInt>> rows(n_kernel());
  for (const Coupling &pair : pairs)
    for (unsigned int i = 0; i < m; ++i)
      for (unsigned int j = 0; j < m; ++j)
        rows[pair.first * m + i].push_back(pair.second * m + j);
  gram = CsrMatrix::from_rows(rows, n_kernel());
  for (const Coupling &pair : unite(bounded_couplings, layout.communicator()))
    for (unsigned int i = 0; i < m; ++i)
      for (unsigned int j = 0; j < m; ++j)
        bounded_places.push_back(gram.position(pair.first * m + i, pair.second * m + j));
}

/// values += g g' of the column g of G that belongs to @p row, in the places of the pattern.
void CoarseSpace::add_row(unsigned int row, std::vector<double> &values) const
{
  const unsigned int m = table.n_modes;
  for (unsigned int a = block_start[row]; a < block_start[row + 1]; ++a)
    for (unsigned int b = block_start[row]; b < block_start[row + 1]; ++b)
      {
        // the m rows of a block row have the same pattern
        const unsigned int first  = block_subdomain[a] * m;
        const unsigned int length = gram.row_start()[first + 1] - gram.row_start()[first];
        double            *to     = &values[gram.position(first, block_subdomain[b] * m)];
        for (unsigned int i = 0; i < m; ++i, to += length)
          for (unsigned int j = 0; j < m; ++j)
            to[j] += blocks[a * m + i] * blocks[b * m + j];
      }
}

void CoarseSpace::update(const std::vector<double>          &G_entries,
                         unsigned int                        stride,
                         const std::vector<qp::MultiVector> &Z)
{
  const unsigned int m = table.n_modes;
  blocks.assign(block_subdomain.size() * m, 0.);
  for (std::size_t e = 0; e < block_of_entry.size(); ++e)
    for (unsigned int i = 0; i < m; ++i)
      blocks[block_of_entry[e] * m + i] += G_entries[e * stride + i];
  // The part of the equality rows is the same for every face of a design.
  equality_gram.assign(gram.values.size(), 0.);
  for (unsigned int row = 0; row < layout.n_owned(); ++row)
    if (!layout.bounded()[row])
      add_row(row, equality_gram);
  sum_over_ranks(equality_gram, layout.communicator());

  const auto n_bodies = narrow<unsigned int>(table.body_names.size());
  // Subdomains hold orthonormal R of their own; Z_s says what combination of them moves the body as
  // a whole. Each rank fills in its subdomains; adding zeros is exact.
  modes = qp::MultiVector(n_kernel(), n_bodies * m);
  for (unsigned int s = 0; s < Z.size(); ++s)
    for (unsigned int i = 0; i < m; ++i)
      for (unsigned int j = 0; j < m; ++j)
        modes((table.first + s) * m + i, table.body[table.first + s] * m + j) = Z[s](i, j);
  MPI_Allreduce(MPI_IN_PLACE, modes.column(0), modes.n_rows() * modes.n_columns(), MPI_DOUBLE,
                MPI_SUM, layout.communicator());
  // Z (Z'Z)^{-1/2}: orthonormal, and each body keeps its own columns
  const qp::MultiVector            products = transpose_times(modes, modes);
  const unsigned int               n        = products.n_columns();
  dealii::LAPACKFullMatrix<double> square(n);
  for (unsigned int j = 0; j < n; ++j)
    for (unsigned int i = 0; i < n; ++i)
      square(i, j) = products(i, j);
  square.compute_svd();
  // V S V' has the root V S^{-1/2} V', a product of V S^{-1/4} with itself.
  qp::MultiVector root(n, n);
  for (unsigned int j = 0; j < n; ++j)
    for (unsigned int i = 0; i < n; ++i)
      root(i, j) = square.get_svd_vt()(i, j) / std::pow(square.singular_value(i), 0.25);
  modes = times(modes, transpose_times(root, root));
}

CoarseSpace::HardlySeen CoarseSpace::hardly_seen_motions(const CsrMatrix &A) const
{
  // A is assembled from the rows of M only. A motion without strain and without relative motion at
  // the gluing moves each body rigidly, so its kernel lies in the span of the body modes and the
  // dense problem has at most 6 unknowns per body, however many subdomains there are.
  qp::MultiVector AZ(A.n_rows(), modes.n_columns());
  A.multiply_add(1., modes, AZ);
  const auto         H      = transpose_times(modes, AZ);
  const double       mean   = A.mean_diagonal();
  const auto         Y      = qp::null_space(H, weak_cut * mean);
  const auto         values = transpose_times(Y, times(H, Y));
  const unsigned int n      = Y.n_columns();
  unsigned int       seen   = 0; // singular values descend
  while (seen < n && values(seen, seen) > kernel_cut * mean)
    ++seen;
  return {Y.columns_from(seen, n - seen), Y.columns_from(0, seen)};
}

/// Each rank adds its owned rows; the sum over ranks makes coarse vectors equal on all of them.
qp::MultiVector CoarseSpace::multiply(const qp::MultiVector &x, const qp::RowSet *free) const
{
  const unsigned int m = table.n_modes;
  qp::MultiVector    c(n_kernel(), x.n_columns());
  const auto is_free = [&](const unsigned int row) { return free == nullptr || (*free)[row]; };
  if (x.n_columns() == 1)
    for (unsigned int row = 0; row < layout.n_owned(); ++row)
      for (unsigned int b = block_start[row]; is_free(row) && b < block_start[row + 1]; ++b)
        {
          const double *G   = &blocks[std::size_t(b) * m];
          double       *c_s = c.column(0) + block_subdomain[b] * m;
          for (unsigned int i = 0; i < m; ++i)
            c_s[i] += G[i] * x(row);
        }
  else
    for (unsigned int k = 0; k < x.n_columns(); k += Columns::width)
      {
        const Columns from(x, k);
        Columns       to(c, k);
        for (unsigned int row = 0; row < layout.n_owned(); ++row)
          for (unsigned int b = block_start[row]; is_free(row) && b < block_start[row + 1]; ++b)
            for (unsigned int i = 0; i < m; ++i)
              Columns::add(blocks[std::size_t(b) * m + i], from[row],
                           to[block_subdomain[b] * m + i]);
        to.unpack(c);
      }
  MPI_Allreduce(MPI_IN_PLACE, c.column(0), c.n_rows() * c.n_columns(), MPI_DOUBLE, MPI_SUM,
                layout.communicator());
  return c;
}

/// No communication: alpha is on all ranks, and a rank has the columns of G of its own rows.
qp::MultiVector CoarseSpace::transpose_multiply(const qp::MultiVector &alpha,
                                                const qp::RowSet      *free) const
{
  const unsigned int m = table.n_modes;
  qp::MultiVector    y(layout.n_owned(), alpha.n_columns());
  const auto is_free = [&](const unsigned int row) { return free == nullptr || (*free)[row]; };
  if (alpha.n_columns() == 1)
    for (unsigned int row = 0; row < layout.n_owned(); ++row)
      for (unsigned int b = block_start[row]; is_free(row) && b < block_start[row + 1]; ++b)
        {
          const double *G       = &blocks[std::size_t(b) * m];
          const double *alpha_s = alpha.column(0) + block_subdomain[b] * m;
          for (unsigned int i = 0; i < m; ++i)
            y(row) += G[i] * alpha_s[i];
        }
  else
    for (unsigned int k = 0; k < alpha.n_columns(); k += Columns::width)
      {
        const Columns from(alpha, k);
        Columns       to(y, k);
        for (unsigned int row = 0; row < layout.n_owned(); ++row)
          for (unsigned int b = block_start[row]; is_free(row) && b < block_start[row + 1]; ++b)
            for (unsigned int i = 0; i < m; ++i)
              Columns::add(blocks[std::size_t(b) * m + i], from[block_subdomain[b] * m + i],
                           to[row]);
        to.unpack(y);
      }
  return y;
}

std::vector<double> CoarseSpace::gram_values(const qp::RowSet &free) const
{
  std::vector<double> contact(gram.values.size(), 0.);
  for (unsigned int row = 0; row < layout.n_owned(); ++row)
    if (layout.bounded()[row] && free[row])
      add_row(row, contact);
  // Only the places that contact rows reach are sent: few of the pattern in large models.
  std::vector<double> packed;
  for (const std::size_t place : bounded_places)
    packed.push_back(contact[place]);
  sum_over_ranks(packed, layout.communicator());
  std::vector<double> values = equality_gram;
  for (std::size_t i = 0; i < packed.size(); ++i)
    values[bounded_places[i]] += packed[i];
  return values;
}

/// Of all rows: a scale, which need not be that of a face.
double CoarseSpace::norm() const
{
  double square = 0.;
  for (const double value : blocks)
    square += value * value;
  MPI_Allreduce(MPI_IN_PLACE, &square, 1, MPI_DOUBLE, MPI_SUM, layout.communicator());
  return std::sqrt(square);
}
} // namespace snug::feti
