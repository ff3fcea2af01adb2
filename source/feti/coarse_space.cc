#include <snug/base/assertions.h>
#include <snug/base/narrow.h>
#include <snug/feti/coarse_space.h>
#include <snug/feti/couplings.h>
#include <snug/qp/direction_basis.h>
#include <snug/qp/packed_columns.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace snug::feti {
namespace {
using Columns = qp::PackedColumns;

/// Eigenvalues of Z'AZ below this part of the mean of diag A are rounding errors of other
/// eigenvalues. Their motions are not resisted by any row.
const double kernel_cut = 1e-13;

/// Eigenvalues of Z'AZ below this part of the mean of diag A belong to hardly resisted motions,
/// which would cost A^-1 too many digits.
const double weak_cut = 1e-5;

/// Sums below this part of the sum of their absolute terms are zero except for rounding.
const double rounding_of_sums = 1e-13;
} // namespace

CoarseStructure::CoarseStructure(const RowLayout   &the_layout,
                                 SubdomainTable     the_table,
                                 const unsigned int n_ranks)
  : layout(the_layout)
  , table(std::move(the_table))
  , factors(MatrixKind::coarse,
            Factorization::CHOLMOD,
            nullptr,
            nullptr,
            coarse_group(layout.communicator(), table.n_kernel(), MatrixKind::coarse, n_ranks))
{
  // The entries of one cluster in one row make one block of G, the n_modes numbers
  // G(c, row) = R_c' B_c(row, :)'.
  const auto &start    = layout.entry_start();
  const auto &unknowns = layout.entry_unknowns();
  block_start.assign(1, 0);
  for (unsigned int row = 0; row < layout.n_owned(); ++row)
    {
      std::set<unsigned int> of_row;
      for (unsigned int e = start[row]; e < start[row + 1]; ++e)
        of_row.insert(table.cluster_of(unknowns[e].subdomain));
      block_cluster.insert(block_cluster.end(), of_row.begin(), of_row.end());
      const auto first = block_cluster.begin() + block_start.back();
      for (unsigned int e = start[row]; e < start[row + 1]; ++e)
        block_of_entry.push_back(narrow<unsigned int>(
          std::lower_bound(first, block_cluster.end(), table.cluster_of(unknowns[e].subdomain)) -
          block_cluster.begin()));
      block_start.push_back(narrow<unsigned int>(block_cluster.size()));
    }
  // The first cluster of a body represents the body. Z is regular, so that the n_modes coarse
  // unknowns of the cluster distinguish all rigid motions of the body.
  for (unsigned int body = 0; body < table.n_bodies(); ++body)
    {
      const auto s = narrow<unsigned int>(std::find(table.body.begin(), table.body.end(), body) -
                                          table.body.begin());
      for (unsigned int mode = 0; mode < table.n_modes; ++mode)
        representatives.push_back(table.cluster_of(s) * table.n_modes + mode);
    }
  find_couplings();
}

/// The pattern is that of all rows. Faces have fewer nonzero entries, but a common pattern lets all
/// faces share a symbolic factorization.
void CoarseStructure::find_couplings()
{
  Couplings all, of_contact;
  // Clusters without rows also need their diagonal block.
  for (unsigned int c = 0; c < table.n_clusters(); ++c)
    all.insert({c, c});
  for (unsigned int row = 0; row < layout.n_owned(); ++row)
    for (unsigned int a = block_start[row]; a < block_start[row + 1]; ++a)
      for (unsigned int b = block_start[row]; b < block_start[row + 1]; ++b)
        {
          const Coupling pair{block_cluster[a], block_cluster[b]};
          all.insert(pair);
          // Contact rows change with the active set, so only their entries are summed for each
          // face.
          if (layout.contact_rows()[row])
            of_contact.insert(pair);
        }
  // N_f (N_f'N_f)^-1 N_f' couples the representatives of all bodies, because a motion of the kernel
  // may move several bodies.
  for (const unsigned int i : representatives)
    for (const unsigned int j : representatives)
      all.insert({i / table.n_modes, j / table.n_modes});
  couplings         = all.unite(table.n_clusters(), layout.communicator());
  contact_couplings = of_contact.unite(table.n_clusters(), layout.communicator());
}

