#include <snug/base/narrow.h>
#include <snug/feti/soft_modes.h>
#include <snug/qp/independent_columns.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <tuple>

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
const double mode_dependence = 1e-8;

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
    for (const JumpColumn &column : columns)
      for (const auto &copy : column.copies)
        if (copy.subdomain == subdomain)
          {
            own.push_back({position[copy.dof], position[column.dof], copy.value});
            if (copy.dof == column.dof)
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
  return qp::orthonormal_combinations(gram, std::vector<double>(gram.n_columns(), 0.),
                                      mode_dependence);
}

/// An entry P_ji of the columns of subdomain s at a neighbour t, where j is an unknown of t and i
/// one of s; or an entry of P_t' K_t P_t, where both i and j are unknowns of s.
struct NeighbourEntry
{
  unsigned int s, t, j, i;
  double       value;

  template <typename Archive>
  void serialize(Archive &archive, unsigned int)
  {
    archive & s & t & j & i & value;
  }
};

using NeighbourEntries = std::vector<NeighbourEntry>;

bool by_subdomains(const NeighbourEntry &a, const NeighbourEntry &b)
{
  return std::tie(a.s, a.t) < std::tie(b.s, b.t);
}

/// Append (i, i', P_ji K_jj' P_j'i') to @p products for all pairs of the entries @p begin to @p
/// end, which belong to one s and one t, that K couples.
void append_products(const CsrMatrix                 &K,
                     NeighbourEntries::const_iterator begin,
                     NeighbourEntries::const_iterator end,
                     NeighbourEntries                &products)
{
  NeighbourEntries reached(begin, end);
  std::sort(reached.begin(), reached.end(), [](const NeighbourEntry &a, const NeighbourEntry &b) {
    return std::tie(a.j, a.i, a.value) < std::tie(b.j, b.i, b.value);
  });
  std::vector<std::size_t> start(K.n_rows() + 1, 0); // of each j
  for (const auto &entry : reached)
    ++start[entry.j + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());
  for (const auto &a : reached)
    for (PetscInt place = K.row_start()[a.j]; place < K.row_start()[a.j + 1]; ++place)
      for (auto b = start[K.columns()[place]]; b < start[K.columns()[place] + 1]; ++b)
        products.push_back(
          {a.s, a.t, reached[b].i, a.i, a.value * reached[b].value * K.values[place]});
}
} // namespace

/// Subdomain t has K_t, but the jumps that s causes at its unknowns are in the columns of s.
/// Therefore s sends these columns to t, and t returns the products with K_t.
std::vector<Entries> stiffness_of_neighbours(const std::vector<SubdomainSystem> &systems,
                                             const std::vector<JumpColumns>     &columns,
                                             const unsigned int                  first,
                                             MPI_Comm                            comm)
{
  const SubdomainRanks                     rank_of(first, comm);
  std::map<unsigned int, NeighbourEntries> questions, answers;
  for (unsigned int s = 0; s < columns.size(); ++s)
    for (const JumpColumn &column : columns[s])
      for (const auto &copy : column.copies)
        if (copy.subdomain != first + s && copy.value != 0.)
          questions[rank_of(copy.subdomain)].push_back(
            {first + s, copy.subdomain, copy.dof, column.dof, copy.value});
  for (auto &[rank, entries] : dealii::Utilities::MPI::some_to_some(comm, questions))
    {
      std::stable_sort(entries.begin(), entries.end(), by_subdomains);
      for (auto begin = entries.begin(); begin != entries.end();)
        {
          const auto end = std::upper_bound(begin, entries.end(), *begin, by_subdomains);
          append_products(systems[begin->t - first].K, begin, end, answers[rank]);
          begin = end;
        }
    }
  auto received = dealii::Utilities::MPI::some_to_some(comm, answers);
  answers.clear(); // the entries take much memory
  NeighbourEntries all;
  for (auto &message : received)
    {
      all.insert(all.end(), message.second.begin(), message.second.end());
      message.second = NeighbourEntries();
    }
  // Sum over neighbours in their global order, independently of the ranks that hold them.
  std::stable_sort(all.begin(), all.end(), by_subdomains);
  std::vector<Entries> result(systems.size());
  for (const auto &entry : all)
    result[entry.s - first].push_back({entry.i, entry.j, entry.value});
  return result;
}

SoftModes soft_modes(const SubdomainSystem  &system,
                     const SubdomainFactors &factors,
                     const JumpColumns      &columns,
                     const Entries          &neighbours,
                     const unsigned int      subdomain)
{
  const LocalSchur  &schur = *factors.schur;
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
      factors.inverse.apply(from_boundary(AV, schur, n), x);
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
  std::set<unsigned int> neighbourhood = {subdomain};
  result.subdomain                     = subdomain;
  for (const JumpColumn &column : columns)
    {
      for (const auto &copy : column.copies)
        neighbourhood.insert(copy.subdomain);
      for (const auto &force : column.forces)
        result.rows.push_back(force.row);
    }
  result.neighbourhood.assign(neighbourhood.begin(), neighbourhood.end());
  std::sort(result.rows.begin(), result.rows.end());
  result.rows.erase(std::unique(result.rows.begin(), result.rows.end()), result.rows.end());
  const auto k  = narrow<unsigned int>(modes.mu.size());
  result.values = qp::MultiVector(narrow<unsigned int>(result.rows.size()), k);
  for (const JumpColumn &column : columns)
    for (const auto &force : column.forces)
      {
        const auto row =
          narrow<unsigned int>(std::lower_bound(result.rows.begin(), result.rows.end(), force.row) -
                               result.rows.begin());
        for (unsigned int j = 0; j < k; ++j)
          result.values(row, j) += force.value * modes.forces(column.dof, j);
      }
  return result;
}
} // namespace snug::feti
