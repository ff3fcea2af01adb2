#include <snug/base/narrow.h>
#include <snug/feti/linearization.h>
#include <snug/qp/row_set.h>

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
} // namespace

Linearization::Linearization(const DualStructure                &the_structure,
                             const std::vector<SubdomainSystem> &the_systems,
                             ConstraintRows                      B,
                             SharedOperators                     shared,
                             std::vector<double>                 of_springs)
  : structure(the_structure)
  , systems(the_systems)
  , rows(std::move(B))
  , D(std::move(of_springs))
  , operators(std::move(shared))
  , F_diagonal(n_owned(), 0.)
{
  factorize();
  std::vector<double> entries;
  {
    const RunContext::Timer timer(context(), "solve");
    entries = gather_entries();
    // G and G G' follow B, 1/D and their products with R.
    std::vector<qp::MultiVector> Z;
    for (unsigned int s = 0; s < systems.size(); ++s)
      Z.push_back(clustered() ? operators.clusters->body_modes(s) : systems[s].Z);
    coarse_space = std::make_unique<CoarseSpace>(structure.coarse, entries, 2, Z);
    throw_collectively(context().communicator(), [&]() {
      gram = std::make_unique<RowGram>(structure.gram, entries, 2 + table().n_modes, ground);
    });
    weight_rows();
  }
  const RunContext::Timer timer(context(), "soft modes");
  auto &[factors, joints, clusters, soft_modes, vectors] = operators;
  if (!soft_modes)
    soft_modes = std::make_shared<const DeflationStructure>(structure.coarse,
                                                            narrow<unsigned int>(systems.size()),
                                                            find_soft_modes(entries),
                                                            structure.parameters.coarse_ranks,
                                                            layout().node_rows());
  if (soft_modes->n_vectors == 0 || clustered())
    return;
  if (!vectors)
    vectors = std::make_shared<const DeflationVectors>(*soft_modes, systems, rows, factors);
  deflation = std::make_unique<Deflation>(layout(), vectors, rows, factors);
}

/// A factorization may fail on one rank only. throw_collectively() turns this failure into an error
/// on all ranks, because otherwise the other ranks would wait in the next collective call.
void Linearization::factorize()
{
  throw_collectively(context().communicator(), [&]() {
    const RunContext::Timer timer(context(), "factorization");
    for (unsigned int s = 0; s < systems.size(); ++s)
      if (!operators.factors[s])
        operators.factors[s] =
          std::make_shared<const SubdomainFactors>(systems[s], structure.parameters.preconditioner,
                                                   structure.cache,
                                                   name_of_subdomain(table(), table().first + s));
  });
  if (!clustered() || operators.clusters)
    return;
  const RunContext::Timer timer(context(), "factorization");
  operators.clusters = std::make_shared<const ClusterInverse>(structure.clusters, table(), systems,
                                                              operators.factors, operators.joints);
}

/// Return the rigid modes of the cluster of a subdomain of this rank, on its unknowns.
const qp::MultiVector &Linearization::rigid_modes(const unsigned int s) const
{
  return clustered() ? operators.clusters->rigid_modes(s) : systems[s].R;
}

/// Send B, 1/D and B R of each entry to the owner of its row. 1/D is one for scaling by
/// multiplicity. Set the estimate of F_ii.
std::vector<double> Linearization::gather_entries()
{
  const unsigned int  width = 2 + table().n_modes;
  std::vector<double> values;
  for (unsigned int s = 0; s < systems.size(); ++s)
    for (const BEntry &entry : rows[s])
      {
        values.push_back(entry.value);
        values.push_back(systems[s].compliance(entry.dof));
        for (unsigned int mode = 0; mode < table().n_modes; ++mode)
          values.push_back(entry.value * rigid_modes(s)(entry.dof, mode));
      }
  auto        gathered = layout().gather_entries(width, values);
  const auto &start    = layout().entry_start();
  for (unsigned int row = 0; row < n_owned(); ++row)
    for (unsigned int e = start[row]; e < start[row + 1]; ++e)
      {
        double *entry = &gathered[std::size_t(e) * width];
        // Use diag K also for scaling by multiplicity, because F_diagonal must be a compliance.
        F_diagonal[row] += entry[0] * entry[0] * entry[1];
        if (structure.parameters.scaling != Scaling::stiffness && entry[1] > 0.)
          entry[1] = 1.;
      }
  weight_ground(gathered);
  return gathered;
}

