#include <snug/base/narrow.h>
#include <snug/feti/total_feti.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace snug::feti {
namespace {
/// Return the name of the matrix in messages of failed factorizations.
std::string name_of_subdomain(const SubdomainTable &table, unsigned int id)
{
  return "the stiffness of subdomain " + std::to_string(id) + " of body " +
         table.body_names[table.body[id]];
}

/// Set 1/D to one. It is the second number of each entry.
void set_compliances_to_one(std::vector<double> &entries, const unsigned int width)
{
  for (std::size_t e = 1; e < entries.size(); e += width)
    entries[e] = 1.;
}

/// Add B x to y for one subdomain. y has the local rows of the rank, x the unknowns of the
/// subdomain.
void add_product(const std::vector<BEntry> &B, const qp::MultiVector &x, qp::MultiVector &y)
{
  for (unsigned int j = 0; j < x.n_columns(); ++j)
    {
      const double *from = x.column(j);
      double       *to   = y.column(j);
      for (const BEntry &entry : B)
        to[entry.row] += entry.value * from[entry.dof];
    }
}

/// Add B' x to y.
void add_transposed(const std::vector<BEntry> &B, const qp::MultiVector &x, qp::MultiVector &y)
{
  for (unsigned int j = 0; j < x.n_columns(); ++j)
    {
      const double *from = x.column(j);
      double       *to   = y.column(j);
      for (const BEntry &entry : B)
        to[entry.dof] += entry.value * from[entry.row];
    }
}
} // namespace

TotalFeti::TotalFeti(const std::vector<SubdomainSystem> &the_systems,
                     const RowLayout                    &the_layout,
                     const SubdomainTable               &table,
                     const FetiParameters               &the_parameters,
                     RunContext                         &context)
  : systems(the_systems)
  , layout(the_layout)
  , parameters(the_parameters)
  , run(context)
  , coarse(the_layout, table, the_parameters.coarse_ranks)
  , gram(the_layout)
  , inverse_factors(FactorOf::kplus, parameters.factorization, &orderings, &run.work)
  , inner_factors(FactorOf::dirichlet, parameters.factorization, &orderings, &run.work)
  , outdated(the_systems.size(), true)
{
  for (const SubdomainSystem &system : systems)
    {
      inverses.push_back(std::make_unique<GeneralizedInverse>(system, inverse_factors, run));
      if (parameters.preconditioner != Preconditioner::none)
        schur.push_back(
          std::make_unique<LocalSchur>(system, parameters.preconditioner == Preconditioner::lumped,
                                       inner_factors, patterns, run));
    }
  if (parameters.preconditioner == Preconditioner::none ||
      parameters.soft_modes == SoftModesOf::none)
    return;
  bool slender = parameters.soft_modes == SoftModesOf::all;
  for (const SubdomainSystem &system : systems)
    slender = slender || !system.compact;
  knows_soft_modes = !dealii::Utilities::MPI::logical_or(slender, run.communicator());
}

/// A factorization may fail on one rank only. throw_collectively() turns this failure into an error
/// on all ranks, because otherwise the other ranks would wait in the next collective call.
void TotalFeti::update(const std::vector<bool> &changed)
{
  throw_collectively(run.communicator(), [&]() {
    const RunContext::Timer timer(run, "factorization");
    // Release all factors first, because a factor in use cannot serve another matrix.
    for (unsigned int s = 0; s < systems.size(); ++s)
      if (changed[s])
        inverses[s]->release();
    for (unsigned int s = 0; s < systems.size(); ++s)
      if (changed[s])
        {
          inverses[s]->factorize(
            name_of_subdomain(coarse.subdomains(), coarse.subdomains().first + s));
          outdated[s] = true;
        }
  });
  const RunContext::Timer timer(run, "solve");
  gather_rows();
}