std::shared_ptr<const CsrPattern> CoarseStructure::gram_pattern() const
{
  const unsigned int m = table.n_modes;
  CsrPattern         result;
  result.n_rows = result.n_columns = table.n_kernel();
  result.row_start.reserve(table.n_kernel() + 1);
  result.columns.reserve(couplings.columns.size() * m * m);
  for (unsigned int i = 0; i < table.n_kernel(); ++i)
    {
      for (PetscInt p = couplings.row_start[i / m]; p < couplings.row_start[i / m + 1]; ++p)
        for (unsigned int j = 0; j < m; ++j)
          result.columns.push_back(narrow<PetscInt>(couplings.columns[p] * m + j));
      result.row_start.push_back(narrow<PetscInt>(result.columns.size()));
    }
  return std::make_shared<const CsrPattern>(std::move(result));
}

CoarseStructure::Block CoarseStructure::block(const unsigned int a, const unsigned int b) const
{
  const std::size_t m = table.n_modes, begin = couplings.row_start[a];
  const std::size_t length = (couplings.row_start[a + 1] - begin) * m;
  return {begin * m * m + (couplings.position(a, b) - begin) * m, length};
}

void CoarseStructure::sum(qp::MultiVector &contributions) const
{
  sum_over_ranks(contributions, layout.communicator());
}

/// Compute the norms without a sum over ranks, because coarse vectors are equal on all ranks.
std::vector<double> CoarseStructure::norms(const qp::MultiVector &c) const
{
  return qp::norms(c, MPI_COMM_SELF);
}

CoarseSpace::CoarseSpace(const CoarseStructure              &structure,
                         const std::vector<double>          &G_entries,
                         const unsigned int                  offset,
                         const std::vector<qp::MultiVector> &Z)
  : pattern(structure)
  , layout(structure.layout)
  , blocks(structure.block_cluster.size() * structure.table.n_modes, 0.)
  , equality_gram(structure.couplings.columns.size() * structure.table.n_modes *
                    structure.table.n_modes,
                  0.)
{
  const unsigned int  m = pattern.table.n_modes;
  std::vector<double> gross(blocks.size(), 0.); // sums before they cancel
  for (std::size_t e = 0; e < pattern.block_of_entry.size(); ++e)
    for (unsigned int i = 0; i < m; ++i)
      {
        const double entry = G_entries[e * (offset + m) + offset + i];
        blocks[pattern.block_of_entry[e] * m + i] += entry;
        gross[pattern.block_of_entry[e] * m + i] += std::abs(entry);
      }
  // Gluing rows inside a cluster resist no motion of the cluster. Their rounding errors would be
  // all that G has for a body in one cluster, and would seem to hold the body.
  if (!pattern.table.clusters.empty())
    for (std::size_t i = 0; i < blocks.size(); ++i)
      if (std::abs(blocks[i]) <= rounding_of_sums * gross[i])
        blocks[i] = 0.;
  // The contribution of the equality rows is the same for all faces of a design.
  const auto place = [&](const unsigned int a, const unsigned int b) {
    const auto block = pattern.block(a, b);
    return std::make_pair(&equality_gram[block.first], block.length);
  };
  for (unsigned int row = 0; row < layout.n_owned(); ++row)
    if (!layout.contact_rows()[row])
      add_column(row, &blocks[std::size_t(pattern.block_start[row]) * m], place);
  sum_over_ranks(equality_gram, layout.communicator());
  set_body_modes(Z);
}

/// Add g g' to the blocks that @p place returns for two clusters: the first entry, and the distance
/// of rows. @p column holds g in the blocks of @p row.
template <typename Place>
void CoarseSpace::add_column(const unsigned int row, const double *column, const Place &place) const
{
  const unsigned int m        = pattern.table.n_modes;
  const auto        &start    = pattern.block_start;
  const auto        &clusters = pattern.block_cluster;
  for (unsigned int a = start[row]; a < start[row + 1]; ++a)
    for (unsigned int b = start[row]; b < start[row + 1]; ++b)
      {
        auto [to, length] = place(clusters[a], clusters[b]);
        for (unsigned int i = 0; i < m; ++i, to += length)
          for (unsigned int j = 0; j < m; ++j)
            to[j] += column[(a - start[row]) * m + i] * column[(b - start[row]) * m + j];
      }
}

