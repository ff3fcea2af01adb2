#include <snug/feti/contact_nodes.h>
#include <snug/feti/subdomain_ranks.h>
#include <snug/qp/row_set.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>

namespace snug::feti {
using Unknown = RowLayout::Unknown;

struct ContactNodes::Met
{
  Unknown      unknown;
  unsigned int row;    ///< global row
  unsigned int number; ///< of the entry among those of all ranks

  bool operator<(const Met &other) const
  {
    return std::tie(unknown, row) < std::tie(other.unknown, other.row);
  }
};

RowEntries::RowEntries(const RowLayout &layout, const SubdomainTable &table, const qp::RowSet &rows)
{
  const auto &start = layout.entry_start();
  for (unsigned int r = 0; r < layout.n_owned(); ++r)
    {
      for (unsigned int e = start[r]; e < start[r + 1]; ++e)
        {
          row.push_back(r);
          const Unknown &of_entry = layout.entry_unknowns()[e];
          if (!rows[r] || table.is_rigid(of_entry.subdomain))
            continue;
          of_row.numbers.push_back(e);
          unknowns.push_back(of_entry);
        }
      of_row.start.push_back(narrow<unsigned int>(of_row.numbers.size()));
    }
  std::sort(unknowns.begin(), unknowns.end());
  const auto same = [](const Unknown &a, const Unknown &b) { return !(a < b); };
  unknowns.erase(std::unique(unknowns.begin(), unknowns.end(), same), unknowns.end());
  unknowns.shrink_to_fit();
  for (const Unknown &of_entry : layout.entry_unknowns())
    unknown.push_back(place(of_entry));
  of_unknown.start.assign(unknowns.size() + 1, 0);
  for (const unsigned int e : of_row.numbers)
    ++of_unknown.start[unknown[e] + 1];
  std::partial_sum(of_unknown.start.begin(), of_unknown.start.end(), of_unknown.start.begin());
  of_unknown.numbers.resize(of_row.numbers.size());
  auto next = of_unknown.start;
  for (const unsigned int e : of_row.numbers)
    of_unknown.numbers[next[unknown[e]]++] = e;
}

unsigned int RowEntries::place(const Unknown &of_entry) const
{
  const auto found = std::lower_bound(unknowns.begin(), unknowns.end(), of_entry);
  return narrow<unsigned int>(
    (found == unknowns.end() || of_entry < *found ? unknowns.end() : found) - unknowns.begin());
}

/// Send the entries of contact rows to the ranks of their subdomains, and from there to the ranks
/// that own equality rows of their unknowns. Return those that arrive, sorted. Collective.
std::vector<ContactNodes::Met> ContactNodes::meet(const RowLayout        &layout,
                                                  const SubdomainTable   &table,
                                                  const RowEntries       &equalities,
                                                  const std::vector<Met> &mine)
{
  using Numbers          = std::map<unsigned int, std::vector<unsigned int>>; // by rank
  const MPI_Comm comm    = layout.communicator();
  const auto     receive = [&](const Numbers &out) {
    return dealii::Utilities::MPI::some_to_some(comm, out);
  };
  const auto append = [](const Met &met, std::vector<unsigned int> &numbers) {
    numbers.insert(numbers.end(), {met.unknown.subdomain, met.unknown.dof, met.row, met.number});
  };
  const auto all_met = [](const Numbers &received) {
    std::vector<Met> result;
    for (const auto &message : received)
      for (std::size_t i = 0; i < message.second.size(); i += 4)
        result.push_back({{message.second[i], message.second[i + 1]},
                          message.second[i + 2],
                          message.second[i + 3]});
    return result;
  };
  const SubdomainRanks rank_of(table.first, comm);
  const unsigned int   me = dealii::Utilities::MPI::this_mpi_process(comm);
  Numbers              owned, out, forwarded;
  for (const Unknown &unknown : equalities.unknowns)
    if (const unsigned int rank = rank_of(unknown.subdomain); rank != me)
      owned[rank].insert(owned[rank].end(), {unknown.subdomain, unknown.dof});
  std::map<Unknown, unsigned int> rank_of_node; // where another rank owns the equality rows
  for (const auto &message : receive(owned))
    for (std::size_t i = 0; i < message.second.size(); i += 2)
      rank_of_node[{message.second[i], message.second[i + 1]}] = message.first;
  for (const Met &met : mine)
    append(met, out[rank_of(met.unknown.subdomain)]);
  for (const Met &met : all_met(receive(out)))
    {
      const auto found = rank_of_node.find(met.unknown);
      append(met, forwarded[found == rank_of_node.end() ? me : found->second]);
    }
  auto result = all_met(receive(forwarded));
  std::sort(result.begin(), result.end());
  return result;
}

ContactNodes::ContactNodes(const RowLayout      &layout,
                           const SubdomainTable &table,
                           const RowEntries     &equalities)
  : communicator(layout.communicator())
  , rows_of_contact(layout.contact_rows())
  , on_rigid(layout.n_owned(), 0)
{
  any = qp::any(std::count(rows_of_contact.begin(), rows_of_contact.end(), 1) > 0, communicator);
  if (!any)
    return;
  std::vector<Met> mine;
  for (unsigned int e = 0; e < equalities.row.size(); ++e)
    if (const unsigned int row = equalities.row[e]; rows_of_contact[row])
      {
        const Unknown &unknown = layout.entry_unknowns()[e];
        if (table.is_rigid(unknown.subdomain))
          {
            on_rigid[row] = 1;
            continue;
          }
        mine.push_back({unknown, layout.global_row(row), 0});
        sent.push_back(e);
      }
  const auto first = RowExchange::first_of_ranks(communicator, narrow<unsigned int>(sent.size()));
  const unsigned int me = dealii::Utilities::MPI::this_mpi_process(communicator);
  for (unsigned int i = 0; i < mine.size(); ++i)
    mine[i].number = first[me] + i;
  const auto met = meet(layout, table, equalities, mine);

  std::vector<unsigned int> numbers, global_rows;
  for (const Met &entry : met)
    {
      numbers.push_back(entry.number);
      global_rows.push_back(entry.row);
    }
  entries = RowExchange(communicator, first, numbers);
  std::sort(global_rows.begin(), global_rows.end());
  global_rows.erase(std::unique(global_rows.begin(), global_rows.end()), global_rows.end());
  n_rows = narrow<unsigned int>(global_rows.size());
  rows   = RowExchange(communicator, layout.first_of_rank(), global_rows);
  std::vector<bool> visited(met.size(), false);
  for (unsigned int i = 0; i < met.size(); ++i)
    if (!visited[i])
      add_node(layout, equalities, met, global_rows, met[i].unknown, visited);
}

/// Add the node of all unknowns that node rows connect with the unknown @p first.
void ContactNodes::add_node(const RowLayout                 &layout,
                            const RowEntries                &equalities,
                            const std::vector<Met>          &met,
                            const std::vector<unsigned int> &global_rows,
                            const Unknown                   &first,
                            std::vector<bool>               &visited)
{
  Node                            node{1, {}, {}, {}};
  std::map<Unknown, unsigned int> unknowns{{first, 0}};
  std::vector<Unknown>            front{first};
  while (!front.empty())
    {
      const Unknown      here = front.back();
      const unsigned int at = equalities.place(here), place = unknowns.at(here);
      front.pop_back();
      if (at == equalities.unknowns.size())
        continue;
      for (const unsigned int e : equalities.of_unknown[at])
        {
          const unsigned int row = equalities.row[e];
          if (!layout.node_rows()[row])
            {
              node.of_ties.push_back({row, place, e});
              continue;
            }
          node.of_node_rows.push_back({row, place, e});
          for (const unsigned int other : equalities.of_row[row])
            if (const Unknown &unknown = layout.entry_unknowns()[other];
                unknowns.emplace(unknown, node.n_unknowns).second)
              {
                ++node.n_unknowns;
                front.push_back(unknown);
              }
        }
    }
  for (const auto &[unknown, place] : unknowns)
    for (auto k = std::lower_bound(met.begin(), met.end(), Met{unknown, 0, 0});
         k != met.end() && !(unknown < k->unknown); ++k)
      {
        const auto row           = std::lower_bound(global_rows.begin(), global_rows.end(), k->row);
        visited[k - met.begin()] = true;
        node.of_contacts.push_back({narrow<unsigned int>(row - global_rows.begin()), place,
                                    narrow<unsigned int>(k - met.begin())});
      }
  for (auto *list : {&node.of_node_rows, &node.of_ties, &node.of_contacts})
    std::stable_sort(list->begin(), list->end(),
                     [](const Entry &a, const Entry &b) { return a.row < b.row; });
  nodes.push_back(std::move(node));
}
} // namespace snug::feti
