#include <snug/base/narrow.h>
#include <snug/feti/couplings.h>
#include <snug/feti/deflation.h>
#include <snug/feti/patch.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace snug::feti {
namespace {
/// Shift of the diagonal of E, relative to the diagonal. It makes E definite if some vectors lie in
/// the span of the others.
const double shift = 1e-12;

/// Add B' times the columns of @p local to @p y. Rows of @p local are local rows, rows of @p y are
/// the unknowns as numbered in @p B.
void add_transposed(const std::vector<BEntry> &B, const qp::MultiVector &local, qp::MultiVector &y)
{
  for (unsigned int k = 0; k < y.n_columns(); ++k)
    for (const BEntry &entry : B)
      y(entry.dof, k) += entry.value * local(entry.row, k);
}

void sum(qp::MultiVector &x, MPI_Comm comm)
{
  MPI_Allreduce(MPI_IN_PLACE, x.column(0), narrow<int>(x.n_rows() * x.n_columns()), MPI_DOUBLE,
                MPI_SUM, comm);
}

/// Add the rows of @p x to the rows @p numbers of @p a.
void add_to_rows(const std::vector<unsigned int> &numbers,
                 const qp::MultiVector           &x,
                 qp::MultiVector                 &a)
{
  for (unsigned int k = 0; k < a.n_columns(); ++k)
    for (unsigned int i = 0; i < numbers.size(); ++i)
      a(numbers[i], k) += x(i, k);
}
} // namespace

Deflation::Deflation(const std::vector<SubdomainSystem> &the_systems,
                     const RowLayout                    &the_layout,
                     const SubdomainTable               &the_table,
                     const unsigned int                  coarse_ranks,
                     std::vector<RowForces>              the_raw)
  : systems(the_systems)
  , layout(the_layout)
  , table(the_table)
  , rank_of(the_table.first, the_layout.communicator())
  , raw(std::move(the_raw))
  , wanted_by(the_systems.size())
  , parts(the_systems.size())
{
  const MPI_Comm comm = layout.communicator();
  unsigned int   mine = 0;
  for (const RowForces &of_subdomain : raw)
    mine += of_subdomain.values.n_columns();
  // Ids are in the order of the subdomains, which is the order of the ranks.
  MPI_Scan(&mine, &first_id, 1, MPI_UNSIGNED, MPI_SUM, comm);
  first_id -= mine;
  n_global = dealii::Utilities::MPI::sum(mine, comm);
  team     = coarse_team(comm, n_global, FactorOf::soft_modes, coarse_ranks);

  // Per row: the number of its subdomains, and the lowest of these subdomains.
  qp::MultiVector owned(layout.n_owned(), 2);
  for (unsigned int row = 0; row < layout.n_owned(); ++row)
    if (!layout.bounded()[row])
      {
        const auto &unknowns = layout.entry_unknowns();
        const auto  begin = layout.entry_start()[row], end = layout.entry_start()[row + 1];
        for (unsigned int e = begin; e < end; ++e)
          owned(row, 0) += e == begin || unknowns[e].first != unknowns[e - 1].first;
        owned(row, 1) = unknowns[begin].first;
      }
  const auto local = layout.to_local(owned);
  for (unsigned int row = 0; row < layout.n_local(); ++row)
    {
      n_copies.push_back(static_cast<unsigned int>(local(row, 0)));
      const auto lowest = static_cast<unsigned int>(local(row, 1));
      if (n_copies.back() > 0 && lowest >= table.first && lowest - table.first < parts.size())
        parts[lowest - table.first].rows.push_back(row);
    }

  std::map<unsigned int, std::vector<unsigned int>> questions;
  for (const RowForces &of_subdomain : raw)
    for (const unsigned int t : of_subdomain.patch)
      questions[rank_of(t)].push_back(t);
  for (const auto &message : dealii::Utilities::MPI::some_to_some(comm, questions))
    for (const unsigned int t : message.second)
      wanted_by[t - table.first].insert(message.first);
}

