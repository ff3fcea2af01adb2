#include <random/dense_algebra.h>
#include <random/dense_problem.h>
#include <random/lemke.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

namespace snug::test {
namespace {
/// Tolerance of a solution, relative to its forces and gaps.
const double exact = 1e-10;
} // namespace

Vector DenseOracle::without_held(Vector v) const
{
  for (const auto &row : problem.held)
    add(-times(row, v), row, v);
  return v;
}

Vector DenseOracle::stiffness_times(const Vector &u) const
{
  Vector result(u.size());
  for (unsigned int b = 0; b < problem.K.size(); ++b)
    for (unsigned int i = 0; i < problem.K[b].m(); ++i)
      for (unsigned int j = 0; j < problem.K[b].n(); ++j)
        result(problem.first[b] + i) += problem.K[b](i, j) * u(problem.first[b] + j);
  return result;
}

/// P K P + kappa (1 - P) + kappa N N' of each body, P without what is held: of balanced loads its
/// inverse makes displacements without a part along N.
void DenseOracle::factorize()
{
  kappa = 0.;
  for (const auto &K : problem.K)
    for (unsigned int i = 0; i < K.m(); ++i)
      kappa += K(i, i) / problem.f.size();
  for (unsigned int b = 0; b < problem.K.size(); ++b)
    {
      const unsigned int first = problem.first[b], n = problem.K[b].m();
      Matrix             A = problem.K[b];
      for (const auto &row : problem.held)
        if (row.coefficients[0].first >= first && row.coefficients[0].first < first + n)
          {
            Vector q(n), Aq(n);
            for (const auto &[i, c] : row.coefficients)
              q(i - first) = c;
            A.vmult(Aq, q);
            const double both = q * Aq + kappa;
            for (const auto &[i, c] : row.coefficients)
              for (unsigned int j = 0; j < n; ++j)
                {
                  A(i - first, j) -= c * Aq(j);
                  A(j, i - first) -= c * Aq(j);
                }
            for (const auto &[i, c] : row.coefficients)
              for (const auto &[j, d] : row.coefficients)
                A(i - first, j - first) += both * c * d;
          }
      for (unsigned int k = 0; k < N.n(); ++k)
        if (body_of[k] == b)
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int j = 0; j < n; ++j)
              A(i, j) += kappa * N(first + i, k) * N(first + j, k);
      factors.emplace_back(n);
      factors.back() = A;
      factors.back().set_property(dealii::LAPACKSupport::symmetric);
      factors.back().compute_cholesky_factorization();
    }
}

Vector DenseOracle::elastic(const Vector &b) const
{
  Vector result = without_held(b);
  for (unsigned int body = 0; body < factors.size(); ++body)
    {
      Vector part(problem.K[body].m());
      for (unsigned int i = 0; i < part.size(); ++i)
        part(i) = result(problem.first[body] + i);
      factors[body].solve(part);
      for (unsigned int i = 0; i < part.size(); ++i)
        result(problem.first[body] + i) = part(i);
    }
  return result;
}

void DenseOracle::find_compliance()
{
  const unsigned int m = problem.contact.size();
  Vector             held(problem.f.size());
  for (const auto &row : problem.held)
    add(row.bound, row, held);
  Vector rest = problem.f;
  rest -= stiffness_times(held);
  u_0 = elastic(rest);
  u_0 += held;
  F.reinit(m, m);
  q.reinit(m);
  for (unsigned int j = 0; j < m; ++j)
    {
      Vector unit(problem.f.size());
      add(1., problem.contact[j], unit);
      const Vector moved = elastic(unit);
      for (unsigned int i = 0; i < m; ++i)
        F(i, j) = kappa * times(problem.contact[i], moved);
      q(j) = kappa * (problem.contact[j].bound - times(problem.contact[j], u_0));
    }
  scale = std::max(load.linfty_norm(), q.linfty_norm());
  if (scale == 0.)
    scale = 1.;
}

namespace {
/// w = q + F lambda - G alpha and G'lambda = load, solved for alpha and as many of lambda, J:
/// what is left is a complementarity problem of w of the others K and lambda_J, the signed
/// numbers, with lambda_K and w_J.
class Exchange
{
public:
  Exchange(const Matrix &F, const Matrix &G, const std::vector<unsigned int> &rows)
    : F(F), G(G), J(rows), in_J(F.m(), false), inverse(2 * J.size())
  {
    const unsigned int k = J.size();
    for (unsigned int a = 0; a < k; ++a)
      {
        in_J[J[a]] = true;
        for (unsigned int b = 0; b < k; ++b)
          {
            inverse(a, b)     = F(J[a], J[b]);
            inverse(a, k + b) = -G(J[a], b);
            inverse(k + b, a) = G(J[a], b);
          }
      }
    if (k > 0)
      inverse.gauss_jordan();
  }

