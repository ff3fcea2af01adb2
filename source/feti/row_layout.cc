#include <snug/base/narrow.h>
#include <snug/feti/row_layout.h>
#include <snug/qp/row_set.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace snug::feti {
namespace {
using petsc::check;

/// Return a star forest whose leaves 0..n-1 are connected to the given global rows.
petsc::StarForest connect(MPI_Comm                         comm,
                          unsigned int                     n_owned,
                          const std::vector<unsigned int> &first_row_of_rank,
                          const std::vector<unsigned int> &rows)
{
  std::vector<PetscSFNode> remote(rows.size());
  for (unsigned int leaf = 0; leaf < rows.size(); ++leaf)
    {
      // Find the last rank that begins at or before the row. A rank without rows begins where the
      // next rank begins.
      const auto rank = narrow<PetscInt>(
        std::upper_bound(first_row_of_rank.begin(), first_row_of_rank.end(), rows[leaf]) -
        first_row_of_rank.begin() - 1);
      remote[leaf].rank  = rank;
      remote[leaf].index = rows[leaf] - first_row_of_rank[rank];
    }
  petsc::StarForest forest;
  check(PetscSFCreate(comm, forest.put()));
  // Gathered entries are in the order of the ranks, not in the order in which messages arrive.
  check(PetscSFSetRankOrder(forest, PETSC_TRUE));
  check(PetscSFSetGraph(forest, n_owned, narrow<PetscInt>(rows.size()), nullptr, PETSC_OWN_POINTER,
                        remote.data(), PETSC_COPY_VALUES));
  check(PetscSFSetUp(forest));
  return forest;
}

/// An MPI type of k numbers of a type, freed with the object.
class Tuple
{
public:
  Tuple(MPI_Datatype of_number, unsigned int k)
  {
    MPI_Type_contiguous(k, of_number, &type);
    MPI_Type_commit(&type);
  }
  ~Tuple() { MPI_Type_free(&type); }
  Tuple(const Tuple &)            = delete;
  Tuple &operator=(const Tuple &) = delete;
  operator MPI_Datatype() const { return type; }

private:
  MPI_Datatype type;
};

/// Return x row by row, because the star forest sends the k numbers of a row as one item.
std::vector<double> interleave(const qp::MultiVector &x)
{
  const unsigned int  k = x.n_columns();
  std::vector<double> rows(std::size_t(x.n_rows()) * k);
  for (unsigned int j = 0; j < k; ++j)
    for (unsigned int i = 0; i < x.n_rows(); ++i)
      rows[std::size_t(i) * k + j] = x(i, j);
  return rows;
}

qp::MultiVector deinterleave(const std::vector<double> &rows, unsigned int n, unsigned int k)
{
  qp::MultiVector x(n, k);
  for (unsigned int j = 0; j < k; ++j)
    for (unsigned int i = 0; i < n; ++i)
      x(i, j) = rows[std::size_t(i) * k + j];
  return x;
}
} // namespace

RowExchange::RowExchange(MPI_Comm                         communicator,
                         const std::vector<unsigned int> &first_of_rank,
                         const std::vector<unsigned int> &rows)
  : n_local(narrow<unsigned int>(rows.size()))
{
  int rank;
  MPI_Comm_rank(communicator, &rank);
  n_owned     = first_of_rank[rank + 1] - first_of_rank[rank];
  star_forest = connect(communicator, n_owned, first_of_rank, rows);
}

std::vector<unsigned int> RowExchange::first_of_ranks(MPI_Comm           communicator,
                                                      const unsigned int n_owned)
{
  int n_ranks;
  MPI_Comm_size(communicator, &n_ranks);
  std::vector<unsigned int> first(n_ranks + 1, 0);
  MPI_Allgather(&n_owned, 1, MPI_UNSIGNED, first.data() + 1, 1, MPI_UNSIGNED, communicator);
  std::partial_sum(first.begin(), first.end(), first.begin());
  return first;
}

qp::MultiVector RowExchange::to_local(const qp::MultiVector &owned) const
{
  const unsigned int  k    = owned.n_columns();
  const auto          root = interleave(owned);
  std::vector<double> leaf(std::size_t(n_local) * k);
  const Tuple         type(MPI_DOUBLE, k);
  check(PetscSFBcastBegin(star_forest, type, root.data(), leaf.data(), MPI_REPLACE));
  check(PetscSFBcastEnd(star_forest, type, root.data(), leaf.data(), MPI_REPLACE));
  return deinterleave(leaf, n_local, k);
}

qp::MultiVector RowExchange::to_owned(const qp::MultiVector &local) const
{
  // PETSc sums single numbers only, so the columns are sent one at a time.
  qp::MultiVector owned(n_owned, local.n_columns());
  for (unsigned int j = 0; j < local.n_columns(); ++j)
    {
      check(PetscSFReduceBegin(star_forest, MPI_DOUBLE, local.column(j), owned.column(j), MPI_SUM));
      check(PetscSFReduceEnd(star_forest, MPI_DOUBLE, local.column(j), owned.column(j), MPI_SUM));
    }
  return owned;
}

