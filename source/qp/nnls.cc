#include <snug/base/assertions.h>
#include <snug/base/errors.h>
#include <snug/base/narrow.h>
#include <snug/qp/nnls.h>


#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>

namespace snug::qp {
namespace {
const double right_angle = 1e-12; ///< cosine below which an angle counts as right

/// Return the solution of min || A(:, columns) y - b || with minimum norm of y.
std::vector<double>
least_squares(const MultiVector &A, const MultiVector &b, const std::vector<unsigned int> &columns)
{
  const auto                       n = narrow<unsigned int>(columns.size());
  dealii::LAPACKFullMatrix<double> part(A.n_rows(), n);
  for (unsigned int i = 0; i < A.n_rows(); ++i)
    for (unsigned int j = 0; j < n; ++j)
      part(i, j) = A(i, columns[j]);
  // Use singular values with a cut, because contact columns are often dependent: the nodes of a
  // flat face push in the same direction.
  part.compute_inverse_svd(1e-13);
  dealii::Vector<double> y(n);
  part.vmult(y, dealii::Vector<double>(b.column(0), b.column(0) + b.n_rows()));
  return {y.begin(), y.end()};
}

double norm_of(const double *x, unsigned int n)
{
  double square = 0.;
  for (unsigned int i = 0; i < n; ++i)
    square += x[i] * x[i];
  return std::sqrt(square);
}

/// The iterate of Lawson and Hanson with its positive columns.
class NonNegativeLeastSquares
{
public:
  NonNegativeLeastSquares(const MultiVector &the_A, const MultiVector &the_b)
    : A(the_A)
    , b(the_b)
    , lengths(the_A.n_columns())
    , x(the_A.n_columns())
    , residual(the_b)
    , refused(the_A.n_columns(), false)
  {
    for (unsigned int j = 0; j < A.n_columns(); ++j)
      lengths[j] = norm_of(A.column(j), A.n_rows());
  }

  NnlsResult solve();

private:
  bool add_column();
  void minimize_over_columns();

  const MultiVector        &A, &b;
  std::vector<double>       lengths;
  MultiVector               x, residual;
  std::vector<bool>         refused; // columns refused since the last decrease
  std::vector<unsigned int> positive;
};

/// Add the column at the smallest angle to the residual. Return false if no column would lower the
/// residual.
bool NonNegativeLeastSquares::add_column()
{
  const double      length = norm_of(residual.column(0), b.n_rows());
  double            best   = right_angle * length;
  unsigned int      chosen = A.n_columns();
  const MultiVector slopes = inner_products(A, residual, MPI_COMM_SELF);
  for (unsigned int j = 0; j < A.n_columns(); ++j)
    if (lengths[j] > 0. && !refused[j] && slopes(j) > best * lengths[j] &&
        std::find(positive.begin(), positive.end(), j) == positive.end())
      {
        best   = slopes(j) / lengths[j];
        chosen = j;
      }
  if (chosen == A.n_columns())
    return false;
  positive.push_back(chosen);
  return true;
}

/// Move to the least squares solution on the positive columns. Drop the column that first becomes
/// zero, until no column becomes zero.
void NonNegativeLeastSquares::minimize_over_columns()
{
  while (!positive.empty())
    {
      const auto  y        = least_squares(A, b, positive);
      double      step     = 1.;
      std::size_t blocking = y.size();
      for (std::size_t k = 0; k < y.size(); ++k)
        if (y[k] <= 0.)
          {
            // Fraction of the step to y at which x_k becomes zero.
            const double now  = x(positive[k]);
            const double here = now > 0. ? now / (now - y[k]) : 0.;
            if (blocking == y.size() || here < step)
              {
                step     = here;
                blocking = k;
              }
          }
      for (std::size_t k = 0; k < y.size(); ++k)
        {
          double &value = x(positive[k]);
          // Rounding may carry the blocking entry slightly below zero.
          value = std::max(0., value + step * (y[k] - value));
        }
      if (blocking == y.size())
        return;
      x(positive[blocking]) = 0.;
      positive.erase(positive.begin() + blocking);
    }
}

NnlsResult NonNegativeLeastSquares::solve()
{
  const double size     = norm_of(b.column(0), b.n_rows());
  double       smallest = size;
  while (smallest > 1e-14 * size && add_column())
    {
      const unsigned int newest = positive.back();
      minimize_over_columns();
      residual = b;
      residual.add_product(-1., A, x);
      const double length = norm_of(residual.column(0), b.n_rows());
      // In exact arithmetic each step lowers the residual. A column that fails to do so by rounding
      // is not tried again before another column has lowered the residual, because otherwise the
      // loop might not end.
      if (length < smallest)
        {
          smallest = length;
          std::fill(refused.begin(), refused.end(), false);
        }
      else
        refused[newest] = true;
    }
  return {x, residual};
}
} // namespace

NnlsResult nnls(const MultiVector &A, const MultiVector &b)
{
  SNUG_ASSERT_EQUAL(A.n_rows(), b.n_rows());
  SNUG_ASSERT_EQUAL(b.n_columns(), 1);
  const double sizes[2] = {norm_of(b.column(0), b.n_rows()),
                           norm_of(A.column(0), A.n_rows() * A.n_columns())};
  if (!std::isfinite(sizes[0]) || !std::isfinite(sizes[1]))
    throw SolveError("a load or a contact row of the equilibrium test "
                     "is not finite");
  return NonNegativeLeastSquares(A, b).solve();
}

MultiVector shortest(const MultiVector &A, const MultiVector &b)
{
  const unsigned int m = A.n_rows(), n = A.n_columns();
  double             length = 0.;
  for (unsigned int j = 0; j < n; ++j)
    length = std::max(length, std::abs(b(j)));
  MultiVector y(m);
  if (length == 0.)
    return y;
  // min_{x >= 0} ||(A; b') x - (0; 1)||, with b divided by its maximum entry. The residual (r, s)
  // gives y = -r / s.
  MultiVector E(m + 1, n), f(m + 1);
  for (unsigned int j = 0; j < n; ++j)
    {
      std::copy_n(A.column(j), m, E.column(j));
      E(m, j) = b(j) / length;
    }
  f(m)            = 1.;
  const auto rest = nnls(E, f).residual;
  for (unsigned int i = 0; i < m; ++i)
    y(i) = -length * rest(i) / rest(m);
  return y;
}
} // namespace snug::qp