/// Set the weights of the unknowns of springs, which are D for scaling by stiffness. For scaling by
/// multiplicity they are D times the stiffness of the body, relative to the weights 1 of its
/// unknowns.
void Linearization::weight_ground(const std::vector<double> &entries)
{
  const std::size_t width = 2 + table().n_modes;
  const auto       &start = layout().entry_start();
  ground                  = D;
  for (unsigned int row = 0; row < D.size(); ++row)
    if (D[row] > 0.)
      {
        double square = 0.; // of the row, weighted
        for (unsigned int e = start[row]; e < start[row + 1]; ++e)
          square += entries[e * width] * entries[e * width] * entries[e * width + 1];
        if (F_diagonal[row] > 0.) // otherwise B has no entries in the row
          ground[row] *= square / F_diagonal[row];
        F_diagonal[row] += D[row];
      }
}

void Linearization::weight_rows()
{
  if (structure.parameters.preconditioner == Preconditioner::none)
    return;
  weighted_B = rows;
  for (unsigned int s = 0; s < systems.size(); ++s)
    for (BEntry &entry : weighted_B[s])
      {
        // B D^-1 is numbered by the unknowns of the Schur complement.
        if (structure.parameters.scaling == Scaling::stiffness)
          entry.value *= systems[s].compliance(entry.dof);
        entry.dof = operators.factors[s]->schur->boundary_position()[entry.dof];
      }
}

/// Return F x = B K^+ B' x + D x. K^+ is one of many generalized inverses. Another generalized
/// inverse changes F by a term G'X + X'G, which vanishes in P F P.
qp::MultiVector Linearization::apply(const qp::MultiVector &x) const
{
  // A block of k columns counts as k F-mults, though it is one pass over the factors.
  context().work.f_mults += x.n_columns();
  auto y = multiply_B(apply_inverse(multiply_Bt(x)));
  add_compliance(1., x, y);
  return y;
}

void Linearization::add_compliance(const double           factor,
                                   const qp::MultiVector &x,
                                   qp::MultiVector       &y) const
{
  for (unsigned int k = 0; k < x.n_columns(); ++k)
    for (unsigned int row = 0; row < D.size(); ++row)
      y(row, k) += factor * D[row] * x(row, k);
}

qp::MultiVector Linearization::multiply_B(const PrimalVectors &v) const
{
  qp::MultiVector local(layout().n_local(), v.n_columns());
  for (unsigned int s = 0; s < systems.size(); ++s)
    add_product(rows[s], v[s], local);
  return layout().to_owned(local);
}

PrimalVectors Linearization::multiply_Bt(const qp::MultiVector &lambda) const
{
  const qp::MultiVector local = layout().to_local(lambda);
  PrimalVectors         v(lambda.n_columns());
  for (unsigned int s = 0; s < systems.size(); ++s)
    {
      v.emplace_back(systems[s].n_dofs());
      add_transposed(rows[s], local, v.back());
    }
  return v;
}

PrimalVectors Linearization::apply_inverse(const PrimalVectors &right_hand_side) const
{
  PrimalVectors x = solve_subdomains(right_hand_side);
  if (clustered())
    operators.clusters->join(right_hand_side, x);
  return x;
}

/// Return K^+ of each subdomain by itself. No communication is needed: each subdomain is solved on
/// its rank.
PrimalVectors Linearization::solve_subdomains(const PrimalVectors &right_hand_side) const
{
  PrimalVectors x(right_hand_side.n_columns());
  for (unsigned int s = 0; s < systems.size(); ++s)
    {
      x.emplace_back(systems[s].n_dofs());
      operators.factors[s]->inverse.apply(right_hand_side[s], x.back());
    }
  return x;
}