/// Gather the rows of the subdomains in all patches of this rank.
Deflation::Numbers Deflation::gather_rows() const
{
  const unsigned int                          m = table.n_modes;
  std::map<unsigned int, std::vector<double>> out;
  std::vector<unsigned int>                   place(layout.n_local());
  for (unsigned int t = 0; t < systems.size(); ++t)
    {
      if (wanted_by[t].empty())
        continue;
      std::vector<unsigned int> rows;
      for (const BEntry &entry : systems[t].B)
        if (n_copies[entry.row] > 0)
          rows.push_back(entry.row);
      std::sort(rows.begin(), rows.end());
      rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
      const std::size_t   header = 2, width = 2 + m;
      std::vector<double> message(header + rows.size() * width, 0.);
      message[0] = table.first + t;
      message[1] = double(rows.size() * width);
      for (unsigned int i = 0; i < rows.size(); ++i)
        {
          place[rows[i]]                  = i;
          message[header + i * width]     = layout.global_row_of_local(rows[i]);
          message[header + i * width + 1] = n_copies[rows[i]];
        }
      for (const BEntry &entry : systems[t].B)
        if (n_copies[entry.row] > 0)
          for (unsigned int k = 0; k < m; ++k)
            message[header + place[entry.row] * width + 2 + k] +=
              entry.value * systems[t].R(entry.dof, k);
      for (const unsigned int rank : wanted_by[t])
        out[rank].insert(out[rank].end(), message.begin(), message.end());
    }
  Numbers result;
  for (const auto &message : dealii::Utilities::MPI::some_to_some(layout.communicator(), out))
    for (auto p = message.second.begin(); p != message.second.end();)
      {
        auto      &of_subdomain = result[static_cast<unsigned int>(*p++)];
        const auto size         = static_cast<std::ptrdiff_t>(*p++);
        of_subdomain.assign(p, p + size);
        p += size;
      }
  return result;
}

/// Return the columns of C for the subdomains of this rank, with ascending ids.
Deflation::Numbers Deflation::balanced_vectors() const
{
  const auto                                  rows = gather_rows();
  const unsigned int                          m    = table.n_modes;
  std::map<unsigned int, std::vector<double>> out;
  unsigned int                                id = first_id;
  for (const RowForces &of_subdomain : raw)
    {
      const auto               &members = of_subdomain.patch;
      std::vector<Patch::Touch> touches;
      for (unsigned int member = 0; member < members.size(); ++member)
        {
          const auto &of_member = rows.at(members[member]);
          for (std::size_t i = 0; i < of_member.size(); i += 2 + m)
            touches.push_back({static_cast<unsigned int>(of_member[i]),
                               static_cast<unsigned int>(of_member[i + 1]), member,
                               &of_member[i + 2]});
        }
      const Patch patch(touches, narrow<unsigned int>(members.size()), m);
      for (unsigned int v = 0; v < of_subdomain.values.n_columns(); ++v, ++id)
        {
          std::vector<double> c(patch.n_rows(), 0.);
          unsigned int        j = 0;
          for (unsigned int i = 0; i < patch.n_rows(); ++i)
            {
              // the rows of both are ascending
              while (j < of_subdomain.rows.size() && of_subdomain.rows[j] < patch.begin(i)->row)
                ++j;
              if (j < of_subdomain.rows.size() && of_subdomain.rows[j] == patch.begin(i)->row)
                c[i] = of_subdomain.values(j, v);
            }
          patch.balance(c);
          std::vector<std::vector<double>> of_member(members.size());
          for (unsigned int i = 0; i < patch.n_rows(); ++i)
            for (const auto *t = patch.begin(i); t != patch.end(i); ++t)
              {
                of_member[t->member].push_back(t->row);
                of_member[t->member].push_back(c[i]);
              }
          for (unsigned int member = 0; member < members.size(); ++member)
            {
              auto &to = out[rank_of(members[member])];
              to.insert(to.end(),
                        {double(members[member]), double(id), double(of_member[member].size())});
              to.insert(to.end(), of_member[member].begin(), of_member[member].end());
            }
        }
    }
  // Messages are sorted by rank, and ids ascend with the ranks.
  Numbers result;
  for (const auto &message : dealii::Utilities::MPI::some_to_some(layout.communicator(), out))
    for (auto p = message.second.begin(); p != message.second.end();)
      {
        auto      &of_subdomain = result[static_cast<unsigned int>(*p++)];
        const auto end          = p + 2 + static_cast<std::ptrdiff_t>(p[1]);
        of_subdomain.insert(of_subdomain.end(), p, end);
        p = end;
      }
  return result;
}

