#include <snug/base/assertions.h>
#include <snug/qp/independent_columns.h>
#include <snug/qp/kkt.h>
#include <snug/qp/krylov_columns.h>
#include <snug/qp/pcpg.h>


#include <algorithm>
#include <cmath>

namespace snug::qp {
namespace {
/// Directions are linearly dependent if a pivot of their Gram matrix, scaled to unit diagonal, is
/// below this value.
const double dependence_cut = 1e-3;

/// A direction is rounding error if orthogonalization leaves less than this part of the square of
/// its F-norm.
const double noise = 1e-12;

/// Number of iterations for whose directions memory is reserved.
const unsigned int usual_iterations = 32;
} // namespace

Pcpg::Pcpg(const DualProblem &the_problem,
           const FreeSet     &the_face,
           DirectionBasis     known,
           const bool         the_deflates)
  : problem(the_problem)
  , free_set(the_face)
  , deflates(the_deflates)
  , comm(the_problem.context().communicator())
  , basis(std::move(known))
{
  if (basis.P.n_columns() == 0)
    basis = {MultiVector(problem.n_owned(), 0), MultiVector(problem.n_owned(), 0)};
  // p'Fp = unit for all known directions, so their Rayleigh quotients are unit / |p|^2.
  for (const double length : norms(basis.P, comm))
    largest_rayleigh_quotient = std::max(largest_rayleigh_quotient, basis.unit / (length * length));
}

void Pcpg::correct(MultiVector &lambda, MultiVector &residual) const
{
  if (deflates)
    free_set.minimize_over_deflated(lambda, residual);
  if (basis.P.n_columns() == 0)
    return;
  // The minimum over the span has the coefficients P'r / unit, because P'FP = unit I.
  const MultiVector a = inner_products(basis.P, residual, comm);
  lambda.add_product(1. / basis.unit, basis.P, a);
  residual.add_product(-1. / basis.unit, basis.FP, a);
}

std::vector<double> Pcpg::orthogonalise(MultiVector &x) const
{
  auto removed = deflates ? free_set.deflate(x) : std::vector<double>(x.n_columns(), 0.);
  if (basis.P.n_columns() == 0)
    return removed;
  const MultiVector parts = inner_products(basis.FP, x, comm);
  x.add_product(-1. / basis.unit, basis.P, parts);
  for (unsigned int j = 0; j < parts.n_columns(); ++j)
    for (unsigned int i = 0; i < parts.n_rows(); ++i)
      removed[j] += parts(i, j) * parts(i, j) / basis.unit;
  return removed;
}

MultiVector Pcpg::new_directions(const MultiVector &r, std::vector<double> &removed) const
{
  MultiVector Z = free_set.precondition(r);
  free_set.project(Z);
  // Reorthogonalize against all earlier directions, not only the last. Contact problems have few
  // iterations, and F costs far more than these products. With the short recurrence of CG, rounding
  // would cost further F-mults.
  removed = orthogonalise(Z);
  if (Z.n_columns() == 1)
    return Z;
  // Compute a well conditioned basis first, because dependent directions then cost no F-mult. The
  // combinations amplify rounding errors. The directions are therefore projected and made
  // F-orthogonal once more, because otherwise residuals grow again near convergence.
  std::vector<double> smallest(Z.n_columns(), 0.);
  for (unsigned int j = 0; j < Z.n_columns(); ++j)
    if (removed[j] > 0.)
      smallest[j] = noise * removed[j] / largest_rayleigh_quotient;
  Z = times(Z, orthonormal_combinations(inner_products(Z, Z, comm), smallest, dependence_cut));
  free_set.project(Z);
  orthogonalise(Z);
  removed.assign(Z.n_columns(), 0.);
  return Z;
}

bool Pcpg::step(const MultiVector         &Z,
                const std::vector<double> &removed,
                MultiVector               &lambda,
                MultiVector               &residual)
{
  const unsigned int n = Z.n_columns(), k = residual.n_columns();
  const MultiVector  FZ = problem.apply(Z);
  // Compute Z'FZ, Z'Z and Z'r by one product and one reduction over the ranks.
  MultiVector right = FZ;
  right.append(Z);
  right.append(residual);
  const MultiVector   products = inner_products(Z, right, comm);
  std::vector<double> smallest(n);
  for (unsigned int j = 0; j < n; ++j)
    {
      const double ZZ = products(j, n + j);
      if (ZZ > 0.)
        largest_rayleigh_quotient = std::max(largest_rayleigh_quotient, products(j, j) / ZZ);
      smallest[j] =
        std::max(std::numeric_limits<double>::epsilon() * largest_rayleigh_quotient * ZZ,
                 noise * removed[j]);
    }
  // Choose a power of two near ||F|| once for the lifetime of the basis. Divisions by it are exact.
  if (basis.P.n_columns() == 0 && largest_rayleigh_quotient > 0.)
    basis.unit = std::ldexp(1., std::ilogb(largest_rayleigh_quotient));
  MultiVector ZFZ(n, n);
  ZFZ.add(1. / basis.unit, products.columns_from(0, n));
  for (double &least : smallest)
    least /= basis.unit;
  const MultiVector C = orthonormal_combinations(ZFZ, smallest, dependence_cut);
  // If F vanishes on all of Z up to rounding, these directions lower nothing.
  if (C.n_columns() == 0)
    return false;
  // The products are already sums over ranks.
  const MultiVector a     = inner_products(C, products.columns_from(2 * n, k), MPI_COMM_SELF);
  const MultiVector new_P = times(Z, C), new_FP = times(FZ, C);
  lambda.add_product(1. / basis.unit, new_P, a);
  residual.add_product(-1. / basis.unit, new_FP, a);
  basis.P.append(new_P);
  basis.FP.append(new_FP);
  return true;
}

KrylovResult Pcpg::solve(MultiVector               &lambda,
                         MultiVector               &residual,
                         const std::vector<double> &tolerances,
                         unsigned int               max_iterations)
{
  const unsigned int k = lambda.n_columns();
  SNUG_ASSERT_EQUAL(residual.n_columns(), k);
  SNUG_ASSERT_EQUAL(tolerances.size(), k);
  KrylovResult  result;
  KrylovColumns test(comm);
  correct(lambda, residual);
  for (MultiVector *directions : {&basis.P, &basis.FP})
    if (directions->n_columns() == 0 || k > 1)
      // Reserve memory, because appending a column may copy all columns. A basis in use has its
      // memory.
      directions->reserve(directions->n_columns() + usual_iterations * k);
  while (true)
    {
      MultiVector r = residual;
      free_set.project(r);
      if (test.ends(r, residual, tolerances, max_iterations, result))
        return result;
      std::vector<double> removed;
      const MultiVector   Z = new_directions(test.leading_part(r), removed);
      if (Z.n_columns() == 0 || !step(Z, removed, lambda, residual))
        return result;
      ++result.iterations;
    }
}

KrylovResult pcpg(const DualProblem         &problem,
                  const FreeSet             &free_set,
                  MultiVector               &lambda,
                  MultiVector               &residual,
                  const std::vector<double> &tolerances,
                  unsigned int               max_iterations)
{
  return Pcpg(problem, free_set).solve(lambda, residual, tolerances, max_iterations);
}
} // namespace snug::qp
