#include <snug/base/narrow.h>
#include <snug/feti/row_gram.h>

#include <algorithm>
#include <map>

namespace snug::feti {
namespace {
/// Part of the diagonal that is added to W for contact rows beside ties. Two of these rows depend
/// on each other and on ties where the edge of two tied bodies lies opposite to a slave node.
const double beside_ties_shift = 1e-3;

/// Flag the contact rows, and the rows coupled to a contact row by a chain of shared unknowns.
std::vector<bool> coupled_to_contact(const qp::RowSet                             &contact_rows,
                                     const std::vector<std::vector<unsigned int>> &rows_of_unknown,
                                     const std::vector<std::vector<unsigned int>> &unknowns_of_row)
{
  std::vector<bool>         coupled(contact_rows.size(), false);
  std::vector<unsigned int> front;
  for (unsigned int row = 0; row < contact_rows.size(); ++row)
    if (contact_rows[row])
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

RowGramStructure::RowGramStructure(const RowLayout &layout, const SubdomainTable &table)
{
  if (qp::any(std::count(layout.tie_rows().begin(), layout.tie_rows().end(), 1) > 0,
              layout.communicator()))
    beside_ties = layout.contact_rows();
  const auto                                &start    = layout.entry_start();
  const auto                                &unknowns = layout.entry_unknowns();
  std::map<RowLayout::Unknown, unsigned int> index;
  std::vector<std::vector<unsigned int>>     unknowns_of_row(layout.n_owned());
  std::vector<std::vector<unsigned int>>     rows_of_unknown;
  for (unsigned int row = 0; row < layout.n_owned(); ++row)
    for (unsigned int e = start[row]; e < start[row + 1]; ++e)
      {
        row_of_entry.push_back(row);
        // The motion of a rigid body would couple all of its rows, but has no weight in W.
        if (table.is_rigid(unknowns[e].subdomain))
          continue;
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
      }
  // A contact row that leaves M changes W_M^-1 on all rows that its block couples. Only these
  // blocks must be factorized again when the set changes. Gluing rows elsewhere keep their factor.
  const auto coupled = coupled_to_contact(layout.contact_rows(), rows_of_unknown, unknowns_of_row);
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
          std::vector<PetscInt> columns{PetscInt(place[row].second)};
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
                 const unsigned int         stride,
                 const std::vector<double> &ground)
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
  for (unsigned int row = 0; row < ground.size(); ++row)
    {
      const auto [in_contact, i] = structure.place[row];
      auto &A                    = in_contact ? contact : of_fixed;
      A.values[A.position(i, i)] += ground[row];
    }
  for (unsigned int row = 0; row < structure.beside_ties.size(); ++row)
    if (structure.beside_ties[row])
      {
        const auto i = structure.place[row].second;
        contact.values[contact.position(i, i)] *= 1. + beside_ties_shift;
      }
  for (CsrMatrix *A : {&contact, &of_fixed})
    for (unsigned int i = 0; i < A->n_rows(); ++i)
      if (double &diagonal = A->values[A->position(i, i)]; diagonal == 0.)
        diagonal = 1.;
  if (!structure.fixed.rows.empty())
    fixed = structure.factors.factorize(of_fixed, "B D^-1 B' of the gluing rows");
}

RowGram::Factor::Factor(const RowGram &the_gram, const qp::FreeRows &the_free)
  : gram(the_gram), free(the_free), rows(the_free.rows())
{
  const auto &numbers = gram.structure.contact.rows;
  if (numbers.empty())
    return;
  for (const qp::Slip &slip : free.slips())
    if (slip.cone.n_tangents == 2)
      rows[slip.cone.tangents[0]] = 1;
  CsrMatrix matrix = turned(gram.contact);
  for (unsigned int i = 0; i < matrix.n_rows(); ++i)
    for (PetscInt p = matrix.row_start()[i]; p < matrix.row_start()[i + 1]; ++p)
      {
        const unsigned int j = matrix.columns()[p];
        if (!rows[numbers[i]] || !rows[numbers[j]])
          // Replace rows outside M by those of the identity, so that the pattern and its symbolic
          // factorization serve all sets.
          matrix.values[p] = i == j ? 1. : 0.;
      }
  W = gram.structure.factors.factorize(matrix,
                                       "B D^-1 B' of the contact rows (are two contact rows the "
                                       "same?)");
}

/// Return Q'WQ with the rotation Q of each pair of tangential rows to the directions across and
/// along the slip. Both rows of a pair have the same pattern, so the pattern does not change.
CsrMatrix RowGram::Factor::turned(CsrMatrix matrix) const
{
  for (const qp::Slip &slip : free.slips())
    {
      if (slip.cone.n_tangents < 2)
        continue;
      const auto &place = gram.structure.place;
      const auto  a = place[slip.cone.tangents[0]].second, b = place[slip.cone.tangents[1]].second;
      const auto  across = slip.across(), along = slip.direction;
      const auto  turn = [&](double &of_a, double &of_b) {
        const double first = across[0] * of_a + across[1] * of_b;
        of_b               = along[0] * of_a + along[1] * of_b;
        of_a               = first;
      };
      const auto &start = matrix.row_start();
      for (PetscInt k = 0; k < start[a + 1] - start[a]; ++k)
        turn(matrix.values[start[a] + k], matrix.values[start[b] + k]);
      for (PetscInt k = start[a]; k < start[a + 1]; ++k)
        {
          const auto j = matrix.columns()[k];
          turn(matrix.values[matrix.position(j, a)], matrix.values[matrix.position(j, b)]);
        }
    }
  return matrix;
}

void RowGram::Factor::solve(qp::MultiVector &x) const
{
  // Rows outside M are set to zero, because the identity rows would return them unchanged.
  free.restrict(x);
  for (const qp::Slip &slip : free.slips())
    for (unsigned int k = 0; slip.cone.n_tangents == 2 && k < x.n_columns(); ++k)
      {
        const auto [a, b] = slip.cone.tangents;
        x(a, k)           = slip.across()[0] * x(a, k) + slip.across()[1] * x(b, k);
        x(b, k)           = 0.;
      }
  // Equality rows are always in M, so the factor of the fixed group serves all faces.
  if (gram.fixed)
    solve_group(gram.structure.fixed, *gram.fixed, x);
  if (W)
    solve_group(gram.structure.contact, *W, x);
  for (const qp::Slip &slip : free.slips())
    for (unsigned int k = 0; slip.cone.n_tangents == 2 && k < x.n_columns(); ++k)
      for (const unsigned int t : {1u, 0u})
        x(slip.cone.tangents[t], k) = slip.across()[t] * x(slip.cone.tangents[0], k);
}
} // namespace snug::feti
