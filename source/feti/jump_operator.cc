#include <snug/base/disjoint_sets.h>
#include <snug/base/narrow.h>
#include <snug/feti/jump_operator.h>

#include <deal.II/base/mpi.h>

#include <boost/serialization/vector.hpp>

#include <algorithm>
#include <map>
#include <set>

namespace snug::feti {
namespace {
using Unknown = RowLayout::Unknown;

/// Node rows and unknowns of this rank, in groups such that no row couples two groups.
struct Groups
{
  RowEntries                             entries;
  std::vector<std::vector<unsigned int>> members; ///< unknowns of each group, ascending
  std::size_t stride; ///< distance between the numbers of consecutive entries
};

Groups groups_of(const RowLayout &layout, const SubdomainTable &table, const std::size_t stride)
{
  Groups       groups{RowEntries(layout, table, layout.node_rows()), {}, stride};
  const auto  &entries = groups.entries;
  const auto   n       = narrow<unsigned int>(entries.unknowns.size());
  DisjointSets sets(n);
  for (unsigned int row = 0; row < layout.n_owned(); ++row)
    for (const unsigned int e : entries.of_row[row])
      sets.join(entries.unknown[entries.of_row[row].front()], entries.unknown[e]);
  std::vector<unsigned int> group_of_root(n);
  for (unsigned int i = 0; i < n; ++i)
    {
      const unsigned int root = sets.find(i);
      if (root == i)
        {
          group_of_root[i] = narrow<unsigned int>(groups.members.size());
          groups.members.emplace_back();
        }
      groups.members[group_of_root[root]].push_back(i);
    }
  return groups;
}

/// Return W^-1 B D^-1 e_i. W couples no two groups, so a column serves one unknown of each group.
qp::MultiVector row_forces_of(const RowLayout           &layout,
                              const RowGram             &gram,
                              const Groups              &groups,
                              const std::vector<double> &entries)
{
  std::size_t width = 0;
  for (const auto &members : groups.members)
    width = std::max(width, members.size());
  qp::MultiVector X(layout.n_owned(), narrow<unsigned int>(width));
  for (const auto &members : groups.members)
    for (unsigned int k = 0; k < members.size(); ++k)
      for (const unsigned int e : groups.entries.of_unknown[members[k]])
        X(groups.entries.row[e], k) = entries[e * groups.stride] * entries[e * groups.stride + 1];
  gram.solve_node_rows(X);
  return X;
}

/// Return the column of unknown k of the group @p members.
JumpColumn column(const RowLayout                 &layout,
                  const Groups                    &groups,
                  const std::vector<double>       &entries,
                  const qp::MultiVector           &X,
                  const std::vector<unsigned int> &members,
                  const unsigned int               k)
{
  const std::size_t      stride  = groups.stride;
  const Unknown         &unknown = groups.entries.unknowns[members[k]];
  JumpColumn             result{unknown.subdomain, unknown.dof, {}, {}};
  std::set<unsigned int> rows;
  for (const unsigned int other : members)
    {
      double sum = 0.;
      for (const unsigned int e : groups.entries.of_unknown[other])
        {
          rows.insert(groups.entries.row[e]);
          sum += entries[e * stride] * X(groups.entries.row[e], k) * entries[e * stride + 1];
        }
      // B_D' B e_i = D^-1 B' W^-1 B e_i, where X holds W^-1 B D^-1 e_i
      const double D = 1. / entries[groups.entries.of_unknown[members[k]].front() * stride + 1];
      result.copies.push_back(
        {groups.entries.unknowns[other].subdomain, groups.entries.unknowns[other].dof, D * sum});
    }
  for (const unsigned int row : rows)
    result.forces.push_back({layout.global_row(row), X(row, k)});
  return result;
}
} // namespace

/// The owner of a group's rows has all its data and sends the columns to the subdomains' ranks.
std::vector<JumpColumns> jump_operator(const RowLayout           &layout,
                                       const RowGram             &gram,
                                       const std::vector<double> &entries,
                                       const unsigned int         stride,
                                       const SubdomainTable      &table,
                                       const unsigned int         n_subdomains)
{
  const MPI_Comm                      comm   = layout.communicator();
  const auto                          groups = groups_of(layout, table, stride);
  const auto                          X      = row_forces_of(layout, gram, groups, entries);
  const SubdomainRanks                rank_of(table.first, comm);
  std::map<unsigned int, JumpColumns> out;
  for (const auto &members : groups.members)
    for (unsigned int k = 0; k < members.size(); ++k)
      out[rank_of(groups.entries.unknowns[members[k]].subdomain)].push_back(
        column(layout, groups, entries, X, members, k));
  auto received = dealii::Utilities::MPI::some_to_some(comm, out);
  out.clear(); // the columns take much memory
  std::vector<JumpColumns> result(n_subdomains);
  for (auto &message : received)
    for (JumpColumn &of_unknown : message.second)
      result[of_unknown.subdomain - table.first].push_back(std::move(of_unknown));
  // Messages arrive rank by rank.
  for (auto &columns : result)
    std::sort(columns.begin(), columns.end(),
              [](const JumpColumn &a, const JumpColumn &b) { return a.dof < b.dof; });
  return result;
}
} // namespace snug::feti
