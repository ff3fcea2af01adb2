#include <snug/base/assertions.h>
#include <snug/feti/cluster_inverse.h>
#include <snug/feti/couplings.h>
#include <snug/qp/direction_basis.h>
#include <snug/qp/independent_columns.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <cmath>

namespace snug::feti {
namespace {
using qp::MultiVector;

/// Pivots below this part of the largest one mean that columns are linearly dependent.
const double dependent_motions = 1e-10;

/// Return C such that X C has orthonormal columns, for the Gram matrix @p S = X'X.
MultiVector orthonormal(const MultiVector &S)
{
  auto C =
    qp::orthonormal_combinations(S, std::vector<double>(S.n_columns(), 0.), dependent_motions);
  SNUG_ASSERT(C.n_columns() == S.n_columns(),
              "rigid motions of a joint or cluster are independent");
  return C;
}

using Joints = std::vector<SubdomainTable::Joint>;

/// Return the number of moments of all joints of a subdomain.
unsigned int n_moments(const Joints &joints)
{
  unsigned int n = 0;
  for (const auto &joint : joints)
    n += joint.motions.n_columns();
  return n;
}

/// Return C x, the moments of all joints of a subdomain.
MultiVector moments(const Joints &joints, const MultiVector &x)
{
  MultiVector  result(n_moments(joints), x.n_columns());
  unsigned int first = 0;
  for (const auto &joint : joints)
    {
      const auto of_joint = transpose_times(joint.motions, rows_of(x, joint.dofs));
      for (unsigned int k = 0; k < x.n_columns(); ++k)
        std::copy(of_joint.column(k), of_joint.column(k) + of_joint.n_rows(),
                  result.column(k) + first);
      first += of_joint.n_rows();
    }
  return result;
}

/// Add C' mu to @p x.
void add_transposed_moments(const Joints &joints, const MultiVector &mu, MultiVector &x)
{
  unsigned int first = 0;
  for (const auto &joint : joints)
    {
      const auto &C = joint.motions;
      for (unsigned int k = 0; k < mu.n_columns(); ++k)
        for (unsigned int l = 0; l < C.n_columns(); ++l)
          for (unsigned int i = 0; i < joint.dofs.size(); ++i)
            x(joint.dofs[i], k) += C(i, l) * mu(first + l, k);
      first += C.n_columns();
    }
}

/// Return the inverse of [A, -N; -N', 0] for A = C K^+ C' and N = C R. A is a compliance, and N has
/// no unit. They are scaled to equal size before the inversion, by the @p largest entry of A.
MultiVector bordered_inverse(const MultiVector &A, const MultiVector &N, const double largest)
{
  const unsigned int k = A.n_rows(), m = N.n_columns();
  const double       scale = std::sqrt(largest);
  const auto         by    = [&](unsigned int i) { return i < k ? 1. / scale : scale; };

  dealii::LAPACKFullMatrix<double> matrix(k + m);
  for (unsigned int i = 0; i < k; ++i)
    {
      for (unsigned int j = 0; j < k; ++j)
        matrix(i, j) = 0.5 * (A(i, j) + A(j, i)) * by(i) * by(j);
      for (unsigned int j = 0; j < m; ++j)
        matrix(i, k + j) = matrix(k + j, i) = -N(i, j);
    }
  for (unsigned int i = k; i < k + m; ++i)
    for (unsigned int j = k; j < k + m; ++j)
      matrix(i, j) = 0.;
  matrix.invert();
  MultiVector T(k + m, k + m);
  for (unsigned int i = 0; i < k + m; ++i)
    for (unsigned int j = 0; j < k + m; ++j)
      T(i, j) = 0.5 * (matrix(i, j) + matrix(j, i)) * by(i) * by(j);
  // The moments of a single joint are those of a rigid motion, which needs no forces.
  for (unsigned int i = 0; i < k && k == m; ++i)
    std::fill_n(T.column(i), k, 0.);
  return T;
}

/// Return the combinations w of moments that vanish for all displacements, w'C = 0, times the root
/// of the @p largest entry of A = C K^+ C'.
MultiVector dependent_moments(const MultiVector &A, const MultiVector &N, const double largest)
{
  const double cut = 1e-8; // of the largest compliance; independent moments have 1e-4 and more
  MultiVector  sum(A.n_rows(), A.n_rows());
  for (unsigned int i = 0; i < A.n_rows(); ++i)
    for (unsigned int j = 0; j < A.n_rows(); ++j)
      {
        sum(i, j) = 0.5 * (A(i, j) + A(j, i)) / largest;
        for (unsigned int mode = 0; mode < N.n_columns(); ++mode)
          sum(i, j) += N(i, mode) * N(j, mode);
      }
  MultiVector W(A.n_rows(), 0);
  const auto  w = qp::null_space(sum, cut);
  W.append(w);
  W.add(std::sqrt(largest) - 1., w);
  return W;
}

std::shared_ptr<const SubdomainJoints> joints_of_subdomain(const SubdomainSystem  &system,
                                                           const SubdomainFactors &factors,
                                                           const Joints           &joints)
{
  auto               result = std::make_shared<SubdomainJoints>();
  const unsigned int k      = n_moments(joints);
  if (k == 0)
    return result; // a cluster of one subdomain
  MultiVector unit(k, k), transposed(system.n_dofs(), k);
  for (unsigned int i = 0; i < k; ++i)
    unit(i, i) = 1.;
  add_transposed_moments(joints, unit, transposed);
  result->Y = MultiVector(system.n_dofs(), k);
  factors.inverse.apply(transposed, result->Y);
  auto compliance = moments(joints, result->Y);
  result->N       = moments(joints, system.R);
  for (unsigned int i = 0; i < k; ++i)
    result->compliance = std::max(result->compliance, compliance(i, i));
  result->W = dependent_moments(compliance, result->N, result->compliance);
  for (unsigned int l = 0; l < result->W.n_columns(); ++l)
    for (unsigned int i = 0; i < k; ++i)
      for (unsigned int j = 0; j < k; ++j)
        compliance(i, j) += result->W(i, l) * result->W(j, l);
  result->T = bordered_inverse(compliance, result->N, result->compliance);
  return result;
}
} // namespace

ClusterInverse::ClusterInverse(const ClusterStructure             &the_structure,
                               const SubdomainTable               &the_table,
                               const std::vector<SubdomainSystem> &the_systems,
                               const FactorsOfSubdomains          &factors,
                               JointsOfSubdomains                 &shared)
  : structure(the_structure), table(the_table), systems(the_systems)
{
  set_rigid_modes();
  for (unsigned int s = 0; s < systems.size(); ++s)
    if (!shared[s])
      shared[s] = joints_of_subdomain(systems[s], *factors[s], table.joints[s]);
  joints = shared;
  factorize();
}

/// The rigid modes of the body, R_s Z_s on each subdomain, are orthonormalized on the cluster.
void ClusterInverse::set_rigid_modes()
{
  const unsigned int m = table.n_modes;
  MultiVector        gram(table.n_clusters() * m, m);
  for (unsigned int s = 0; s < systems.size(); ++s)
    {
      const auto of_subdomain = transpose_times(systems[s].Z, systems[s].Z);
      const auto first        = table.cluster_of(table.first + s) * m;
      for (unsigned int j = 0; j < m; ++j)
        for (unsigned int i = 0; i < m; ++i)
          gram(first + i, j) += of_subdomain(i, j);
    }
  sum_over_ranks(gram, structure.communicator());
  for (unsigned int s = 0; s < systems.size(); ++s)
    {
      const unsigned int cluster = table.cluster_of(table.first + s);
      MultiVector        of_cluster(m, m);
      for (unsigned int j = 0; j < m; ++j)
        for (unsigned int i = 0; i < m; ++i)
          of_cluster(i, j) = gram(cluster * m + i, j);
      const auto C = orthonormal(of_cluster);
      R.push_back(times(systems[s].R, times(systems[s].Z, C)));
      // C' gram C = I, so that the inverse of C is C' gram.
      Z.push_back(table.first_of_cluster(cluster) == table.first + s
                    ? transpose_times(C, of_cluster)
                    : MultiVector(0, m));
    }
}

/// Sum S_c at the homes and factorize it. The rigid motions of the cluster have the moments C R.
void ClusterInverse::factorize()
{
  const unsigned int                     m = table.n_modes;
  std::vector<ClusterStructure::Numbers> of_subdomains(systems.size());
  for (unsigned int s = 0; s < systems.size(); ++s)
    {
      const auto         N = moments(table.joints[s], R[s]);
      const unsigned int k = N.n_rows();
      for (unsigned int j = 0; j < k; ++j)
        of_subdomains[s].insert(of_subdomains[s].end(), joints[s]->T.column(j),
                                joints[s]->T.column(j) + k);
      of_subdomains[s].insert(of_subdomains[s].end(), N.column(0), N.column(m));
      of_subdomains[s].push_back(joints[s]->compliance);
    }
  const auto received =
    structure.to_homes(of_subdomains, [m](unsigned int k) { return k * (k + m) + 1; });
  throw_collectively(structure.communicator(), [&]() {
    for (const auto &cluster : structure.clusters())
      {
        CsrMatrix sum(cluster.pattern);
        double    stiffness = 0.;
        for (const unsigned int i : cluster.members)
          {
            const auto &unknowns = structure.members()[i].unknowns;
            stiffness += 1. / received[i].back() / static_cast<double>(cluster.members.size());
            for (unsigned int a = 0; a < unknowns.size(); ++a)
              for (unsigned int b = 0; b < unknowns.size(); ++b)
                sum.values[sum.position(unknowns[a], unknowns[b])] +=
                  received[i][std::size_t(a) * unknowns.size() + b];
          }
        // The first joint of the first member has the unknowns 0 to m - 1.
        const auto               &first = structure.members()[cluster.members.front()];
        const std::size_t         k     = first.unknowns.size();
        const double             *N     = &received[cluster.members.front()][k * k];
        std::vector<unsigned int> fixed(first.unknowns.begin(), first.unknowns.begin() + m);
        MultiVector               N_fixed(m, m);
        for (unsigned int j = 0; j < m; ++j)
          for (unsigned int i = 0; i < m; ++i)
            N_fixed(i, j) = N[j * k + i];
        // S_c itself may be zero, as of two subdomains, and has then no scale.
        fix_kernel(sum, fixed, N_fixed, stiffness);
        S.push_back(structure.factors.factorize(sum, "the joints of a cluster of subdomains"));
      }
  });
}

std::vector<MultiVector> ClusterInverse::join(const PrimalVectors &b, PrimalVectors &x) const
{
  const unsigned int                     n_columns = b.n_columns(), m = table.n_modes;
  std::vector<ClusterStructure::Numbers> of_subdomains(systems.size());
  std::vector<MultiVector>               e; // R'b of each subdomain
  for (unsigned int s = 0; s < systems.size(); ++s)
    {
      e.push_back(transpose_times(systems[s].R, b[s]));
      const unsigned int k = joints[s]->N.n_rows();
      if (k == 0)
        continue;
      const auto  t = moments(table.joints[s], x[s]);
      MultiVector given(k + m, n_columns);
      for (unsigned int j = 0; j < n_columns; ++j)
        {
          std::copy(t.column(j), t.column(j) + k, given.column(j));
          for (unsigned int i = 0; i < m; ++i)
            given(k + i, j) = -e[s](i, j);
        }
      const auto forces = times(joints[s]->T, given);
      for (unsigned int j = 0; j < n_columns; ++j)
        of_subdomains[s].insert(of_subdomains[s].end(), forces.column(j), forces.column(j) + k);
    }
  const auto               q = solve_moments(of_subdomains, n_columns);
  std::vector<MultiVector> mu;
  for (unsigned int s = 0; s < systems.size(); ++s)
    mu.push_back(prescribe_moments(s, q[s], e[s], x[s]));
  return mu;
}

/// Solve S_c q = h at the homes, where the numbers of the subdomains are their parts of h. Return
/// the moments q of each subdomain.
std::vector<ClusterStructure::Numbers>
ClusterInverse::solve_moments(const std::vector<ClusterStructure::Numbers> &of_subdomains,
                              const unsigned int                            n_columns) const
{
  const auto size       = [n_columns](unsigned int k) { return k * n_columns; };
  auto       of_members = structure.to_homes(of_subdomains, size);
  for (std::size_t c = 0; c < S.size(); ++c)
    {
      const auto &cluster = structure.clusters()[c];
      MultiVector h(cluster.pattern->n_rows, n_columns), q = h;
      for (const unsigned int i : cluster.members)
        {
          const auto &unknowns = structure.members()[i].unknowns;
          for (unsigned int j = 0; j < n_columns; ++j)
            for (unsigned int a = 0; a < unknowns.size(); ++a)
              h(unknowns[a], j) += of_members[i][j * unknowns.size() + a];
        }
      S[c]->solve(h, q);
      for (const unsigned int i : cluster.members)
        {
          const auto &unknowns = structure.members()[i].unknowns;
          for (unsigned int j = 0; j < n_columns; ++j)
            for (unsigned int a = 0; a < unknowns.size(); ++a)
              of_members[i][j * unknowns.size() + a] = q(unknowns[a], j);
        }
    }
  return structure.to_subdomains(of_members, size);
}

/// Change @p x = K^+ b of a subdomain with R'b = @p e such that its moments are @p q. Return mu.
MultiVector ClusterInverse::prescribe_moments(const unsigned int               s,
                                              const ClusterStructure::Numbers &q,
                                              const MultiVector               &e,
                                              MultiVector                     &x) const
{
  const SubdomainJoints &of = *joints[s];
  const unsigned int     k = of.N.n_rows(), m = table.n_modes;
  MultiVector            mu(k, x.n_columns());
  // The second pass removes the rounding errors of T, after which the moments of both sides of a
  // joint are equal. Otherwise F would be small instead of zero along the forces of joints, and
  // iterations could not reach residuals below 1e-10.
  for (unsigned int pass = 0; pass < 2 && k > 0; ++pass)
    {
      const auto  t       = moments(table.joints[s], x);
      const auto  springs = times(of.W, transpose_times(of.W, mu));
      const auto  balance = transpose_times(of.N, mu);
      MultiVector rest(k + m, x.n_columns());
      for (unsigned int j = 0; j < x.n_columns(); ++j)
        {
          for (unsigned int i = 0; i < k; ++i)
            rest(i, j) = t(i, j) - springs(i, j) - q[std::size_t(j) * k + i];
          for (unsigned int i = 0; i < m; ++i)
            rest(k + i, j) = balance(i, j) - e(i, j);
        }
      const auto  both = times(of.T, rest);
      MultiVector forces(k, x.n_columns()), alpha(m, x.n_columns());
      for (unsigned int j = 0; j < x.n_columns(); ++j)
        {
          std::copy(both.column(j), both.column(j) + k, forces.column(j));
          std::copy(both.column(j) + k, both.column(j) + k + m, alpha.column(j));
        }
      mu.add(1., forces);
      x.add_product(-1., of.Y, forces);
      x.add_product(1., systems[s].R, alpha);
    }
  return mu;
}

PrimalVectors ClusterInverse::forces(const std::vector<MultiVector> &mu,
                                     const unsigned int              n_columns) const
{
  PrimalVectors result(n_columns);
  for (unsigned int s = 0; s < systems.size(); ++s)
    {
      result.emplace_back(systems[s].n_dofs());
      add_transposed_moments(table.joints[s], mu[s], result.back());
    }
  return result;
}
} // namespace snug::feti
