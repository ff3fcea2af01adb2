#include <snug/mortar/moment_correction.h>

#include <cmath>

namespace snug::mortar {
namespace {
/// Add factor b to a.
template <typename Number, std::size_t dim>
void add(const Number &factor, const std::array<Number, dim> &b, std::array<Number, dim> &a)
{
  for (std::size_t i = 0; i < dim; ++i)
    a[i] += factor * b[i];
}

/// Return v without its part along the unit vector @p n.
template <typename Number, std::size_t dim>
std::array<Number, dim> tangential(std::array<Number, dim> v, const std::array<Number, dim> &n)
{
  add(-faces::dot(v, n), n, v);
  return v;
}

/// Return A^-1 b of a positive definite matrix by elimination.
template <typename Number, std::size_t dim>
std::array<Number, dim> solve(std::vector<std::array<Number, dim>> A, std::array<Number, dim> b)
{
  for (std::size_t i = 0; i < dim; ++i)
    for (std::size_t k = i + 1; k < dim; ++k)
      {
        const Number factor = A[k][i] / A[i][i];
        add(-factor, A[i], A[k]);
        b[k] -= factor * b[i];
      }
  for (std::size_t i = dim; i-- > 0;)
    {
      for (std::size_t k = i + 1; k < dim; ++k)
        b[i] -= A[i][k] * b[k];
      b[i] = b[i] / A[i][i];
    }
  return b;
}

/// Return the weighted mean of the x_k.
template <typename Number, std::size_t dim>
std::array<Number, dim> mean(const std::vector<std::array<Number, dim>> &x,
                             const std::vector<Number>                  &weights,
                             const Number                               &sum)
{
  std::array<Number, dim> result{};
  for (std::size_t k = 0; k < x.size(); ++k)
    add(weights[k] / sum, x[k], result);
  return result;
}

/// Directions in which the spread of the nodes is less than this fraction of the maximum spread, in
/// squared distances, do not count.
const double least_spread = 1e-8;

/// Return whether the tangential part of A is regular. The normal entry of A is its trace @p trace.
bool is_regular(const std::vector<std::array<double, 2>> &, double trace)
{
  return trace > 0.;
}

bool is_regular(const std::vector<std::array<double, 3>> &A, double trace)
{
  const double determinant = A[0][0] * (A[1][1] * A[2][2] - A[1][2] * A[2][1]) -
                             A[0][1] * (A[1][0] * A[2][2] - A[1][2] * A[2][0]) +
                             A[0][2] * (A[1][0] * A[2][1] - A[1][1] * A[2][0]);
  return trace > 0. && determinant > least_spread * trace * trace * trace;
}
} // namespace

template <int dim, typename Number>
MomentCorrection<dim, Number>::MomentCorrection(const std::vector<Vector> &x,
                                                const std::vector<Number> &coefficients,
                                                const std::vector<Number> &weights,
                                                const Vector              &n)
  : x(x), d(x), coefficients(coefficients), weights(weights), dM(x.size(), Number(0.)), n(n)
{
  Number sum = 0.;
  for (std::size_t k = 0; k < x.size(); ++k)
    {
      sum += weights[k];
      add(-coefficients[k], x[k], G);
    }
  if (!(faces::value_of(sum) > 0.))
    return;
  const Vector middle = mean(x, weights, sum);
  for (auto &distance : d)
    add(Number(-1.), middle, distance);
  solve_for_c();
  for (std::size_t k = 0; k < x.size(); ++k)
    dM[k] = weights[k] * faces::dot(c, d[k]);
}

template <int dim, typename Number>
void MomentCorrection<dim, Number>::solve_for_c()
{
  Number trace = 0.;
  A.assign(dim, Vector{});
  for (std::size_t k = 0; k < d.size(); ++k)
    {
      const Vector t = tangential(d[k], n);
      for (int i = 0; i < dim; ++i)
        add(weights[k] * t[i], t, A[i]);
      trace += weights[k] * faces::dot(t, t);
    }
  // Fill the normal direction of A, because c is at right angles to n for any value there.
  for (int i = 0; i < dim; ++i)
    add(trace * n[i], n, A[i]);
  std::vector<std::array<double, dim>> values(dim);
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
      values[i][j] = faces::value_of(A[i][j]);
  if (!is_regular(values, faces::value_of(trace)))
    {
      A.clear();
      return;
    }
  c = solve(A, tangential(G, n));
  for (auto &component : c)
    component *= -1.;
}

/// Differentiate the scalar. With b = sum_k w_k q_k d_k and e = -A^+ P b it is b . c = e . G, and
/// d(b . c) = c . db + e . dG + e' dS c. The last lines include the rotation of P.
template <int dim, typename Number>
typename MomentCorrection<dim, Number>::Gradient
MomentCorrection<dim, Number>::gradient(const std::vector<Number> &q) const
{
  Gradient result{std::vector<Vector>(x.size(), Vector{}),
                  std::vector<Number>(x.size(), Number(0.)),
                  std::vector<Number>(x.size(), Number(0.)),
                  {}};
  if (A.empty())
    return result;
  Number sum = 0., mean_q = 0.;
  for (std::size_t k = 0; k < x.size(); ++k)
    {
      sum += weights[k];
      mean_q += weights[k] * q[k];
    }
  mean_q /= sum;
  Vector b{}, Sc{}, Se{};
  for (std::size_t k = 0; k < x.size(); ++k)
    {
      add(weights[k] * (q[k] - mean_q), d[k], b);
      add(weights[k] * faces::dot(d[k], c), d[k], Sc);
    }
  Vector e = solve(A, tangential(b, n));
  for (auto &component : e)
    component *= -1.;
  for (std::size_t k = 0; k < x.size(); ++k)
    {
      const Number along_c = faces::dot(c, d[k]), along_e = faces::dot(e, d[k]),
                   apart = q[k] - mean_q;
      add(weights[k] * along_e, d[k], Se);
      result.weights[k]      = along_c * (along_e + apart);
      result.coefficients[k] = -faces::dot(e, x[k]);
      add(weights[k] * (along_e + apart), c, result.x[k]);
      add(weights[k] * along_c - coefficients[k], e, result.x[k]);
    }
  add(-(faces::dot(n, b) + faces::dot(n, Se)), c, result.n);
  add(-(faces::dot(n, G) + faces::dot(n, Sc)), e, result.n);
  return result;
}

template class MomentCorrection<2, double>;
template class MomentCorrection<3, double>;
template class MomentCorrection<2, faces::Differential<1>>;
template class MomentCorrection<3, faces::Differential<1>>;
} // namespace snug::mortar
