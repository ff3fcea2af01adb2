#include <snug/base/errors.h>
#include <snug/base/narrow.h>
#include <snug/qp/nnls.h>

#include <deal.II/base/exceptions.h>

#include <petscsys.h>

#include <petscblaslapack.h>

#include <algorithm>
#include <cmath>

namespace snug::qp {
namespace {
const double right_angle = 1e-12; ///< cosine, in NNLS

/// Solve min || A(:, columns) y - b || with the smallest y.
std::vector<double>
least_squares(const MultiVector &A, const MultiVector &b, const std::vector<unsigned int> &columns)
{
  PetscBLASInt m = A.n_rows(), n = narrow<PetscBLASInt>(columns.size()), one = 1, rank, info;
  PetscBLASInt ldb = std::max(m, n), size = -1;
  MultiVector  part(A.n_rows(), 0);
  for (const unsigned int j : columns)
    part.append(A.columns_from(j, 1));
  std::vector<double> y(ldb), singular(std::min(m, n)), work(1);
  std::copy(b.column(0), b.column(0) + m, y.begin());
  double cut = 1e-13;
  for (unsigned int pass = 0; pass < 2; ++pass)
    {
      // The first pass asks for the size of the workspace. Contact columns are often
      // dependent, as the nodes of a flat face push alike: hence singular values, with a cut.
      LAPACKgelss_(&m, &n, &one, part.column(0), &m, y.data(), &ldb, singular.data(), &cut, &rank,
                   work.data(), &size, &info);
      size = static_cast<PetscBLASInt>(work[0]);
      work.resize(std::max<PetscBLASInt>(size, 1));
    }
  if (info != 0)
    throw SolveError("the equilibrium test failed: its least squares "
                     "problem has no singular value decomposition");
  y.resize(n);
  return y;
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
  std::vector<bool>         refused; // since the last decrease
  std::vector<unsigned int> positive;
};

/// The column at the smallest angle to the residual; false if none
/// would lower the residual.
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

/// Go towards the least squares solution on the positive columns,
/// dropping the one that first becomes zero until none does.
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
            // The part of the way to y at which x_k becomes zero.
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
      // In exact arithmetic each step lowers the residual. A column that does not, for rounding, is
      // not tried again before another has: without that the loop could go round for ever.
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
  AssertDimension(A.n_rows(), b.n_rows());
  AssertDimension(b.n_columns(), 1);
  const double sizes[2] = {norm_of(b.column(0), b.n_rows()),
                           norm_of(A.column(0), A.n_rows() * A.n_columns())};
  if (!std::isfinite(sizes[0]) || !std::isfinite(sizes[1]))
    throw SolveError("the equilibrium test met a load or contact row that "
                     "is not finite");
  return NonNegativeLeastSquares(A, b).solve();
}
} // namespace snug::qp
