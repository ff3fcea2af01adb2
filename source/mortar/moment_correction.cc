#include <snug/mortar/moment_correction.h>

#include <array>
#include <cmath>

namespace snug::mortar {
namespace {
template <int dim, typename Number>
using Vector = dealii::Tensor<1, dim, Number>;

template <int dim, typename Number>
using SquareMatrix = std::array<Vector<dim, Number>, dim>;

/// Return A^-1 b of a positive definite matrix by elimination.
template <int dim, typename Number>
Vector<dim, Number> solve(SquareMatrix<dim, Number> A, Vector<dim, Number> b)
{
  for (int i = 0; i < dim; ++i)
    for (int k = i + 1; k < dim; ++k)
      {
        const Number factor = A[k][i] / A[i][i];
        A[k] -= factor * A[i];
        b[k] -= factor * b[i];
      }
  for (int i = dim; i-- > 0;)
    {
      for (int k = i + 1; k < dim; ++k)
        b[i] -= A[i][k] * b[k];
      b[i] = b[i] / A[i][i];
    }
  return b;
}

/// Directions in which the spread of the nodes is less than this fraction of the maximum spread, in
/// squared distances, do not count.
const double least_spread = 1e-8;

/// Return whether the tangential part of A is regular. The normal entry of A is its trace @p trace.
bool is_regular(const SquareMatrix<2, double> &, double trace)
{
  return trace > 0.;
}

bool is_regular(const SquareMatrix<3, double> &A, double trace)
{
  const double determinant = A[0][0] * (A[1][1] * A[2][2] - A[1][2] * A[2][1]) -
                             A[0][1] * (A[1][0] * A[2][2] - A[1][2] * A[2][0]) +
                             A[0][2] * (A[1][0] * A[2][1] - A[1][1] * A[2][0]);
  return trace > 0. && determinant > least_spread * trace * trace * trace;
}

/// Return c for the differences @p d of the nodes to their mean.
template <int dim, typename Number>
Vector<dim, Number> solve_for_c(const std::vector<Vector<dim, Number>> &d,
                                const std::vector<Number>              &weights,
                                const Vector<dim, Number>              &n,
                                const Vector<dim, Number>              &G)
{
  const auto tangential = [&n](const Vector<dim, Number> &v) -> Vector<dim, Number> {
    return v - (v * n) * n;
  };
  Number                    trace = 0.;
  SquareMatrix<dim, Number> A;
  for (std::size_t k = 0; k < d.size(); ++k)
    {
      const auto t = tangential(d[k]);
      for (int i = 0; i < dim; ++i)
        A[i] += (weights[k] * t[i]) * t;
      trace += weights[k] * (t * t);
    }
  // Fill the normal direction of A, because c is at right angles to n for any value there.
  for (int i = 0; i < dim; ++i)
    A[i] += (trace * n[i]) * n;
  SquareMatrix<dim, double> values;
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
      values[i][j] = faces::value_of(A[i][j]);
  return is_regular(values, faces::value_of(trace)) ? -solve<dim>(A, tangential(G))
                                                    : Vector<dim, Number>();
}
} // namespace

template <int dim, typename Number>
std::vector<Number> moment_correction(std::vector<dealii::Tensor<1, dim, Number>> x,
                                      const std::vector<Number>                  &coefficients,
                                      const std::vector<Number>                  &weights,
                                      const dealii::Tensor<1, dim, Number>       &n)
{
  Number              sum = 0.;
  Vector<dim, Number> G, middle;
  for (std::size_t k = 0; k < x.size(); ++k)
    {
      sum += weights[k];
      G -= coefficients[k] * x[k];
    }
  std::vector<Number> dM(x.size(), Number(0.));
  if (!(faces::value_of(sum) > 0.))
    return dM;
  for (std::size_t k = 0; k < x.size(); ++k)
    middle += (weights[k] / sum) * x[k];
  for (auto &d : x)
    d -= middle;
  const auto c = solve_for_c<dim>(x, weights, n, G);
  for (std::size_t k = 0; k < x.size(); ++k)
    dM[k] = weights[k] * (c * x[k]);
  return dM;
}

#define SNUG_INSTANTIATE(dim, Number)                                                         \
  template std::vector<Number> moment_correction(std::vector<dealii::Tensor<1, dim, Number>>, \
                                                 const std::vector<Number> &,                 \
                                                 const std::vector<Number> &,                 \
                                                 const dealii::Tensor<1, dim, Number> &);
SNUG_INSTANTIATE(2, double)
SNUG_INSTANTIATE(2, faces::Differential<1>)
SNUG_INSTANTIATE(2, faces::Recorded)
SNUG_INSTANTIATE(3, double)
SNUG_INSTANTIATE(3, faces::Differential<1>)
SNUG_INSTANTIATE(3, faces::Recorded)
#undef SNUG_INSTANTIATE
} // namespace snug::mortar