  /// lambda and alpha of @p x, lambda_K and w_J in the places of the rows.
  Vector solution(const Vector &x, const Vector &q, const Vector &load) const
  {
    const unsigned int k = J.size(), m = F.m();
    Vector             z(m + k), right(2 * k), left(2 * k);
    for (unsigned int i = 0; i < m; ++i)
      z(i) = in_J[i] ? 0. : x(i);
    for (unsigned int a = 0; a < k; ++a)
      {
        right(a)     = x(J[a]) - q(J[a]);
        right(k + a) = load(a);
        for (unsigned int i = 0; i < m; ++i)
          {
            right(a) -= F(J[a], i) * z(i);
            right(k + a) -= G(i, a) * z(i);
          }
      }
    if (k > 0)
      inverse.vmult(left, right);
    for (unsigned int a = 0; a < k; ++a)
      {
        z(J[a])  = left(a);
        z(m + a) = left(k + a);
      }
    return z;
  }

  /// w_K and lambda_J in the places of the rows.
  Vector complement(const Vector &x, const Vector &q, const Vector &load) const
  {
    const unsigned int m = F.m();
    const Vector       z = solution(x, q, load);
    Vector             y = q;
    for (unsigned int i = 0; i < m; ++i)
      {
        for (unsigned int j = 0; j < m; ++j)
          y(i) += F(i, j) * z(j);
        for (unsigned int a = 0; a < J.size(); ++a)
          y(i) -= G(i, a) * z(m + a);
        if (in_J[i])
          y(i) = z(i);
      }
    return y;
  }

private:
  const Matrix             &F, &G;
  std::vector<unsigned int> J;
  std::vector<bool>         in_J;
  Matrix                    inverse;
};
} // namespace

/// z = [lambda; alpha] by Lemke's method; motions that no row sees are left out.
Vector DenseOracle::complementary(const Vector &covering) const
{
  const unsigned int m     = q.size();
  const auto         seen  = null_space(BN, 1e-8);
  const auto        &moved = seen.pivot_columns;
  Matrix             G(m, moved.size()), M(m, m);
  Vector             forces(moved.size()), nothing(moved.size()), gaps = q, zero(m);
  gaps /= scale;
  for (unsigned int a = 0; a < moved.size(); ++a)
    {
      forces(a) = load(moved[a]) / scale;
      for (unsigned int i = 0; i < m; ++i)
        G(i, a) = BN(i, moved[a]);
    }
  const Exchange exchange(F, G, seen.pivot_rows);
  const Vector   start = exchange.complement(zero, gaps, forces);
  for (unsigned int j = 0; j < m; ++j)
    {
      Vector unit(m);
      unit(j)             = 1.;
      const Vector column = exchange.complement(unit, zero, nothing);
      for (unsigned int i = 0; i < m; ++i)
        M(i, j) = column(i);
    }
  const auto found = lemke(M, start, covering);
  if (!found)
    throw std::runtime_error("the complementary pivots end on a ray");
  const Vector reduced = exchange.solution(*found, gaps, forces);
  Vector       z(m + load.size());
  for (unsigned int i = 0; i < m; ++i)
    z(i) = reduced(i) * scale;
  for (unsigned int a = 0; a < moved.size(); ++a)
    z(m + moved[a]) = reduced(m + a) * scale;
  return z;
}

/// The linear equations of the rows with a force, solved for what the pivots' rounding left.
void DenseOracle::refine(Vector &z) const
{
  const unsigned int        m = q.size(), k = load.size();
  std::vector<unsigned int> rows;
  for (unsigned int i = 0; i < m; ++i)
    if (z(i) > 1e-12 * scale)
      rows.push_back(i);
    else
      z(i) = 0.;
  const unsigned int n = rows.size();
  Matrix             S(n + k, n + k);
  for (unsigned int a = 0; a < n; ++a)
    {
      for (unsigned int b = 0; b < n; ++b)
        S(a, b) = F(rows[a], rows[b]);
      for (unsigned int j = 0; j < k; ++j)
        {
          S(a, n + j) = -BN(rows[a], j);
          S(n + j, a) = BN(rows[a], j);
        }
    }
  for (unsigned int step = 0; step < 3; ++step)
    {
      Vector b(n + k);
      for (unsigned int a = 0; a < n; ++a)
        b(a) = -q(rows[a]);
      for (unsigned int j = 0; j < k; ++j)
        b(n + j) = load(j);
      for (unsigned int a = 0; a < n + k; ++a)
        for (unsigned int c = 0; c < n + k; ++c)
          b(a) -= S(a, c) * (c < n ? z(rows[c]) : z(m + c - n));
      const Vector step_of = least_squares(S, b, 1e-13);
      for (unsigned int c = 0; c < n + k; ++c)
        z(c < n ? rows[c] : m + c - n) += step_of(c);
    }
}