/// Store the parts of @p vectors that belong to subdomain s of this rank. @return B'C
qp::MultiVector Deflation::take(const unsigned int s, const std::vector<double> &vectors)
{
  Part &part = parts[s];
  part.ids.clear();
  part.C = qp::MultiVector(narrow<unsigned int>(part.rows.size()), 0);
  qp::MultiVector forces(systems[s].n_dofs(), 0), c(layout.n_local());
  for (auto p = vectors.begin(); p != vectors.end();)
    {
      part.ids.push_back(static_cast<unsigned int>(p[0]));
      const auto begin = p + 2, end = begin + static_cast<std::ptrdiff_t>(p[1]);
      for (p = begin; p != end; p += 2)
        c(layout.local_row(static_cast<unsigned int>(p[0]))) = p[1];
      qp::MultiVector counted(part.C.n_rows()), force(forces.n_rows());
      for (unsigned int i = 0; i < part.rows.size(); ++i)
        counted(i) = c(part.rows[i]);
      add_transposed(systems[s].B, c, force);
      part.C.append(counted);
      forces.append(force);
      for (p = begin; p != end; p += 2)
        c(layout.local_row(static_cast<unsigned int>(p[0]))) = 0.;
    }
  return forces;
}

void Deflation::build_pattern()
{
  std::set<Coupling> couplings;
  for (const Part &part : parts)
    for (const unsigned int i : part.ids)
      for (const unsigned int j : part.ids)
        couplings.emplace(i, j);
  std::vector<std::vector<PetscInt>> rows(n_global);
  for (const Coupling &coupling : unite(couplings, layout.communicator()))
    rows[coupling.first].push_back(coupling.second);
  E = CsrMatrix::from_rows(rows, n_global);
  // Use CHOLMOD whatever the package of the stiffness is, as for the coarse problem, because the
  // problem is replicated. A team factorizes by MUMPS instead.
  factor =
    std::make_unique<SparseFactor>(E, FactorOf::soft_modes, Factorization::CHOLMOD, nullptr, team);
}

void Deflation::update(const std::vector<std::unique_ptr<GeneralizedInverse>> &inverses,
                       const std::vector<std::unique_ptr<LocalSchur>>         &schur)
{
  const auto                   vectors = balanced_vectors();
  std::vector<qp::MultiVector> products(systems.size());
  for (unsigned int s = 0; s < systems.size(); ++s)
    {
      const auto found = vectors.find(table.first + s);
      if (found == vectors.end())
        continue;
      Part           &part   = parts[s];
      const auto      forces = take(s, found->second);
      qp::MultiVector motions(forces.n_rows(), forces.n_columns());
      inverses[s]->apply(forces, motions);
      products[s] = transpose_times(forces, motions);
      part.X      = on_boundary(motions, *schur[s]);
      part.B      = systems[s].B;
      for (BEntry &entry : part.B)
        entry.dof = schur[s]->boundary_position()[entry.dof];
    }
  if (!factor)
    build_pattern();
  std::fill(E.values.begin(), E.values.end(), 0.);
  for (unsigned int s = 0; s < systems.size(); ++s)
    {
      const auto &ids = parts[s].ids;
      for (unsigned int i = 0; i < ids.size(); ++i)
        for (unsigned int j = 0; j < ids.size(); ++j)
          E.values[E.position(ids[i], ids[j])] += products[s](i, j);
    }
  sum_over_ranks(E.values, layout.communicator());
  scale_E();
  // Disable the check for large solutions, because the shift permits solutions of size 1/shift.
  factor->factorize(E, "the coarse problem of the soft modes",
                    std::numeric_limits<double>::infinity());
}

