#include <snug/base/narrow.h>
#include <snug/feti/couplings.h>
#include <snug/feti/deflation.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace snug::feti {
namespace {
/// Shift of the diagonal of E, relative to the diagonal. It makes E definite if some vectors lie in
/// the span of the others.
const double shift = 1e-12;

/// Add the rows of @p x to the rows @p numbers of @p a.
void add_to_rows(const std::vector<unsigned int> &numbers,
                 const qp::MultiVector           &x,
                 qp::MultiVector                 &a)
{
  for (unsigned int k = 0; k < a.n_columns(); ++k)
    for (unsigned int i = 0; i < numbers.size(); ++i)
      a(numbers[i], k) += x(i, k);
}
/// Vectors first_id to end_id reach a subdomain.
struct Reach
{
  unsigned int subdomain, first_id, end_id;

  template <typename Archive>
  void serialize(Archive &archive, unsigned int)
  {
    archive & subdomain & first_id & end_id;
  }
};

/// Return the part of the vector @p v of the soft modes @p raw on the rows of its neighbourhood.
std::vector<double>
values_on(const NeighbourhoodRows &rows, const RowForces &raw, const unsigned int v)
{
  std::vector<double> c(rows.n_rows(), 0.);
  unsigned int        j = 0;
  for (unsigned int i = 0; i < rows.n_rows(); ++i)
    {
      // the rows of both are ascending
      while (j < raw.rows.size() && raw.rows[j] < rows.begin(i)->row)
        ++j;
      if (j < raw.rows.size() && raw.rows[j] == rows.begin(i)->row)
        c[i] = raw.values(j, v);
    }
  return c;
}
} // namespace

DeflationStructure::DeflationStructure(const CoarseStructure &the_coarse,
                                       const unsigned int     n_subdomains,
                                       std::vector<RowForces> the_raw,
                                       const unsigned int     coarse_ranks,
                                       const qp::RowSet      &rows)
  : coarse(the_coarse)
  , rank_of(coarse.table.first, coarse.layout.communicator())
  , raw(std::move(the_raw))
  , parts(n_subdomains)
{
  const MPI_Comm comm = coarse.layout.communicator();
  unsigned int   mine = 0;
  for (const RowForces &of_subdomain : raw)
    mine += of_subdomain.values.n_columns();
  // Ids are in the order of the subdomains, which is the order of the ranks.
  MPI_Scan(&mine, &first_id, 1, MPI_UNSIGNED, MPI_SUM, comm);
  first_id -= mine;
  n_vectors = dealii::Utilities::MPI::sum(mine, comm);
  if (n_vectors == 0)
    return;
  // Use CHOLMOD whatever the package of the stiffness is, as for the coarse problem, because the
  // problem is replicated. A group of ranks factorizes by MUMPS instead.
  factors = FactorPool(MatrixKind::soft_modes, Factorization::CHOLMOD, nullptr, nullptr,
                       coarse_group(comm, n_vectors, MatrixKind::soft_modes, coarse_ranks));
  count_subdomains(rows);
  find_parts();
  build_pattern();
}

/// Find the number of subdomains of each of the @p rows, and the lowest of these subdomains.
void DeflationStructure::count_subdomains(const qp::RowSet &rows)
{
  const RowLayout &layout = coarse.layout;
  qp::MultiVector  owned(layout.n_owned(), 2);
  for (unsigned int row = 0; row < layout.n_owned(); ++row)
    if (rows[row])
      {
        const auto &unknowns = layout.entry_unknowns();
        const auto  begin = layout.entry_start()[row], end = layout.entry_start()[row + 1];
        for (unsigned int e = begin; e < end; ++e)
          owned(row, 0) += e == begin || unknowns[e].subdomain != unknowns[e - 1].subdomain;
        owned(row, 1) = unknowns[begin].subdomain;
      }
  const auto         local = layout.to_local(owned);
  const unsigned int first = coarse.table.first;
  for (unsigned int row = 0; row < layout.n_local(); ++row)
    {
      multiplicity.push_back(static_cast<unsigned int>(local(row, 0)));
      const auto lowest = static_cast<unsigned int>(local(row, 1));
      if (multiplicity.back() > 0 && lowest >= first && lowest - first < parts.size())
        parts[lowest - first].rows.push_back(row);
    }
}

