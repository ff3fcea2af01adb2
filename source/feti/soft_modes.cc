#include <snug/base/narrow.h>
#include <snug/feti/soft_modes.h>
#include <snug/qp/independent_columns.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <random>
#include <set>

namespace snug::feti {
namespace {
/// The bound c of mu > c. Uniform boxes have no mode above 2.5. Measured: with 5 instead of 4
/// linear solves take 1 to 2 F-mults more, with 7 another 4.
const double cut = 4.;

/// Maximum number of modes per subdomain. PCPG finds the others, whose vectors would cost more than
/// the iterations they save.
const unsigned int most_modes = 24;

/// Number of columns in each step of the Krylov space.
const unsigned int block = 8;

/// Minimum number of steps, unless most_modes modes are found or the Krylov space is exhausted.
const unsigned int usual_steps = 3;

/// Pivots below this value mark columns of the Krylov space as linearly dependent on the others.
const double dependence = 1e-8;

using Entries = std::vector<JumpStiffness>;

/// The matrix A of one subdomain on its boundary unknowns.
class JumpEnergy
{
public:
  JumpEnergy(const LocalSchur  &the_schur,
             const JumpColumns &columns,
             const Entries     &the_neighbours,
             unsigned int       subdomain)
    : schur(the_schur), diagonal(the_schur.n_boundary(), 0.)
  {
    const auto &position = schur.boundary_position();
    for (unsigned int i = 0; i < columns.dofs.size(); ++i)
      for (const auto &copy : columns.copies[i])
        if (copy.subdomain == subdomain)
          {
            own.push_back({position[copy.dof], position[columns.dofs[i]], copy.value});
            if (copy.dof == columns.dofs[i])
              diagonal[position[copy.dof]] = copy.value;
          }
    for (const auto &entry : the_neighbours)
      neighbours.push_back({position[entry.i], position[entry.j], entry.value});
  }

  /// Return A x.
  qp::MultiVector operator()(const qp::MultiVector &x) const
  {
    qp::MultiVector jump(x.n_rows(), x.n_columns()), result = jump;
    for (unsigned int k = 0; k < x.n_columns(); ++k)
      for (const JumpStiffness &p : own)
        jump(p.i, k) += p.value * x(p.j, k);
    const auto forces = schur.apply(jump);
    for (unsigned int k = 0; k < x.n_columns(); ++k)
      {
        for (const JumpStiffness &p : own)
          result(p.j, k) += p.value * forces(p.i, k);
        for (const JumpStiffness &p : neighbours)
          result(p.i, k) += p.value * x(p.j, k);
      }
    return result;
  }

