#include <snug/base/narrow.h>
#include <snug/feti/row_gram.h>
#include <snug/qp/row_set.h>

#include <algorithm>

namespace snug::feti {
namespace {
/// Flag the ties, and the equality rows coupled to a tie by a chain of shared unknowns.
qp::RowSet coupled_to_ties(const qp::RowSet &ties, const RowEntries &entries)
{
  qp::RowSet                coupled = ties;
  std::vector<unsigned int> front;
  for (unsigned int row = 0; row < ties.size(); ++row)
    if (ties[row])
      front.push_back(row);
  while (!front.empty())
    {
      const unsigned int row = front.back();
      front.pop_back();
      for (const unsigned int e : entries.of_row[row])
        for (const unsigned int other : entries.of_unknown[entries.unknown[e]])
          if (const unsigned int next = entries.row[other]; !coupled[next])
            {
              coupled[next] = 1;
              front.push_back(next);
            }
    }
  return coupled;
}
} // namespace

RowGramStructure::RowGramStructure(const RowLayout &layout, const SubdomainTable &table)
  : entries(layout, table, qp::complement(layout.contact_rows()))
  , contact(layout, table, entries)
  , place(layout.n_owned())
{
  for (unsigned int row = 0; row < layout.n_owned(); ++row)
    ties.push_back(!layout.contact_rows()[row] && !layout.node_rows()[row]);
  const auto coupled = coupled_to_ties(ties, entries);
  for (unsigned int row = 0; row < layout.n_owned(); ++row)
    if (!layout.contact_rows()[row])
      {
        Group &group = coupled[row] ? tied : alone;
        place[row]   = narrow<unsigned int>(group.rows.size());
        group.rows.push_back(row);
      }
  for (Group *group : {&alone, &tied})
    {
      std::vector<std::vector<PetscInt>> pattern;
      for (const unsigned int row : group->rows)
        {
          std::vector<PetscInt> columns{PetscInt(place[row])};
          for (const unsigned int e : entries.of_row[row])
            for (const unsigned int other : entries.of_unknown[entries.unknown[e]])
              columns.push_back(place[entries.row[other]]);
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
                 const unsigned int         stride,
                 const std::vector<double> &ground)
  : structure(the_structure)
  , tied_matrix(structure.tied.pattern)
  , contact(structure.contact, entries, stride, ground)
{
  const auto fill = [&](const RowGramStructure::Group &group, CsrMatrix &W) {
    for (unsigned int i = 0; i < W.n_rows(); ++i)
      {
        const unsigned int row = group.rows[i];
        for (const unsigned int a : structure.entries.of_row[row])
          for (const unsigned int b : structure.entries.of_unknown[structure.entries.unknown[a]])
            // Add B_ia B_jb / D of the unknown that both entries share. Entries hold B and 1/D.
            W.values[W.position(i, structure.place[structure.entries.row[b]])] +=
              entries[std::size_t(a) * stride] * entries[std::size_t(b) * stride] *
              entries[std::size_t(a) * stride + 1];
        double &diagonal = W.values[W.position(i, i)];
        if (!ground.empty())
          diagonal += ground[row];
        if (diagonal == 0.)
          diagonal = 1.;
      }
  };
  CsrMatrix alone_matrix(structure.alone.pattern);
  fill(structure.alone, alone_matrix);
  fill(structure.tied, tied_matrix);
  if (!structure.alone.rows.empty())
    alone = structure.factors.factorize(alone_matrix, "B D^-1 B' of the gluing rows");
  if (!structure.tied.rows.empty())
    tied = structure.factors.factorize(tied_matrix, "B D^-1 B' of the rows of ties and springs");
}

void RowGram::solve_groups(const SparseFactor *of_tied, qp::MultiVector &x) const
{
  qp::MultiVector result(x.n_rows(), x.n_columns());
  const auto      solve = [&](const RowGramStructure::Group &group, const SparseFactor *factor) {
    if (factor == nullptr)
      return;
    qp::MultiVector b = rows_of(x, group.rows), y = b;
    factor->solve(b, y);
    for (unsigned int k = 0; k < x.n_columns(); ++k)
      for (unsigned int i = 0; i < group.rows.size(); ++i)
        result(group.rows[i], k) = y(i, k);
  };
  solve(structure.alone, alone.get());
  solve(structure.tied, of_tied);
  x = std::move(result);
}

void RowGram::solve_equalities(qp::MultiVector &x) const
{
  solve_groups(tied.get(), x);
}

void RowGram::solve_node_rows(qp::MultiVector &x) const
{
  std::shared_ptr<const SparseFactor> without_ties;
  if (tied)
    {
      CsrMatrix matrix = tied_matrix;
      for (unsigned int i = 0; i < matrix.n_rows(); ++i)
        for (PetscInt p = matrix.row_start()[i]; p < matrix.row_start()[i + 1]; ++p)
          {
            const unsigned int j = matrix.columns()[p];
            if (structure.ties[structure.tied.rows[i]] || structure.ties[structure.tied.rows[j]])
              matrix.values[p] = i == j ? 1. : 0.;
          }
      without_ties = structure.factors.factorize(matrix, "B D^-1 B' of the gluing rows");
      for (unsigned int k = 0; k < x.n_columns(); ++k)
        for (unsigned int row = 0; row < x.n_rows(); ++row)
          if (structure.ties[row])
            x(row, k) = 0.;
    }
  solve_groups(without_ties.get(), x);
}

/// Eliminate the equality rows E, which are always in M:
/// x_C <- S_M^-1 (x_C - W_CE W_EE^-1 x_E), x_E <- W_EE^-1 (x_E - W_EC x_C).
void RowGram::solve(const qp::FreeRows &free, qp::MultiVector &x) const
{
  free.restrict(x);
  auto of_equalities = x;
  solve_equalities(of_equalities);
  if (structure.contact.any)
    {
      x.add(-1., contact.from_equalities(of_equalities));
      free.restrict(x);
      contact.solve(free, x);
      auto back = contact.to_equalities(x);
      solve_equalities(back);
      of_equalities.add(-1., back);
      for (unsigned int k = 0; k < x.n_columns(); ++k)
        for (unsigned int row = 0; row < x.n_rows(); ++row)
          if (structure.contact.rows_of_contact[row])
            of_equalities(row, k) = x(row, k);
    }
  x = std::move(of_equalities);
}
} // namespace snug::feti