bool DenseOracle::is_solution(const Vector &z) const
{
  const unsigned int m = q.size(), k = load.size();
  double             force = scale, gap = scale, error = 0., negative = 0.;
  for (unsigned int i = 0; i < m; ++i)
    force = std::max(force, z(i));
  for (unsigned int i = 0; i < m; ++i)
    {
      double w = q(i);
      for (unsigned int j = 0; j < m; ++j)
        w += F(i, j) * z(j);
      gap = std::max(gap, std::abs(w));
      for (unsigned int j = 0; j < k; ++j)
        w -= BN(i, j) * z(m + j);
      error    = std::max(error, z(i) > 0. ? std::abs(w) : -w);
      negative = std::max(negative, -z(i));
    }
  double unbalanced = 0.;
  for (unsigned int j = 0; j < k; ++j)
    {
      double rest = load(j);
      for (unsigned int i = 0; i < m; ++i)
        rest -= BN(i, j) * z(i);
      unbalanced = std::max(unbalanced, std::abs(rest));
    }
  return error <= exact * gap && std::max(negative, unbalanced) <= exact * force;
}

void DenseOracle::recover(const Vector &z, DenseSolution &solution) const
{
  const unsigned int m = q.size(), n = problem.f.size();
  solution.forces.reinit(m);
  solution.nodal.reinit(n);
  for (unsigned int i = 0; i < m; ++i)
    {
      solution.forces(i) = std::max(0., z(i));
      add(solution.forces(i), problem.contact[i], solution.nodal);
    }
  solution.u = u_0;
  solution.u -= elastic(solution.nodal);
  // Without the rigid motions, of which K u would be rounding: bodies may slide far.
  const Vector Ku = stiffness_times(solution.u);
  for (unsigned int k = 0; k < N.n(); ++k)
    for (unsigned int i = 0; i < n; ++i)
      solution.u(i) += N(i, k) * z(m + k) / kappa;
  solution.energy   = Ku * solution.u / 2. - problem.f * solution.u;
  Vector unbalanced = problem.f;
  unbalanced -= Ku;
  unbalanced -= solution.nodal;
  solution.force =
    std::max({problem.f.linfty_norm(), solution.nodal.linfty_norm(), Ku.linfty_norm()});
  if (without_held(unbalanced).linfty_norm() > 10. * exact * solution.force)
    throw std::runtime_error("the dense solution is not in equilibrium");
}

/// Determine the motions that supports and loaded rows leave free, and whether the forces are
/// unique.
void DenseOracle::describe(DenseSolution &solution) const
{
  const unsigned int        m = q.size(), k = N.n();
  const double              most = solution.forces.linfty_norm();
  std::vector<unsigned int> loaded, closed;
  bool                      is_sure = true;
  double                    widest  = 0.;
  for (unsigned int i = 0; i < m; ++i)
    {
      const double part = solution.forces(i) / (most > 0. ? most : 1.);
      const double gap  = problem.contact[i].bound - times(problem.contact[i], solution.u);
      is_sure           = is_sure && (part < 1e-8 || part > 1e-4);
      if (part > 1e-6)
        loaded.push_back(i);
      if (part > 0. || kappa * gap < 1e-8 * scale)
        closed.push_back(i);
      widest = std::max(widest, std::abs(problem.contact[i].bound));
    }
  Matrix seen(loaded.size() + 1, k), act(m + k, closed.size());
  for (unsigned int a = 0; a < loaded.size(); ++a)
    for (unsigned int j = 0; j < k; ++j)
      seen(a, j) = BN(loaded[a], j);
  for (unsigned int a = 0; a < closed.size(); ++a)
    {
      for (unsigned int i = 0; i < m; ++i)
        act(i, a) = F(i, closed[a]);
      for (unsigned int j = 0; j < k; ++j)
        act(m + j, a) = BN(closed[a], j);
    }
  solution.is_unique    = null_space(act, 1e-7).basis.n() == 0;
  const auto left       = null_space(seen, 1e-6);
  solution.free_is_sure = is_sure && left.least_taken > 1e-4 && left.largest_left < 1e-8;
  Matrix rigid          = N;
  if (left.basis.n() > 0)
    {
      solution.free.reinit(N.m(), left.basis.n());
      N.mmult(solution.free, left.basis);
      orthonormalise(solution.free);
    }
  orthonormalise(rigid);
  solution.length = std::max(without(rigid, solution.u).linfty_norm(), widest);
}

DenseSolution DenseOracle::solve()
{
  factorize();
  find_compliance();
  std::mt19937 generator(1);
  Vector       covering(q.size());
  covering = 1.;
  for (unsigned int attempt = 0; attempt < 5; ++attempt)
    {
      auto z = complementary(covering);
      refine(z);
      if (is_solution(z))
        {
          DenseSolution solution;
          recover(z, solution);
          describe(solution);
          return solution;
        }
      for (double &d : covering)
        d = 0.5 + generator() / double(std::mt19937::max());
    }
  throw std::runtime_error("the dense solution does not meet its conditions");
}
} // namespace snug::test
