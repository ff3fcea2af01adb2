#include <snug/base/narrow.h>
#include <snug/qp/row_set.h>

#include <algorithm>
#include <cmath>

namespace snug::qp {
namespace {
/// Return the number of the first row of this rank.
long long first_row(unsigned int n_owned, MPI_Comm comm)
{
  const long long n     = n_owned;
  long long       first = 0;
  MPI_Exscan(&n, &first, 1, MPI_LONG_LONG, MPI_SUM, comm);
  int rank;
  MPI_Comm_rank(comm, &rank);
  // MPI_Exscan leaves the result undefined on rank 0.
  return rank == 0 ? 0 : first;
}

} // namespace

std::uint64_t scramble(std::uint64_t x)
{
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

bool any(bool mine, MPI_Comm comm)
{
  int flag = mine;
  MPI_Allreduce(MPI_IN_PLACE, &flag, 1, MPI_INT, MPI_MAX, comm);
  return flag != 0;
}

std::uint64_t fingerprint(const RowSet &rows, MPI_Comm comm)
{
  const long long first = first_row(narrow<unsigned int>(rows.size()), comm);
  std::uint64_t   sum   = 0;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i])
      // Sum scrambled numbers modulo 2^64, so that the order of rows and ranks has no effect. Two
      // sets have the same sum with a probability of 2^-64.
      sum += scramble(first + i);
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_UINT64_T, MPI_SUM, comm);
  return sum;
}

RowSet with_one_change(const RowSet &from, const RowSet &to, MPI_Comm comm)
{
  const long long first = first_row(narrow<unsigned int>(from.size()), comm);
  long long       last  = -1;
  for (std::size_t i = 0; i < from.size(); ++i)
    if (from[i] != to[i])
      last = first + i;
  const long long mine = last;
  MPI_Allreduce(MPI_IN_PLACE, &last, 1, MPI_LONG_LONG, MPI_MAX, comm);
  RowSet result = from;
  // Only the owner of the row has it as the last changed row of its own.
  if (last >= 0 && last == mine)
    result[last - first] = to[last - first];
  return result;
}

RowSet complement(const RowSet &rows)
{
  RowSet others(rows.size());
  for (unsigned int i = 0; i < rows.size(); ++i)
    others[i] = !rows[i];
  return others;
}

RowSet loaded_rows(const RowSet &bounded, const MultiVector &lambda)
{
  RowSet rows(bounded.size(), 1);
  for (unsigned int i = 0; i < rows.size(); ++i)
    rows[i] = !bounded[i] || lambda(i) > 0.;
  return rows;
}

bool has_negative(const RowSet &bounded, const MultiVector &lambda)
{
  for (unsigned int i = 0; i < bounded.size(); ++i)
    if (bounded[i] && lambda(i) < 0.)
      return true;
  return false;
}

void clip_rounding(const RowSet &bounded, const std::vector<double> &rounding, MultiVector &lambda)
{
  for (unsigned int i = 0; i < lambda.n_rows(); ++i)
    if (bounded[i] && std::abs(lambda(i)) <= rounding[i])
      lambda(i) = 0.;
}
} // namespace snug::qp