qp::MultiVector Linearization::rigid_part(const PrimalVectors &b) const
{
  const unsigned int k = b.n_columns(), m = table().n_modes;
  qp::MultiVector    result(table().n_kernel(), k);
  for (unsigned int s = 0; s < systems.size(); ++s)
    for (unsigned int j = 0; j < k; ++j)
      for (unsigned int mode = 0; mode < m; ++mode)
        for (unsigned int i = 0; i < systems[s].n_dofs(); ++i)
          result(table().cluster_of(table().first + s) * m + mode, j) +=
            rigid_modes(s)(i, mode) * b[s](i, j);
  structure.coarse.sum(result);
  return result;
}

PrimalVectors
Linearization::recover(PrimalVectors b, qp::MultiVector &lambda, const qp::MultiVector &alpha) const
{
  // K^+ (b - B' lambda) solves the equations of a subdomain only if e = G lambda. With K_rho, an
  // unbalanced rest loads the fixing nodes.
  b.add(-1., multiply_Bt(lambda));
  PrimalVectors u = solve_subdomains(b);
  if (clustered())
    {
      const auto mu = operators.clusters->join(b, u);
      lambda.add(1., gluing_forces(operators.clusters->forces(mu, b.n_columns())));
    }
  add_rigid(alpha, u);
  return u;
}

/// Return the multipliers of the equality rows E whose forces on the unknowns are @p forces. Forces
/// of joints are such forces, because joints are combinations of gluing rows: B_E' lambda = forces
/// has the solution lambda = W_EE^-1 B_E D^-1 forces with W_EE = B_E D^-1 B_E'.
qp::MultiVector Linearization::gluing_forces(const PrimalVectors &forces) const
{
  const unsigned int k = forces.n_columns();
  qp::MultiVector    local(layout().n_local(), k);
  for (unsigned int s = 0; s < systems.size(); ++s)
    {
      auto weighted = rows[s];
      for (BEntry &entry : weighted)
        if (structure.parameters.scaling == Scaling::stiffness)
          entry.value *= systems[s].compliance(entry.dof);
      add_product(weighted, forces[s], local);
    }
  auto lambda = layout().to_owned(local);
  gram->solve_equalities(lambda);
  return lambda;
}

void Linearization::add_rigid(const qp::MultiVector &alpha, PrimalVectors &u) const
{
  const unsigned int m = table().n_modes;
  for (unsigned int s = 0; s < systems.size(); ++s)
    for (unsigned int j = 0; j < u[s].n_columns(); ++j)
      for (unsigned int mode = 0; mode < m; ++mode)
        {
          const double amplitude = alpha(table().cluster_of(table().first + s) * m + mode, j);
          for (unsigned int i = 0; i < systems[s].n_dofs(); ++i)
            u[s](i, j) += rigid_modes(s)(i, mode) * amplitude;
        }
}

/// Take the maximum over subdomains, because the gluing forces of a subdomain are of the size of
/// its own loads, even where the loads of the body cancel.
std::vector<double> Linearization::gross_rigid_part(const PrimalVectors &b) const
{
  const unsigned int  k = b.n_columns();
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
                context().communicator());
  return largest;
}

/// Set x <- B D^-1 S D^-1 B' x, without the factors W^-1 on both sides, which belong to a face. The
/// sum over subdomains contains the springs with S = 1/D.
void Linearization::precondition(qp::MultiVector &x) const
{
  const qp::MultiVector local = layout().to_local(x);
  const unsigned int    k     = x.n_columns();
  qp::MultiVector       result(layout().n_local(), k);
  for (unsigned int s = 0; s < systems.size(); ++s)
    {
      const LocalSchur &schur = *operators.factors[s]->schur;
      qp::MultiVector   boundary(schur.n_boundary(), k);
      add_transposed(weighted_B[s], local, boundary);
      add_product(weighted_B[s], schur.apply(boundary), result);
    }
  const auto of_springs = x;
  x                     = layout().to_owned(result);
  for (unsigned int j = 0; j < k; ++j)
    for (unsigned int row = 0; row < D.size(); ++row)
      if (D[row] > 0.)
        x(row, j) += ground[row] * ground[row] / D[row] * of_springs(row, j);
}
} // namespace snug::feti