void TotalFeti::update_preconditioner()
{
  throw_collectively(run.communicator(), [&]() {
    const RunContext::Timer timer(run, "factorization");
    for (unsigned int s = 0; s < schur.size(); ++s)
      if (outdated[s])
        schur[s]->release();
    for (unsigned int s = 0; s < schur.size(); ++s)
      if (outdated[s])
        schur[s]->factorize(name_of_subdomain(coarse.subdomains(), coarse.subdomains().first + s));
  });
  // Always update the deflation, because patches reach over to changed subdomains of other ranks.
  deflation_outdated = true;
  outdated.assign(systems.size(), false);
  weight_rows();
}

/// Compute d = B K^+ f - g and e = R'f. This costs a solve with each subdomain, but no F-mult. The
/// matrices do not change, so load cases share them.
void TotalFeti::set_loads(const qp::MultiVector &g)
{
  gap = g;
  expected.assign(n_owned(), 1);
  rigid_load = rigid_part(loads());
  gross_load = gross_rigid_part(loads())[0];
  // Check the equilibrium first, because the preconditioner may fail for bodies that nothing holds.
  check_equilibrium();
  update_preconditioner();
  update_deflation();
  const RunContext::Timer timer(run, "solve");
  dual_load = multiply_B(apply_inverse(loads()));
  dual_load.add(-1., gap);
}

/// Send B, 1/D and B R of each entry to the owner of its row.
std::vector<double> TotalFeti::gather_entries() const
{
  std::vector<double> values;
  for (const SubdomainSystem &system : systems)
    for (const BEntry &entry : system.B)
      {
        values.push_back(entry.value);
        values.push_back(1. / system.K.diagonal(entry.dof));
        for (unsigned int mode = 0; mode < coarse.subdomains().n_modes; ++mode)
          values.push_back(entry.value * system.R(entry.dof, mode));
      }
  return layout.gather_entries(entry_width(), values);
}

/// Update G, W and the estimate of F_ii.
void TotalFeti::gather_rows()
{
  const bool                   scaled = parameters.scaling == Scaling::stiffness;
  const unsigned int           width  = entry_width();
  std::vector<qp::MultiVector> Z;
  for (const SubdomainSystem &system : systems)
    Z.push_back(system.Z);
  auto gathered = gather_entries();
  F_diagonal.assign(n_owned(), 0.);
  const auto &start = layout.entry_start();
  for (unsigned int row = 0; row < n_owned(); ++row)
    for (unsigned int e = start[row]; e < start[row + 1]; ++e)
      {
        const double *entry = &gathered[std::size_t(e) * width];
        // Use diag K also for scaling by multiplicity, because F_diagonal must be a compliance.
        F_diagonal[row] += entry[0] * entry[0] * entry[1];
      }
  if (!scaled)
    set_compliances_to_one(gathered, width);
  // The numbers of G follow B and 1/D. A rank that owns no rows has no numbers.
  coarse.update(std::vector<double>(gathered.begin() + std::min<std::size_t>(2, gathered.size()),
                                    gathered.end()),
                width, Z);
  throw_collectively(run.communicator(), [&]() { gram.update(gathered, width); });
}

void TotalFeti::weight_rows()
{
  const bool scaled = parameters.scaling == Scaling::stiffness;
  weighted_B.resize(schur.size());
  for (unsigned int s = 0; s < schur.size(); ++s)
    {
      const auto &position = schur[s]->boundary_position();
      weighted_B[s]        = systems[s].B;
      for (BEntry &entry : weighted_B[s])
        {
          // B D^-1 is numbered by the unknowns of the Schur complement.
          if (scaled)
            entry.value *= 1. / systems[s].K.diagonal(entry.dof);
          entry.dof = position[entry.dof];
        }
    }
}

