#include <snug/base/narrow.h>
#include <snug/feti/csr_matrix.h>
#include <snug/qp/packed_columns.h>

#include <algorithm>
#include <cstring>

namespace snug::feti {
namespace {
using Columns = qp::PackedColumns;

/// Add a word to both hashes. They multiply by different odd numbers. The shifts bring high bits
/// down, because a product moves information to higher bits only.
void mix(Fingerprint &hashes, const std::uint64_t word)
{
  hashes[0] = (hashes[0] ^ word) * 0x9e3779b97f4a7c15u;
  hashes[0] ^= hashes[0] >> 32;
  hashes[1] = (hashes[1] + word) * 0xc2b2ae3d27d4eb4fu;
  hashes[1] ^= hashes[1] >> 29;
}

void mix(Fingerprint &hashes, const std::vector<PetscInt> &numbers)
{
  mix(hashes, numbers.size());
  for (const PetscInt number : numbers)
    mix(hashes, static_cast<std::uint64_t>(number));
}
} // namespace

Fingerprint fingerprint(const CsrPattern &pattern)
{
  Fingerprint hashes = {{1, 2}};
  mix(hashes, pattern.n_columns);
  mix(hashes, pattern.row_start);
  mix(hashes, pattern.columns);
  return hashes;
}

Fingerprint fingerprint(const std::vector<double> &values)
{
  Fingerprint hashes = {{1, 2}};
  for (const double value : values)
    {
      std::uint64_t bits;
      std::memcpy(&bits, &value, sizeof bits);
      mix(hashes, bits);
    }
  return hashes;
}

std::shared_ptr<const CsrPattern>
SharedPatterns::of(const std::shared_ptr<const CsrPattern> &pattern)
{
  return known.emplace(fingerprint(*pattern), pattern).first->second;
}

CsrMatrix::CsrMatrix(std::shared_ptr<const CsrPattern> pattern)
  : values(pattern->columns.size(), 0.), places(std::move(pattern))
{}

CsrMatrix::CsrMatrix(std::shared_ptr<const CsrPattern> pattern, std::vector<double> the_values)
  : values(std::move(the_values)), places(std::move(pattern))
{}

CsrMatrix CsrMatrix::from_rows(const std::vector<std::vector<PetscInt>> &columns_of_rows,
                               unsigned int                              n_columns)
{
  CsrPattern  pattern;
  std::size_t n_entries = 0;
  for (const auto &row : columns_of_rows)
    n_entries += row.size();
  pattern.n_rows    = narrow<unsigned int>(columns_of_rows.size());
  pattern.n_columns = n_columns;
  pattern.columns.reserve(n_entries);
  pattern.row_start.reserve(columns_of_rows.size() + 1);
  for (const auto &row : columns_of_rows)
    {
      pattern.columns.insert(pattern.columns.end(), row.begin(), row.end());
      pattern.row_start.push_back(narrow<PetscInt>(pattern.columns.size()));
    }
  return CsrMatrix(std::make_shared<const CsrPattern>(std::move(pattern)));
}

/// Binary search, as columns ascend. A place off the pattern gives that of another entry.
std::size_t CsrPattern::position(PetscInt i, PetscInt j) const
{
  const auto first = columns.begin();
  return std::lower_bound(first + row_start[i], first + row_start[i + 1], j) - first;
}

double CsrMatrix::mean_diagonal() const
{
  double mean = 0.;
  for (unsigned int i = 0; i < n_rows(); ++i)
    mean += diagonal(i) / n_rows();
  return mean;
}

void CsrMatrix::multiply_add(double factor, const qp::MultiVector &x, qp::MultiVector &y) const
{
  const PetscInt *start = row_start().data(), *column = columns().data();
  if (x.n_columns() == 1)
    {
      const double *from = x.column(0), *value = values.data();
      double       *to = y.column(0);
      for (unsigned int i = 0; i < n_rows(); ++i)
        {
          double sum = 0.;
          for (PetscInt p = start[i]; p < start[i + 1]; ++p)
            sum += value[p] * from[column[p]];
          to[i] += factor * sum;
        }
    }
  else
    for (unsigned int k = 0; k < x.n_columns(); k += Columns::width)
      {
        const Columns from(x, k);
        Columns       to(y, k);
        for (unsigned int i = 0; i < n_rows(); ++i)
          {
            Columns::Row sum{};
            for (PetscInt p = start[i]; p < start[i + 1]; ++p)
              Columns::add(values[p], from[column[p]], sum);
            Columns::add(factor, sum, to[i]);
          }
        to.unpack(y);
      }
}

/// Row i of A is column i of A', so A' is never assembled.
void CsrMatrix::transpose_multiply_add(double                 factor,
                                       const qp::MultiVector &x,
                                       qp::MultiVector       &y) const
{
  const PetscInt *start = row_start().data(), *column = columns().data();
  if (x.n_columns() == 1)
    {
      const double *from = x.column(0), *value = values.data();
      double       *to = y.column(0);
      for (unsigned int i = 0; i < n_rows(); ++i)
        {
          const double x_i = factor * from[i];
          for (PetscInt p = start[i]; p < start[i + 1]; ++p)
            to[column[p]] += value[p] * x_i;
        }
    }
  else
    for (unsigned int k = 0; k < x.n_columns(); k += Columns::width)
      {
        const Columns from(x, k);
        Columns       to(y, k);
        for (unsigned int i = 0; i < n_rows(); ++i)
          {
            Columns::Row x_i{};
            Columns::add(factor, from[i], x_i);
            for (PetscInt p = start[i]; p < start[i + 1]; ++p)
              Columns::add(values[p], x_i, to[column[p]]);
          }
        to.unpack(y);
      }
}

void CsrMatrix::add_symmetric_product(const qp::MultiVector &x, qp::MultiVector &y) const
{
  const PetscInt *start = row_start().data(), *column = columns().data();
  if (x.n_columns() == 1)
    {
      const double *from = x.column(0), *value = values.data();
      double       *to = y.column(0);
      for (unsigned int i = 0; i < n_rows(); ++i)
        {
          const PetscInt last = start[i + 1] - 1;
          double         sum  = value[last] * from[i];
          for (PetscInt p = start[i]; p < last; ++p)
            {
              sum += value[p] * from[column[p]];
              to[column[p]] += value[p] * from[i];
            }
          to[i] += sum;
        }
    }
  else
    for (unsigned int k = 0; k < x.n_columns(); k += Columns::width)
      {
        const Columns from(x, k);
        Columns       to(y, k);
        for (unsigned int i = 0; i < n_rows(); ++i)
          {
            const PetscInt last = start[i + 1] - 1;
            Columns::Row   sum{};
            Columns::add(values[last], from[i], sum);
            for (PetscInt p = start[i]; p < last; ++p)
              {
                Columns::add(values[p], from[column[p]], sum);
                Columns::add(values[p], from[i], to[column[p]]);
              }
            Columns::add(1., sum, to[i]);
          }
        to.unpack(y);
      }
}
} // namespace snug::feti
