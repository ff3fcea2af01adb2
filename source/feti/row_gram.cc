#include <snug/base/narrow.h>
#include <snug/feti/row_gram.h>

#include <algorithm>
#include <map>

namespace snug::feti {
namespace {
/// Flag the contact rows, and the rows coupled to a contact row by a chain of shared unknowns.
std::vector<bool> coupled_to_contact(const qp::RowSet                             &bounded,
                                     const std::vector<std::vector<unsigned int>> &rows_of_unknown,
                                     const std::vector<std::vector<unsigned int>> &unknowns_of_row)
{
  std::vector<bool>         coupled(bounded.size(), false);
  std::vector<unsigned int> front;
  for (unsigned int row = 0; row < bounded.size(); ++row)
    if (bounded[row])
      {
        coupled[row] = true;
        front.push_back(row);
      }
  while (!front.empty())
    {
      const unsigned int row = front.back();
      front.pop_back();
      for (const unsigned int unknown : unknowns_of_row[row])
        for (const unsigned int next : rows_of_unknown[unknown])
          if (!coupled[next])
            {
              coupled[next] = true;
              front.push_back(next);
            }
    }
  return coupled;
}

/// Set x <- A^-1 x on the rows of the group. The other rows are not changed.
void solve_group(const RowGramStructure::Group &group,
                 const SparseFactor            &factor,
                 qp::MultiVector               &x)
{
  qp::MultiVector b = rows_of(x, group.rows), y = b;
  factor.solve(b, y);
  for (unsigned int k = 0; k < x.n_columns(); ++k)
    for (unsigned int i = 0; i < group.rows.size(); ++i)
      x(group.rows[i], k) = y(i, k);
}
} // namespace

RowGramStructure::RowGramStructure(const RowLayout &layout)
{
  const auto                                &start    = layout.entry_start();
  const auto                                &unknowns = layout.entry_unknowns();
  std::map<RowLayout::Unknown, unsigned int> index;
  std::vector<std::vector<unsigned int>>     unknowns_of_row(layout.n_owned());
  std::vector<std::vector<unsigned int>>     rows_of_unknown;
  for (unsigned int row = 0; row < layout.n_owned(); ++row)
    for (unsigned int e = start[row]; e < start[row + 1]; ++e)
      {
        // Unknowns are numbered in the order of the rows. Rows that share an unknown have one owner
        // (RowLayout), so W is block diagonal over ranks, and each rank factorizes its own part.
        const auto found = index.emplace(unknowns[e], unsigned(index.size())).first;
        if (found->second == entries_of_unknown.size())
          {
            entries_of_unknown.emplace_back();
            rows_of_unknown.emplace_back();
          }
        entries_of_unknown[found->second].push_back(e);
        rows_of_unknown[found->second].push_back(row);
        unknowns_of_row[row].push_back(found->second);
        row_of_entry.push_back(row);
      }
  // A contact row that leaves M changes W_M^-1 on all rows that its block couples. Only these
  // blocks must be factorized again when the set changes. Gluing rows elsewhere keep their factor.
  const auto coupled = coupled_to_contact(layout.bounded(), rows_of_unknown, unknowns_of_row);
  for (unsigned int row = 0; row < layout.n_owned(); ++row)
    {
      Group &group = coupled[row] ? contact : fixed;
      place.emplace_back(coupled[row], group.rows.size());
      group.rows.push_back(row);
    }
  for (Group *group : {&fixed, &contact})
    {
      std::vector<std::vector<PetscInt>> pattern;
      for (const unsigned int row : group->rows)
        {
          std::vector<PetscInt> columns;
          for (const unsigned int unknown : unknowns_of_row[row])
            for (const unsigned int other : rows_of_unknown[unknown])
              columns.push_back(place[other].second);
          std::sort(columns.begin(), columns.end());
          columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
          pattern.push_back(columns);
        }
      group->pattern =
        CsrMatrix::from_rows(pattern, narrow<unsigned int>(group->rows.size())).pattern();
    }
}

RowGram::RowGram(const RowGramStructure    &the_structure,
                 const std::vector<double> &entries,
                 const unsigned int         stride)
  : structure(the_structure), contact(structure.contact.pattern)
{
  CsrMatrix of_fixed(structure.fixed.pattern);
  for (const auto &sharing : structure.entries_of_unknown)
    for (const unsigned int a : sharing)
      for (const unsigned int b : sharing)
        {
          const auto i = structure.place[structure.row_of_entry[a]];
          const auto j = structure.place[structure.row_of_entry[b]];
          auto      &A = i.first ? contact : of_fixed;
          // Add B_ia B_jb / D of the unknown that both entries share. Entries hold B and 1/D.
          A.values[A.position(i.second, j.second)] += entries[std::size_t(a) * stride] *
                                                      entries[std::size_t(b) * stride] *
                                                      entries[std::size_t(a) * stride + 1];
        }
  if (!structure.fixed.rows.empty())
    fixed = structure.factors.factorize(of_fixed, "B D^-1 B' of the gluing rows");
}

RowGram::Factor::Factor(const RowGram &the_gram, const qp::RowSet &the_free)
  : gram(the_gram), free(the_free)
{
  const auto &rows = gram.structure.contact.rows;
  if (rows.empty())
    return;
  CsrMatrix matrix = gram.contact;
  for (unsigned int i = 0; i < matrix.n_rows(); ++i)
    for (PetscInt p = matrix.row_start()[i]; p < matrix.row_start()[i + 1]; ++p)
      {
        const unsigned int j = matrix.columns()[p];
        if (!free[rows[i]] || !free[rows[j]])
          // Replace rows outside M by those of the identity, so that the pattern and its symbolic
          // factorization serve all sets.
          matrix.values[p] = i == j ? 1. : 0.;
      }
  W = gram.structure.factors.factorize(matrix,
                                       "B D^-1 B' of the contact rows (are two contact rows the "
                                       "same?)");
}

void RowGram::Factor::solve(qp::MultiVector &x) const
{
  for (unsigned int k = 0; k < x.n_columns(); ++k)
    for (unsigned int row = 0; row < x.n_rows(); ++row)
      // Rows outside M are set to zero, because the identity rows would return them unchanged.
      if (!free[row])
        x(row, k) = 0.;
  // Equality rows are always in M, so the factor of the fixed group serves all faces.
  if (gram.fixed)
    solve_group(gram.structure.fixed, *gram.fixed, x);
  if (W)
    solve_group(gram.structure.contact, *W, x);
}
} // namespace snug::feti