void TotalFeti::find_soft_modes()
{
  knows_soft_modes = true;
  update_preconditioner();
  const RunContext::Timer timer(run, "soft modes");
  auto                    entries = gather_entries();
  if (parameters.scaling != Scaling::stiffness)
    set_compliances_to_one(entries, entry_width());
  const unsigned int first = coarse.subdomains().first;
  const auto         columns =
    jump_columns(layout, gram, entries, entry_width(), first, narrow<unsigned int>(systems.size()));
  const auto neighbours = stiffness_of_neighbours(systems, columns, first, run.communicator());
  std::vector<RowForces> forces;
  double                 largest = 0.;
  // Number of vectors, and number of subdomains with at least one.
  std::vector<unsigned int> counts(2, 0);
  for (unsigned int s = 0; s < systems.size(); ++s)
    {
      const auto modes =
        soft_modes(systems[s], *inverses[s], *schur[s], columns[s], neighbours[s], first + s);
      if (modes.mu.empty())
        continue;
      forces.push_back(row_forces(modes, columns[s], first + s));
      largest = std::max(largest, modes.mu.front());
      counts[0] += narrow<unsigned int>(modes.mu.size());
      ++counts[1];
    }
  dealii::Utilities::MPI::sum(counts, run.communicator(), counts);
  largest = dealii::Utilities::MPI::max(largest, run.communicator());
  run.work.soft_modes += counts[0];
  if (counts[0] == 0)
    return;
  run.out(Verbosity::debug) << "soft modes: " << counts[0] << " of "
                            << counted(counts[1], "subdomain") << ", maximum eigenvalue " << largest
                            << std::endl;
  deflation          = std::make_unique<Deflation>(systems, layout, coarse.subdomains(),
                                                   parameters.coarse_ranks, forces);
  deflation_outdated = true;
}

/// The update costs one K^+ per subdomain and soft mode of its patch, but no F-mult.
void TotalFeti::update_deflation()
{
  if (!deflation || !deflation_outdated)
    return;
  const RunContext::Timer timer(run, "soft modes");
  deflation->update(inverses, schur);
  deflation_outdated = false;
}

/// Return F x = B K^+ B' x. K^+ is one of many generalized inverses. The F of another one differs
/// by some G'X + X'G, which vanishes in P F P.
qp::MultiVector TotalFeti::apply(const qp::MultiVector &x) const
{
  // A block of k columns counts as k F-mults, though it is one pass over the factors.
  run.work.f_mults += x.n_columns();
  return multiply_B(apply_inverse(multiply_Bt(x)));
}

qp::MultiVector TotalFeti::multiply_B(const PrimalVectors &v) const
{
  // A rank without subdomains has no vectors and takes the number of columns from other ranks.
  unsigned int k = v.empty() ? 0 : v.front().n_columns();
  MPI_Allreduce(MPI_IN_PLACE, &k, 1, MPI_UNSIGNED, MPI_MAX, run.communicator());
  qp::MultiVector local(layout.n_local(), k);
  for (unsigned int s = 0; s < systems.size(); ++s)
    add_product(systems[s].B, v[s], local);
  return layout.to_owned(local);
}

PrimalVectors TotalFeti::multiply_Bt(const qp::MultiVector &lambda) const
{
  const qp::MultiVector local = layout.to_local(lambda);
  PrimalVectors         v;
  for (const SubdomainSystem &system : systems)
    {
      v.emplace_back(system.n_dofs(), lambda.n_columns());
      add_transposed(system.B, local, v.back());
    }
  return v;
}

/// No communication is needed: each subdomain is solved on its rank.
PrimalVectors TotalFeti::apply_inverse(const PrimalVectors &right_hand_side) const
{
  PrimalVectors x;
  for (unsigned int s = 0; s < systems.size(); ++s)
    {
      x.emplace_back(systems[s].n_dofs(), right_hand_side[s].n_columns());
      inverses[s]->apply(right_hand_side[s], x.back());
    }
  return x;
}