/// Tell the rank of each subdomain which vectors reach the subdomain.
void DeflationStructure::find_parts()
{
  std::map<unsigned int, std::vector<Reach>> out;
  unsigned int                               id = first_id;
  for (const RowForces &of_subdomain : raw)
    {
      const unsigned int end = id + of_subdomain.values.n_columns();
      for (const unsigned int t : of_subdomain.neighbourhood)
        out[rank_of(t)].push_back({t, id, end});
      id = end;
    }
  // Messages are sorted by rank, and ids ascend with the ranks.
  for (const auto &message :
       dealii::Utilities::MPI::some_to_some(coarse.layout.communicator(), out))
    for (const Reach &reach : message.second)
      {
        Part &part = parts[reach.subdomain - coarse.table.first];
        part.wanted_by.insert(message.first);
        for (unsigned int i = reach.first_id; i < reach.end_id; ++i)
          part.ids.push_back(i);
      }
}

void DeflationStructure::build_pattern()
{
  Couplings couplings;
  for (const Part &part : parts)
    for (const unsigned int i : part.ids)
      for (const unsigned int j : part.ids)
        couplings.insert({i, j});
  E = std::make_shared<const CsrPattern>(couplings.unite(n_vectors, coarse.layout.communicator()));
}

DeflationVectors::DeflationVectors(const DeflationStructure           &the_structure,
                                   const std::vector<SubdomainSystem> &systems,
                                   const ConstraintRows               &B,
                                   const FactorsOfSubdomains          &factors)
  : structure(the_structure), parts(systems.size())
{
  const auto                   values = balanced_vectors(gather_rows(systems, B));
  std::vector<qp::MultiVector> products(systems.size());
  for (unsigned int s = 0; s < systems.size(); ++s)
    {
      if (structure.parts[s].ids.empty())
        continue;
      const auto      found  = values.find(structure.coarse.table.first + s);
      const auto      forces = store(s, systems[s].n_dofs(), B[s],
                                found == values.end() ? std::vector<Value>() : found->second);
      qp::MultiVector motions(forces.n_rows(), forces.n_columns());
      factors[s]->inverse.apply(forces, motions);
      products[s] = transpose_times(forces, motions);
      parts[s].X  = on_boundary(motions, *factors[s]->schur);
    }
  factorize(products);
}

/// Gather the rows of the subdomains in all neighbourhoods of this rank.
DeflationVectors::Copies DeflationVectors::gather_rows(const std::vector<SubdomainSystem> &systems,
                                                       const ConstraintRows               &B) const
{
  const SubdomainTable                        &table = structure.coarse.table;
  std::map<unsigned int, std::vector<RowCopy>> out;
  for (unsigned int t = 0; t < systems.size(); ++t)
    {
      if (structure.parts[t].wanted_by.empty())
        continue;
      std::map<unsigned int, RowCopy> copies; // by local row
      for (const BEntry &entry : B[t])
        if (const unsigned int m = structure.multiplicity[entry.row]; m > 0)
          {
            // a new copy has G = 0
            auto &copy        = copies.try_emplace(entry.row).first->second;
            copy.row          = structure.coarse.layout.global_row_of_local(entry.row);
            copy.multiplicity = m;
            copy.subdomain    = table.first + t;
            for (unsigned int k = 0; k < table.n_modes; ++k)
              copy.G[k] += entry.value * systems[t].R(entry.dof, k);
          }
      for (const unsigned int rank : structure.parts[t].wanted_by)
        for (const auto &copy : copies)
          out[rank].push_back(copy.second);
    }
  Copies result;
  for (const auto &message :
       dealii::Utilities::MPI::some_to_some(structure.coarse.layout.communicator(), out))
    for (const RowCopy &copy : message.second)
      result[copy.subdomain].push_back(copy);
  return result;
}