RowLayout::RowLayout(MPI_Comm                               communicator,
                     const qp::RowSet                      &contact_rows,
                     const std::vector<std::vector<Entry>> &entries,
                     unsigned int                           first_subdomain,
                     const qp::RowSet                      &ties)
  : comm(communicator), is_contact(contact_rows), is_node_row(qp::complement(contact_rows))
{
  for (unsigned int row = 0; row < ties.size(); ++row)
    if (ties[row])
      is_node_row[row] = 0;
  const unsigned int n = narrow<unsigned int>(contact_rows.size());
  first                = RowExchange::first_of_ranks(comm, n);
  int rank;
  MPI_Comm_rank(comm, &rank);
  first_owned = first[rank];

  std::vector<unsigned int> entry_rows;
  std::vector<Unknown>      entry_unknowns;
  for (unsigned int s = 0; s < entries.size(); ++s)
    for (const Entry &entry : entries[s])
      {
        entry_rows.push_back(entry.global_row);
        entry_unknowns.push_back({first_subdomain + s, entry.dof});
      }
  local_rows = entry_rows;
  std::sort(local_rows.begin(), local_rows.end());
  local_rows.erase(std::unique(local_rows.begin(), local_rows.end()), local_rows.end());
  exchange     = RowExchange(comm, first, local_rows);
  entry_forest = connect(comm, n, first, entry_rows);
  sort_local_rows();

  // Degree of a row: the number of entries that the row has on all ranks.
  const PetscInt *degree;
  check(PetscSFComputeDegreeBegin(entry_forest, &degree));
  check(PetscSFComputeDegreeEnd(entry_forest, &degree));
  start.assign(1, 0);
  for (unsigned int row = 0; row < n; ++row)
    start.push_back(start.back() + degree[row]);
  static_assert(sizeof(Unknown) == 2 * sizeof(unsigned int), "an unknown is sent as two numbers");
  const auto gathered = gather_unsorted(Tuple(MPI_UNSIGNED, 2), 1, entry_unknowns);
  order.resize(start.back());
  std::iota(order.begin(), order.end(), 0);
  for (unsigned int row = 0; row < n; ++row)
    // Sort by subdomain and unknown. Sums over the entries of a row then do not depend on the
    // distribution of subdomains over ranks.
    std::sort(order.begin() + start[row], order.begin() + start[row + 1],
              [&](unsigned int a, unsigned int b) { return gathered[a] < gathered[b]; });
  for (const unsigned int entry : order)
    unknowns.push_back(gathered[entry]);
}

/// Number the local equality rows before the local contact rows.
void RowLayout::sort_local_rows()
{
  qp::MultiVector owned(n_owned());
  for (unsigned int row = 0; row < n_owned(); ++row)
    owned(row) = is_contact[row] ? 1. : 0.;
  const auto                flags = to_local(owned);
  std::vector<unsigned int> equalities, contacts;
  for (unsigned int row = 0; row < n_local(); ++row)
    (flags(row) == 0. ? equalities : contacts).push_back(local_rows[row]);
  n_equalities = narrow<unsigned int>(equalities.size());
  local_rows   = equalities;
  local_rows.insert(local_rows.end(), contacts.begin(), contacts.end());
  exchange = RowExchange(comm, first, local_rows);
}

/// For a row that this rank does not touch, the result is another row's position or n_local().
unsigned int RowLayout::local_row(unsigned int global_row) const
{
  const auto middle = local_rows.begin() + n_equalities;
  auto       found  = std::lower_bound(local_rows.begin(), middle, global_row);
  if (found == middle || *found != global_row)
    found = std::lower_bound(middle, local_rows.end(), global_row);
  return narrow<unsigned int>(found - local_rows.begin());
}

/// to_local() sends owned rows to the ranks of their leaves, to_owned() local rows to the ranks of
/// their roots.
RowLayout::Sent RowLayout::sent() const
{
  int rank;
  MPI_Comm_rank(comm, &rank);
  Sent                  result;
  std::set<PetscMPIInt> neighbours;
  const auto add = [&](const PetscInt n, const PetscMPIInt *ranks, const PetscInt *begin) {
    for (PetscInt i = 0; i < n; ++i)
      if (ranks[i] != rank && begin[i] < begin[i + 1])
        {
          neighbours.insert(ranks[i]);
          result.messages += 1;
          result.numbers += begin[i + 1] - begin[i];
        }
  };
  PetscInt           n;
  const PetscMPIInt *ranks;
  const PetscInt    *begin, *unused, *unused_too;
  check(PetscSFGetLeafRanks(exchange.forest(), &n, &ranks, &begin, &unused));
  add(n, ranks, begin);
  check(PetscSFGetRootRanks(exchange.forest(), &n, &ranks, &begin, &unused, &unused_too));
  add(n, ranks, begin);
  result.neighbours = narrow<unsigned int>(neighbours.size());
  return result;
}

template <typename T>
std::vector<T> RowLayout::gather_unsorted(MPI_Datatype          of_entry,
                                          unsigned int          n_per_entry,
                                          const std::vector<T> &values) const
{
  std::vector<T> gathered(std::size_t(start.back()) * n_per_entry);
  check(PetscSFGatherBegin(entry_forest, of_entry, values.data(), gathered.data()));
  check(PetscSFGatherEnd(entry_forest, of_entry, values.data(), gathered.data()));
  return gathered;
}

std::vector<double> RowLayout::gather_entries(unsigned int               width,
                                              const std::vector<double> &values) const
{
  const auto          unsorted = gather_unsorted(Tuple(MPI_DOUBLE, width), width, values);
  std::vector<double> sorted(unsorted.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    std::copy_n(unsorted.begin() + std::size_t(order[i]) * width, width,
                sorted.begin() + i * width);
  return sorted;
}
} // namespace snug::feti