qp::MultiVector TotalFeti::rigid_part(const PrimalVectors &b) const
{
  unsigned int k = b.empty() ? 0 : b.front().n_columns();
  MPI_Allreduce(MPI_IN_PLACE, &k, 1, MPI_UNSIGNED, MPI_MAX, run.communicator());
  const unsigned int m = coarse.subdomains().n_modes;
  qp::MultiVector    result(coarse.n_kernel(), k);
  for (unsigned int s = 0; s < systems.size(); ++s)
    for (unsigned int j = 0; j < k; ++j)
      for (unsigned int mode = 0; mode < m; ++mode)
        for (unsigned int i = 0; i < systems[s].n_dofs(); ++i)
          result((coarse.subdomains().first + s) * m + mode, j) +=
            systems[s].R(i, mode) * b[s](i, j);
  MPI_Allreduce(MPI_IN_PLACE, result.column(0), result.n_rows() * k, MPI_DOUBLE, MPI_SUM,
                run.communicator());
  return result;
}

PrimalVectors TotalFeti::recover(PrimalVectors          b,
                                 const qp::MultiVector &lambda,
                                 const qp::MultiVector &alpha) const
{
  // K^+ (b - B' lambda) solves the equations of a subdomain only if e = G lambda. With K_rho, an
  // unbalanced rest loads the fixing nodes.
  const PrimalVectors forces = multiply_Bt(lambda);
  for (unsigned int s = 0; s < systems.size(); ++s)
    b[s].add(-1., forces[s]);
  PrimalVectors u = apply_inverse(b);
  add_rigid(alpha, u);
  return u;
}

/// Add R alpha to u.
void TotalFeti::add_rigid(const qp::MultiVector &alpha, PrimalVectors &u) const
{
  const unsigned int m = coarse.subdomains().n_modes;
  for (unsigned int s = 0; s < systems.size(); ++s)
    for (unsigned int j = 0; j < u[s].n_columns(); ++j)
      for (unsigned int mode = 0; mode < m; ++mode)
        {
          const double amplitude = alpha((coarse.subdomains().first + s) * m + mode, j);
          for (unsigned int i = 0; i < systems[s].n_dofs(); ++i)
            u[s](i, j) += systems[s].R(i, mode) * amplitude;
        }
}

PrimalVectors TotalFeti::loads() const
{
  PrimalVectors f;
  for (const SubdomainSystem &system : systems)
    {
      f.emplace_back(system.n_dofs(), 1);
      std::copy(system.f.begin(), system.f.end(), f.back().column(0));
    }
  return f;
}

/// Take the maximum over subdomains, because the gluing forces of a subdomain are of the size of
/// its own loads, even where the loads of the body cancel.
std::vector<double> TotalFeti::gross_rigid_part(const PrimalVectors &b) const
{
  unsigned int k = b.empty() ? 0 : b.front().n_columns();
  MPI_Allreduce(MPI_IN_PLACE, &k, 1, MPI_UNSIGNED, MPI_MAX, run.communicator());
  std::vector<double> largest(k, 0.);
  for (unsigned int s = 0; s < b.size(); ++s)
    for (unsigned int j = 0; j < k; ++j)
      {
        double square = 0.;
        for (unsigned int mode = 0; mode < systems[s].R.n_columns(); ++mode)
          {
            double sum = 0.;
            for (unsigned int i = 0; i < systems[s].n_dofs(); ++i)
              sum += std::abs(systems[s].R(i, mode) * b[s](i, j));
            square += sum * sum;
          }
        largest[j] = std::max(largest[j], std::sqrt(square));
      }
  MPI_Allreduce(MPI_IN_PLACE, largest.data(), narrow<int>(k), MPI_DOUBLE, MPI_MAX,
                run.communicator());
  return largest;
}

/// Set x <- B D^-1 S D^-1 B' x, without the factors W^-1 on both sides, which belong to a face.
void TotalFeti::precondition(qp::MultiVector &x) const
{
  const qp::MultiVector local = layout.to_local(x);
  const unsigned int    k     = x.n_columns();
  qp::MultiVector       result(layout.n_local(), k);
  for (unsigned int s = 0; s < systems.size(); ++s)
    {
      qp::MultiVector boundary(schur[s]->n_boundary(), k);
      add_transposed(weighted_B[s], local, boundary);
      add_product(weighted_B[s], schur[s]->apply(boundary), result);
    }
  x = layout.to_owned(result);
}
} // namespace snug::feti