/// Return the values of C on the rows of the subdomains of this rank, with ascending ids.
DeflationVectors::Values DeflationVectors::balanced_vectors(const Copies &copies) const
{
  std::map<unsigned int, std::vector<Value>> out;
  unsigned int                               id = structure.first_id;
  for (const RowForces &raw : structure.raw)
    {
      std::vector<RowCopy> all;
      for (const unsigned int member : raw.neighbourhood)
        if (const auto of_member = copies.find(member); of_member != copies.end())
          all.insert(all.end(), of_member->second.begin(), of_member->second.end());
      const NeighbourhoodRows rows(std::move(all), raw.neighbourhood,
                                   structure.coarse.table.n_modes);
      for (unsigned int v = 0; v < raw.values.n_columns(); ++v, ++id)
        {
          auto c = values_on(rows, raw, v);
          rows.balance(c);
          for (unsigned int i = 0; i < rows.n_rows(); ++i)
            for (const RowCopy *copy = rows.begin(i); copy != rows.end(i); ++copy)
              out[structure.rank_of(copy->subdomain)].push_back(
                {copy->subdomain, id, copy->row, c[i]});
        }
    }
  // Messages are sorted by rank, and ids ascend with the ranks.
  Values result;
  for (const auto &message :
       dealii::Utilities::MPI::some_to_some(structure.coarse.layout.communicator(), out))
    for (const Value &value : message.second)
      result[value.subdomain].push_back(value);
  return result;
}

/// Store the values of C of subdomain s of this rank. @return B'C
qp::MultiVector DeflationVectors::store(const unsigned int         s,
                                        const unsigned int         n_dofs,
                                        const std::vector<BEntry> &B,
                                        const std::vector<Value>  &values)
{
  const auto     &rows = structure.parts[s].rows;
  qp::MultiVector forces(n_dofs, 0), c(structure.coarse.layout.n_local());
  parts[s].C = qp::MultiVector(narrow<unsigned int>(rows.size()), 0);
  auto begin = values.begin();
  for (const unsigned int id : structure.parts[s].ids)
    {
      const auto end =
        std::find_if(begin, values.end(), [id](const Value &value) { return value.id != id; });
      for (auto value = begin; value != end; ++value)
        c(structure.coarse.layout.local_row(value->row)) = value->value;
      qp::MultiVector force(n_dofs);
      add_transposed(B, c, force);
      parts[s].C.append(rows_of(c, rows));
      forces.append(force);
      for (auto value = begin; value != end; ++value)
        c(structure.coarse.layout.local_row(value->row)) = 0.;
      begin = end;
    }
  return forces;
}

/// Assemble E, scale E to unit diagonal, add the shift and factorize.
void DeflationVectors::factorize(const std::vector<qp::MultiVector> &products)
{
  CsrMatrix matrix(structure.E);
  for (unsigned int s = 0; s < parts.size(); ++s)
    {
      const auto &ids = structure.parts[s].ids;
      for (unsigned int i = 0; i < ids.size(); ++i)
        for (unsigned int j = 0; j < ids.size(); ++j)
          matrix.values[matrix.position(ids[i], ids[j])] += products[s](i, j);
    }
  sum_over_ranks(matrix.values, structure.coarse.layout.communicator());
  scale.assign(structure.n_vectors, 1.);
  for (unsigned int i = 0; i < scale.size(); ++i)
    // the diagonal is zero for a vector that balance() has set to zero
    if (const double diagonal = matrix.diagonal(i); diagonal > 0.)
      scale[i] = 1. / std::sqrt(diagonal);
  for (unsigned int i = 0; i < scale.size(); ++i)
    for (PetscInt p = matrix.row_start()[i]; p < matrix.row_start()[i + 1]; ++p)
      matrix.values[p] *= scale[i] * scale[matrix.columns()[p]];
  for (unsigned int i = 0; i < scale.size(); ++i)
    matrix.values[matrix.position(i, i)] = 1. + shift;
  // Disable the check for large solutions, because the shift permits solutions of size 1/shift.
  E = structure.factors.factorize(matrix, "the coarse problem of the soft modes",
                                  std::numeric_limits<double>::infinity());
}