  /// Return y with B_s' B_D y = P_s'y = A x. In the part of the neighbours, P_s is approximated by
  /// its diagonal where supports couple the unknowns of a node.
  qp::MultiVector forces(const qp::MultiVector &x) const
  {
    // An unknown with a diagonal entry of P_s below this value carries the whole stiffness of its
    // node and causes no jump.
    const double    least = 1e-12;
    qp::MultiVector jump(x.n_rows(), x.n_columns()), others = jump;
    for (unsigned int k = 0; k < x.n_columns(); ++k)
      {
        for (const JumpStiffness &p : own)
          jump(p.i, k) += p.value * x(p.j, k);
        for (const JumpStiffness &p : neighbours)
          others(p.i, k) += p.value * x(p.j, k);
      }
    qp::MultiVector result = schur.apply(jump);
    for (unsigned int k = 0; k < x.n_columns(); ++k)
      for (unsigned int i = 0; i < x.n_rows(); ++i)
        if (diagonal[i] > least)
          result(i, k) += others(i, k) / diagonal[i];
    return result;
  }

private:
  const LocalSchur   &schur;
  Entries             own, neighbours;
  std::vector<double> diagonal; ///< diagonal of P_s
};

/// Apply the transpose of on_boundary(): the other unknowns are zero.
qp::MultiVector
from_boundary(const qp::MultiVector &x, const LocalSchur &schur, const unsigned int n)
{
  qp::MultiVector result(n, x.n_columns());
  const auto     &position = schur.boundary_position();
  for (unsigned int k = 0; k < x.n_columns(); ++k)
    for (unsigned int i = 0; i < n; ++i)
      if (position[i] < schur.n_boundary())
        result(i, k) = x(position[i], k);
  return result;
}

/// Eigenpairs of a symmetric matrix, in descending order of the eigenvalues.
struct Eigenpairs
{
  std::vector<double> values;
  qp::MultiVector     vectors;
};

Eigenpairs eigenpairs(const qp::MultiVector &H)
{
  const unsigned int               n = H.n_columns();
  dealii::LAPACKFullMatrix<double> matrix(n);
  for (unsigned int j = 0; j < n; ++j)
    for (unsigned int i = 0; i < n; ++i)
      matrix(i, j) = 0.5 * (H(i, j) + H(j, i));
  // the matrix is semidefinite, so its singular values are its eigenvalues
  matrix.compute_svd();
  Eigenpairs result{{}, qp::MultiVector(n, n)};
  for (unsigned int j = 0; j < n; ++j)
    {
      result.values.push_back(matrix.singular_value(j));
      for (unsigned int i = 0; i < n; ++i)
        result.vectors(i, j) = matrix.get_svd_vt()(j, i);
    }
  return result;
}

unsigned int count_above(const std::vector<double> &descending, const double least)
{
  return narrow<unsigned int>(std::find_if(descending.begin(), descending.end(),
                                           [&](const double mu) { return mu <= least; }) -
                              descending.begin());
}

qp::MultiVector independent(const qp::MultiVector &gram)
{
  return qp::orthonormal_combinations(gram, std::vector<double>(gram.n_columns(), 0.), dependence);
}

/// Subdomains s and t.
using Pair = std::pair<unsigned int, unsigned int>;

/// Return, for each neighbour, the triples (j, i, P_ji) of all columns that have an entry there. j
/// is an unknown of the neighbour, i one of this subdomain.
std::map<unsigned int, std::vector<double>> of_neighbours(const JumpColumns &columns,
                                                          const unsigned int subdomain)
{
  std::map<unsigned int, std::vector<double>> result;
  for (unsigned int i = 0; i < columns.dofs.size(); ++i)
    for (const auto &copy : columns.copies[i])
      if (copy.subdomain != subdomain && copy.value != 0.)
        {
          auto &list = result[copy.subdomain];
          list.insert(list.end(), {double(copy.dof), double(columns.dofs[i]), copy.value});
        }
  return result;
}

/// Call @p use for each part (s, t, size, numbers) of a message.
template <typename Use>
void for_each_part(const std::vector<double> &message, const Use &use)
{
  for (auto p = message.begin(); p != message.end();)
    {
      const Pair st   = {static_cast<unsigned int>(p[0]), static_cast<unsigned int>(p[1])};
      const auto size = static_cast<std::ptrdiff_t>(p[2]);
      p += 3;
      use(st, std::vector<double>(p, p + size));
      p += size;
    }
}

/// Return (i, i', P_ji K_jj' P_j'i') for all pairs of (j, i, P_ji) in @p list that K couples.
std::vector<double> products_with(const CsrMatrix &K, const std::vector<double> &list)
{
  std::vector<std::array<double, 3>> reached;
  for (std::size_t i = 0; i < list.size(); i += 3)
    reached.push_back({{list[i], list[i + 1], list[i + 2]}});
  std::sort(reached.begin(), reached.end());
  std::vector<std::size_t> start(K.n_rows() + 1, 0); // of each j
  for (const auto &entry : reached)
    ++start[static_cast<std::size_t>(entry[0]) + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<double> result;
  for (const auto &a : reached)
    {
      const auto j = static_cast<std::size_t>(a[0]);
      for (PetscInt place = K.row_start()[j]; place < K.row_start()[j + 1]; ++place)
        for (auto b = start[K.columns()[place]]; b < start[K.columns()[place] + 1]; ++b)
          result.insert(result.end(),
                        {a[1], reached[b][1], a[2] * reached[b][2] * K.values[place]});
    }
  return result;
}
} // namespace

/// Subdomain t has K_t, but the jumps that s causes at its unknowns are in the columns of s.
/// Therefore s sends these columns to t, and t returns the products with K_t.
std::vector<Entries> stiffness_of_neighbours(const std::vector<SubdomainSystem> &systems,
                                             const std::vector<JumpColumns>     &columns,
                                             const unsigned int                  first,
                                             MPI_Comm                            comm)
{
  const SubdomainRanks                        rank_of(first, comm);
  std::map<unsigned int, std::vector<double>> questions, answers;
  for (unsigned int s = 0; s < columns.size(); ++s)
    for (const auto &[t, list] : of_neighbours(columns[s], first + s))
      {
        auto &out = questions[rank_of(t)];
        out.insert(out.end(), {double(first + s), double(t), double(list.size())});
        out.insert(out.end(), list.begin(), list.end());
      }
  for (const auto &message : dealii::Utilities::MPI::some_to_some(comm, questions))
    for_each_part(message.second, [&](const Pair &st, const std::vector<double> &list) {
      const auto answer = products_with(systems[st.second - first].K, list);
      auto      &out    = answers[message.first];
      out.insert(out.end(), {double(st.first), double(st.second), double(answer.size())});
      out.insert(out.end(), answer.begin(), answer.end());
    });
  // Sum over neighbours in their global order, independently of the ranks that hold them.
  std::map<Pair, std::vector<double>> parts;
  for (const auto &message : dealii::Utilities::MPI::some_to_some(comm, answers))
    for_each_part(message.second,
                  [&](const Pair &st, const std::vector<double> &list) { parts[st] = list; });
  std::vector<Entries> result(systems.size());
  for (const auto &[st, part] : parts)
    for (std::size_t i = 0; i < part.size(); i += 3)
      result[st.first - first].push_back(
        {static_cast<unsigned int>(part[i]), static_cast<unsigned int>(part[i + 1]), part[i + 2]});
  return result;
}

SoftModes soft_modes(const SubdomainSystem    &system,
                     const GeneralizedInverse &inverse,
                     const LocalSchur         &schur,
                     const JumpColumns        &columns,
                     const Entries            &neighbours,
                     const unsigned int        subdomain)
{
  const JumpEnergy   A(schur, columns, neighbours, subdomain);
  const unsigned int n = system.n_dofs(), n_b = schur.n_boundary();
  // Rigid motions have no energy, and their mu is infinite. The natural coarse space covers them.
  // The other motions are A-orthogonal to the rigid motions, and K^+ A is defined for them.
  const auto R = on_boundary(system.R, schur), AR = A(R);
  const auto C = independent(transpose_times(R, AR));
  const auto N = times(R, C), AN = times(AR, C); // N'AN = I
  const auto off_rigid = [&](qp::MultiVector &x) { x.add_product(-1., N, transpose_times(AN, x)); };
  std::mt19937    random(1);
  qp::MultiVector V(n_b, block), basis(n_b, 0), S_basis(n_b, 0), A_basis(n_b, 0);
  for (unsigned int k = 0; k < block; ++k)
    for (unsigned int i = 0; i < n_b; ++i)
      V(i, k) = double(random()) / double(std::mt19937::max()) - 0.5;
  off_rigid(V);
  SoftModes       result{qp::MultiVector(n, 0), {}};
  qp::MultiVector AV = A(V), U;
  for (unsigned int step = 1; basis.n_columns() + block <= n_b; ++step)
    {
      // V <- K^+ A V, so that S V is A V of the previous V.
      qp::MultiVector x(n, AV.n_columns());
      inverse.apply(from_boundary(AV, schur, n), x);
      V                  = on_boundary(x, schur);
      qp::MultiVector SV = AV;
      off_rigid(V);
      // Orthogonalize twice, because rounding leaves parts along the first, largest vectors.
      for (unsigned int sweep = 0; sweep < 2 && basis.n_columns() > 0; ++sweep)
        {
          const auto parts = transpose_times(S_basis, V);
          V.add_product(-1., basis, parts);
          SV.add_product(-1., S_basis, parts);
        }
      const auto D = independent(transpose_times(V, SV));
      if (D.n_columns() == 0)
        break;
      V  = times(V, D);
      AV = A(V);
      basis.append(V);
      S_basis.append(times(SV, D));
      A_basis.append(AV);
      const auto pairs = eigenpairs(transpose_times(basis, A_basis));
      result.mu        = pairs.values;
      U                = pairs.vectors;
      const auto k     = count_above(result.mu, cut);
      if (k >= most_modes || (step >= usual_steps && 2 * k <= basis.n_columns()))
        break;
    }
  result.mu.resize(std::min(most_modes, count_above(result.mu, cut)));
  if (!result.mu.empty())
    result.forces = from_boundary(
      A.forces(times(basis, U.columns_from(0, narrow<unsigned int>(result.mu.size())))), schur, n);
  return result;
}

RowForces
row_forces(const SoftModes &modes, const JumpColumns &columns, const unsigned int subdomain)
{
  RowForces              result;
  std::set<unsigned int> patch = {subdomain};
  result.subdomain             = subdomain;
  for (unsigned int i = 0; i < columns.dofs.size(); ++i)
    {
      for (const auto &copy : columns.copies[i])
        patch.insert(copy.subdomain);
      for (const auto &force : columns.forces[i])
        result.rows.push_back(force.row);
    }
  result.patch.assign(patch.begin(), patch.end());
  std::sort(result.rows.begin(), result.rows.end());
  result.rows.erase(std::unique(result.rows.begin(), result.rows.end()), result.rows.end());
  const auto k  = narrow<unsigned int>(modes.mu.size());
  result.values = qp::MultiVector(narrow<unsigned int>(result.rows.size()), k);
  for (unsigned int i = 0; i < columns.dofs.size(); ++i)
    for (const auto &force : columns.forces[i])
      {
        const auto row =
          narrow<unsigned int>(std::lower_bound(result.rows.begin(), result.rows.end(), force.row) -
                               result.rows.begin());
        for (unsigned int j = 0; j < k; ++j)
          result.values(row, j) += force.value * modes.forces(columns.dofs[i], j);
      }
  return result;
}
} // namespace snug::feti