/// Return the sum of the columns of G of the rows of a contact with the given factors, in the
/// blocks of its first tangential row. Tangential rows have the same blocks, among which are those
/// of the normal row.
std::vector<double> CoarseSpace::combined_column(const qp::FrictionCone      &cone,
                                                 const double                 of_normal,
                                                 const std::array<double, 2> &of_tangents) const
{
  const unsigned int  m     = pattern.table.n_modes;
  const auto         &start = pattern.block_start;
  const auto          all   = pattern.block_cluster.begin();
  const unsigned int  base = start[cone.tangents[0]], end = start[cone.tangents[0] + 1];
  std::vector<double> column(std::size_t(end - base) * m);
  const auto          add = [&](const double factor, const unsigned int row) {
    for (unsigned int b = start[row]; factor != 0. && b < start[row + 1]; ++b)
      {
        const auto found = std::lower_bound(all + base, all + end, pattern.block_cluster[b]);
        SNUG_ASSERT(found != all + end && *found == pattern.block_cluster[b],
                             "the blocks of a normal row are among those of its tangential rows");
        for (unsigned int i = 0; i < m; ++i)
          column[(found - all - base) * m + i] += factor * blocks[std::size_t(b) * m + i];
      }
  };
  add(of_normal, cone.normal);
  for (unsigned int t = 0; t < cone.n_tangents; ++t)
    add(of_tangents[t], cone.tangents[t]);
  return column;
}

/// Each cluster has its own orthonormal R. Z combines the columns of R to motions of the whole
/// body.
void CoarseSpace::set_body_modes(const std::vector<qp::MultiVector> &Z)
{
  const SubdomainTable &table = pattern.table;
  const unsigned int    m     = table.n_modes;
  // Each rank fills in its clusters, and the sum over ranks adds zeros, which is exact.
  modes = qp::MultiVector(table.n_kernel(), table.n_bodies() * m);
  for (unsigned int s = 0; s < Z.size(); ++s)
    for (unsigned int i = 0; i < Z[s].n_rows(); ++i)
      for (unsigned int j = 0; j < m; ++j)
        modes(table.cluster_of(table.first + s) * m + i, table.body[table.first + s] * m + j) =
          Z[s](i, j);
  pattern.sum(modes);
  // Z (Z'Z)^{-1/2} is orthonormal, and each body keeps its own columns.
  const qp::MultiVector            products = transpose_times(modes, modes);
  const unsigned int               n        = products.n_columns();
  dealii::LAPACKFullMatrix<double> square(n);
  for (unsigned int j = 0; j < n; ++j)
    for (unsigned int i = 0; i < n; ++i)
      square(i, j) = products(i, j);
  square.compute_svd();
  // V S V' has the inverse root V S^{-1/2} V', a product of V S^{-1/4} with its transpose.
  qp::MultiVector root(n, n);
  for (unsigned int j = 0; j < n; ++j)
    for (unsigned int i = 0; i < n; ++i)
      root(i, j) = square.get_svd_vt()(i, j) / std::pow(square.singular_value(i), 0.25);
  modes = times(modes, transpose_times(root, root));
}

CoarseSpace::NearKernel CoarseSpace::near_kernel(const CsrMatrix &A) const
{
  // A is assembled from the rows of M only. A motion without strain and without relative motion at
  // the gluing moves each body rigidly. The kernel of A therefore lies in the span of the body
  // modes, and the dense problem has at most 6 unknowns per body for any number of subdomains.
  qp::MultiVector AZ(A.n_rows(), modes.n_columns());
  A.multiply_add(1., modes, AZ);
  const auto         H      = transpose_times(modes, AZ);
  const double       mean   = A.mean_diagonal();
  const auto         Y      = qp::null_space(H, weak_cut * mean);
  const auto         values = transpose_times(Y, times(H, Y));
  const unsigned int n      = Y.n_columns();
  unsigned int       seen   = 0; // singular values are in descending order
  while (seen < n && values(seen, seen) > kernel_cut * mean)
    ++seen;
  return {Y.columns_from(seen, n - seen), Y.columns_from(0, seen)};
}