/// The shift leaves a part of C'r, which no later direction could remove, because all directions
/// are F-orthogonal to C. One step of iterative refinement removes this part; its residual is shift
/// y.
qp::MultiVector DeflationVectors::solve(const qp::MultiVector &b) const
{
  qp::MultiVector scaled = b, y(structure.n_vectors, b.n_columns()), left = y;
  const auto      rescale = [&](qp::MultiVector &x) {
    for (unsigned int k = 0; k < x.n_columns(); ++k)
      for (unsigned int i = 0; i < scale.size(); ++i)
        x(i, k) *= scale[i];
  };
  rescale(scaled);
  E->solve(scaled, y);
  left.add(shift, y);
  E->solve(left, scaled);
  y.add(1., scaled);
  rescale(y);
  return y;
}

Deflation::Deflation(const RowLayout                        &the_layout,
                     std::shared_ptr<const DeflationVectors> the_vectors,
                     const ConstraintRows                   &B,
                     const FactorsOfSubdomains              &factors)
  : layout(the_layout)
  , vectors(std::move(the_vectors))
  , structure(vectors->structure)
  , rows(B.size())
{
  for (unsigned int s = 0; s < B.size(); ++s)
    if (!structure.parts[s].ids.empty())
      {
        rows[s] = B[s];
        for (BEntry &entry : rows[s])
          entry.dof = factors[s]->schur->boundary_position()[entry.dof];
      }
}

/// Return C y.
qp::MultiVector Deflation::multiply(const qp::MultiVector &y) const
{
  qp::MultiVector local(layout.n_local(), y.n_columns());
  for (unsigned int s = 0; s < rows.size(); ++s)
    if (const auto &ids = structure.parts[s].ids; !ids.empty())
      {
        const auto c = times(vectors->parts[s].C, rows_of(y, ids));
        for (unsigned int k = 0; k < y.n_columns(); ++k)
          for (unsigned int i = 0; i < structure.parts[s].rows.size(); ++i)
            local(structure.parts[s].rows[i], k) = c(i, k);
      }
  return layout.to_owned(local);
}

std::vector<double> Deflation::orthogonalize(qp::MultiVector &x) const
{
  const auto      local = layout.to_local(x);
  qp::MultiVector a(structure.n_vectors, x.n_columns()); // (F C)'x
  for (unsigned int s = 0; s < rows.size(); ++s)
    if (const auto &ids = structure.parts[s].ids; !ids.empty())
      {
        qp::MultiVector forces(vectors->parts[s].X.n_rows(), x.n_columns());
        add_transposed(rows[s], local, forces);
        add_to_rows(ids, transpose_times(vectors->parts[s].X, forces), a);
      }
  sum_over_ranks(a, layout.communicator());
  const auto y = vectors->solve(a);
  x.add(-1., multiply(y));
  std::vector<double> removed(x.n_columns(), 0.);
  for (unsigned int k = 0; k < x.n_columns(); ++k)
    for (unsigned int i = 0; i < structure.n_vectors; ++i)
      removed[k] += a(i, k) * y(i, k);
  return removed;
}

void Deflation::coarse_correction(qp::MultiVector &lambda, qp::MultiVector &residual) const
{
  const auto      r = layout.to_local(residual);
  qp::MultiVector b(structure.n_vectors, lambda.n_columns()); // C'r
  for (unsigned int s = 0; s < rows.size(); ++s)
    if (const auto &ids = structure.parts[s].ids; !ids.empty())
      add_to_rows(ids, transpose_times(vectors->parts[s].C, rows_of(r, structure.parts[s].rows)),
                  b);
  sum_over_ranks(b, layout.communicator());
  const auto y = vectors->solve(b);
  lambda.add(1., multiply(y));
  qp::MultiVector jumps(layout.n_local(), lambda.n_columns()); // F C y
  for (unsigned int s = 0; s < rows.size(); ++s)
    if (const auto &ids = structure.parts[s].ids; !ids.empty())
      add_product(rows[s], times(vectors->parts[s].X, rows_of(y, ids)), jumps);
  residual.add(-1., layout.to_owned(jumps));
}
} // namespace snug::feti
