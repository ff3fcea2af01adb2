#include <snug/base/narrow.h>
#include <snug/feti/jump_operator.h>

#include <deal.II/base/mpi.h>

#include <boost/serialization/vector.hpp>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace snug::feti {
namespace {
using Unknown = RowLayout::Unknown;

/// Node rows and unknowns of this rank, in groups such that no row couples two groups.
struct Groups
{
  std::vector<Unknown>                   unknowns; ///< ascending
  std::vector<std::vector<unsigned int>> entries;  ///< gathered entries of each unknown
  std::vector<std::vector<unsigned int>> members;  ///< unknowns of each group, ascending
  std::vector<unsigned int>              row_of_entry;
  std::size_t stride; ///< distance between the numbers of consecutive entries
};

Groups groups_of(const RowLayout &layout, const std::size_t stride)
{
  const auto                                  &start = layout.entry_start();
  std::map<Unknown, std::vector<unsigned int>> entries;
  for (unsigned int row = 0; row < layout.n_owned(); ++row)
    if (layout.node_rows()[row])
      for (unsigned int e = start[row]; e < start[row + 1]; ++e)
        entries[layout.entry_unknowns()[e]].push_back(e);
  Groups groups;
  groups.stride = stride;
  for (unsigned int row = 0; row < layout.n_owned(); ++row)
    groups.row_of_entry.insert(groups.row_of_entry.end(), start[row + 1] - start[row], row);
  std::vector<unsigned int> root;
  for (const auto &[unknown, of_unknown] : entries)
    {
      groups.unknowns.push_back(unknown);
      groups.entries.push_back(of_unknown);
    }
  root.resize(groups.unknowns.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](unsigned int i) {
    while (root[i] != i)
      i = root[i] = root[root[i]];
    return i;
  };
  const unsigned int        none = narrow<unsigned int>(root.size());
  std::vector<unsigned int> unknown_of_row(layout.n_owned(), none);
  for (unsigned int i = 0; i < root.size(); ++i)
    for (const unsigned int e : groups.entries[i])
      {
        const unsigned int row = groups.row_of_entry[e];
        if (unknown_of_row[row] == none)
          unknown_of_row[row] = i;
        // The root is the first member of its group.
        const unsigned int a = find(unknown_of_row[row]), b = find(i);
        root[std::max(a, b)] = std::min(a, b);
      }
  std::map<unsigned int, unsigned int> group_of_root;
  for (unsigned int i = 0; i < root.size(); ++i)
    {
      const auto found =
        group_of_root.emplace(find(i), narrow<unsigned int>(groups.members.size())).first;
      if (found->second == groups.members.size())
        groups.members.emplace_back();
      groups.members[found->second].push_back(i);
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
      for (const unsigned int e : groups.entries[members[k]])
        X(groups.row_of_entry[e], k) = entries[e * groups.stride] * entries[e * groups.stride + 1];
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
  const Unknown         &unknown = groups.unknowns[members[k]];
  JumpColumn             result{unknown.subdomain, unknown.dof, {}, {}};
  std::set<unsigned int> rows;
  for (const unsigned int other : members)
    {
      double sum = 0.;
      for (const unsigned int e : groups.entries[other])
        {
          rows.insert(groups.row_of_entry[e]);
          sum += entries[e * stride] * X(groups.row_of_entry[e], k) * entries[e * stride + 1];
        }
      // B_D' B e_i = D^-1 B' W^-1 B e_i, where X holds W^-1 B D^-1 e_i
      const double D = 1. / entries[groups.entries[members[k]][0] * stride + 1];
      result.copies.push_back(
        {groups.unknowns[other].subdomain, groups.unknowns[other].dof, D * sum});
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
                                       const unsigned int         first,
                                       const unsigned int         n_subdomains)
{
  const MPI_Comm                      comm   = layout.communicator();
  const auto                          groups = groups_of(layout, stride);
  const auto                          X      = row_forces_of(layout, gram, groups, entries);
  const SubdomainRanks                rank_of(first, comm);
  std::map<unsigned int, JumpColumns> out;
  for (const auto &members : groups.members)
    for (unsigned int k = 0; k < members.size(); ++k)
      out[rank_of(groups.unknowns[members[k]].subdomain)].push_back(
        column(layout, groups, entries, X, members, k));
  auto received = dealii::Utilities::MPI::some_to_some(comm, out);
  out.clear(); // the columns take much memory
  std::vector<JumpColumns> result(n_subdomains);
  for (auto &message : received)
    for (JumpColumn &of_unknown : message.second)
      result[of_unknown.subdomain - first].push_back(std::move(of_unknown));
  // Messages arrive rank by rank.
  for (auto &columns : result)
    std::sort(columns.begin(), columns.end(),
              [](const JumpColumn &a, const JumpColumn &b) { return a.dof < b.dof; });
  return result;
}
} // namespace snug::feti