/// Scale E to unit diagonal and add the shift.
void Deflation::scale_E()
{
  scale.assign(n_global, 1.);
  for (unsigned int i = 0; i < n_global; ++i)
    // the diagonal is zero for a vector that balance() has set to zero
    if (const double diagonal = E.diagonal(i); diagonal > 0.)
      scale[i] = 1. / std::sqrt(diagonal);
  for (unsigned int i = 0; i < n_global; ++i)
    for (PetscInt p = E.row_start()[i]; p < E.row_start()[i + 1]; ++p)
      E.values[p] *= scale[i] * scale[E.columns()[p]];
  for (unsigned int i = 0; i < n_global; ++i)
    E.values[E.position(i, i)] = 1. + shift;
}

/// The shift leaves a part of C'r, which no later direction could remove, because all directions
/// are F-orthogonal to C. One step of iterative refinement removes this part; its residual is shift
/// y.
qp::MultiVector Deflation::solve(const qp::MultiVector &b) const
{
  qp::MultiVector scaled = b, y(n_global, b.n_columns()), left = y;
  const auto      rescale = [&](qp::MultiVector &x) {
    for (unsigned int k = 0; k < x.n_columns(); ++k)
      for (unsigned int i = 0; i < n_global; ++i)
        x(i, k) *= scale[i];
  };
  rescale(scaled);
  factor->solve(scaled, y);
  left.add(shift, y);
  factor->solve(left, scaled);
  y.add(1., scaled);
  rescale(y);
  return y;
}

/// Return C y.
qp::MultiVector Deflation::multiply(const qp::MultiVector &y) const
{
  qp::MultiVector local(layout.n_local(), y.n_columns());
  for (const Part &part : parts)
    if (!part.ids.empty())
      {
        const auto c = times(part.C, rows_of(y, part.ids));
        for (unsigned int k = 0; k < y.n_columns(); ++k)
          for (unsigned int i = 0; i < part.rows.size(); ++i)
            local(part.rows[i], k) = c(i, k);
      }
  return layout.to_owned(local);
}

std::vector<double> Deflation::remove_from(qp::MultiVector &x) const
{
  const auto      local = layout.to_local(x);
  qp::MultiVector a(n_global, x.n_columns()); // (F C)'x
  for (const Part &part : parts)
    if (!part.ids.empty())
      {
        qp::MultiVector forces(part.X.n_rows(), x.n_columns());
        add_transposed(part.B, local, forces);
        add_to_rows(part.ids, transpose_times(part.X, forces), a);
      }
  sum(a, layout.communicator());
  const auto y = solve(a);
  x.add(-1., multiply(y));
  std::vector<double> removed(x.n_columns(), 0.);
  for (unsigned int k = 0; k < x.n_columns(); ++k)
    for (unsigned int i = 0; i < n_global; ++i)
      removed[k] += a(i, k) * y(i, k);
  return removed;
}

void Deflation::correct(qp::MultiVector &lambda, qp::MultiVector &residual) const
{
  const auto      r = layout.to_local(residual);
  qp::MultiVector b(n_global, lambda.n_columns()); // C'r
  for (const Part &part : parts)
    if (!part.ids.empty())
      add_to_rows(part.ids, transpose_times(part.C, rows_of(r, part.rows)), b);
  sum(b, layout.communicator());
  const auto y = solve(b);
  lambda.add(1., multiply(y));
  qp::MultiVector jumps(layout.n_local(), lambda.n_columns()); // F C y
  for (const Part &part : parts)
    if (!part.ids.empty())
      {
        const auto motions = times(part.X, rows_of(y, part.ids));
        for (unsigned int k = 0; k < lambda.n_columns(); ++k)
          for (const BEntry &entry : part.B)
            jumps(entry.row, k) += entry.value * motions(entry.dof, k);
      }
  residual.add(-1., layout.to_owned(jumps));
}
} // namespace snug::feti