/// Each rank adds the products of its owned rows. The sum makes coarse vectors equal on all ranks.
qp::MultiVector CoarseSpace::multiply(const qp::MultiVector &x) const
{
  const unsigned int m        = pattern.table.n_modes;
  const auto        &start    = pattern.block_start;
  const auto        &clusters = pattern.block_cluster;
  qp::MultiVector    c(pattern.table.n_kernel(), x.n_columns());
  if (x.n_columns() == 1)
    for (unsigned int row = 0; row < layout.n_owned(); ++row)
      for (unsigned int b = start[row]; b < start[row + 1]; ++b)
        {
          const double *G   = &blocks[std::size_t(b) * m];
          double       *c_s = c.column(0) + clusters[b] * m;
          for (unsigned int i = 0; i < m; ++i)
            c_s[i] += G[i] * x(row);
        }
  else
    for (unsigned int k = 0; k < x.n_columns(); k += Columns::width)
      {
        const Columns from(x, k);
        Columns       to(c, k);
        for (unsigned int row = 0; row < layout.n_owned(); ++row)
          for (unsigned int b = start[row]; b < start[row + 1]; ++b)
            for (unsigned int i = 0; i < m; ++i)
              Columns::add(blocks[std::size_t(b) * m + i], from[row], to[clusters[b] * m + i]);
        to.unpack(c);
      }
  pattern.sum(c);
  return c;
}

/// No communication is needed: alpha is on all ranks, and G is needed on owned rows only.
qp::MultiVector CoarseSpace::transpose_multiply(const qp::MultiVector &alpha) const
{
  const unsigned int m        = pattern.table.n_modes;
  const auto        &start    = pattern.block_start;
  const auto        &clusters = pattern.block_cluster;
  qp::MultiVector    y(layout.n_owned(), alpha.n_columns());
  if (alpha.n_columns() == 1)
    for (unsigned int row = 0; row < layout.n_owned(); ++row)
      for (unsigned int b = start[row]; b < start[row + 1]; ++b)
        {
          const double *G       = &blocks[std::size_t(b) * m];
          const double *alpha_s = alpha.column(0) + clusters[b] * m;
          for (unsigned int i = 0; i < m; ++i)
            y(row) += G[i] * alpha_s[i];
        }
  else
    for (unsigned int k = 0; k < alpha.n_columns(); k += Columns::width)
      {
        const Columns from(alpha, k);
        Columns       to(y, k);
        for (unsigned int row = 0; row < layout.n_owned(); ++row)
          for (unsigned int b = start[row]; b < start[row + 1]; ++b)
            for (unsigned int i = 0; i < m; ++i)
              Columns::add(blocks[std::size_t(b) * m + i], from[clusters[b] * m + i], to[row]);
        to.unpack(y);
      }
  return y;
}

CsrMatrix CoarseSpace::gram(const qp::FreeRows &free) const
{
  // Sum only the blocks of contact rows, because they are few in large models.
  const std::size_t   m   = pattern.table.n_modes;
  const CsrPattern   &few = pattern.contact_couplings;
  std::vector<double> contact(few.columns.size() * m * m, 0.);
  const auto          place = [&](const unsigned int a, const unsigned int b) {
    return std::make_pair(&contact[few.position(a, b) * m * m], m);
  };
  auto unit_columns = free.rows();
  for (const qp::Slip &slip : free.slips())
    {
      const auto  &cone = slip.cone;
      const double mu   = free.is_transposed() ? 0. : cone.coefficient;
      add_column(
        cone.tangents[0],
        combined_column(cone, 1., {{mu * slip.direction[0], mu * slip.direction[1]}}).data(),
        place);
      if (cone.n_tangents == 2)
        add_column(cone.tangents[0], combined_column(cone, 0., slip.across()).data(), place);
      unit_columns[cone.normal] = 0;
    }
  for (unsigned int row = 0; row < layout.n_owned(); ++row)
    if (layout.contact_rows()[row] && unit_columns[row])
      add_column(row, &blocks[std::size_t(pattern.block_start[row]) * m], place);
  sum_over_ranks(contact, layout.communicator());
  CsrMatrix     result(pattern.gram_pattern(), equality_gram);
  const double *next = contact.data();
  for (unsigned int a = 0; a < few.n_rows; ++a)
    for (PetscInt p = few.row_start[a]; p < few.row_start[a + 1]; ++p)
      {
        const auto [first, length] = pattern.block(a, few.columns[p]);
        for (std::size_t i = 0; i < m; ++i)
          for (std::size_t j = 0; j < m; ++j)
            result.values[first + i * length + j] += *next++;
      }
  return result;
}

/// The norm is that of all rows, because it serves as a scale, which need not be that of a face.
double CoarseSpace::norm() const
{
  double square = 0.;
  for (const double value : blocks)
    square += value * value;
  MPI_Allreduce(MPI_IN_PLACE, &square, 1, MPI_DOUBLE, MPI_SUM, layout.communicator());
  return std::sqrt(square);
}
} // namespace snug::feti
