#include <snug/qp/independent_columns.h>
#include <snug/qp/projected_gcr.h>

#include <cmath>
#include <numeric>
#include <utility>

namespace snug::qp {
namespace {
/// Directions are linearly dependent if a pivot of the Gram matrix of their images, scaled to unit
/// diagonal, is below this value.
const double image_dependence = 1e-6;

/// The image of a direction is rounding error if orthogonalization leaves less than this part of
/// the square of its norm.
const double image_noise = 1e-20;

/// Recalled directions are dropped if an iteration leaves more than this part of the residuals.
/// With large contrasts of stiffness, the approximate images are poor. Measured with a contrast of
/// 1e4: 68 instead of 104 F-mults.
const double poor_reduction = 0.95;

double length_of(const std::vector<double> &x)
{
  return std::sqrt(std::inner_product(x.begin(), x.end(), x.begin(), 0.));
}
} // namespace

ProjectedGcr::ProjectedGcr(const DualProblem    &the_problem,
                           const FreeSet        &the_face,
                           const DirectionBasis &the_known,
                           const bool            the_deflates)
  : problem(the_problem)
  , free_set(the_face)
  , deflates(the_deflates)
  , comm(the_problem.context().communicator())
  , known(the_known)
  , directions(the_problem.n_owned(), 0)
  , images(the_problem.n_owned(), 0)
  , projected(the_problem.n_owned(), 0)
{
  if (known.P.n_columns() > 0)
    recall();
}

/// Restrict the known directions to the present face, with their images in the present equations.
/// The images are those of the directions before the restriction, and therefore approximations.
void ProjectedGcr::recall()
{
  const FreeRows &free = free_set.free_rows();
  recalled             = known.P;
  recalled_images      = known.FP;
  free.restrict(recalled);
  free.reduce(recalled_images);
  free.add_compliance(1., recalled, recalled_images);
  free_set.project(recalled_images);
  const MultiVector C =
    orthonormal_combinations(inner_products(recalled_images, recalled_images, comm),
                             std::vector<double>(recalled.n_columns(), 0.), image_dependence);
  recalled        = times(recalled, C);
  recalled_images = times(recalled_images, C);
}

/// Return approximate solutions for the residuals @p r: the recalled directions for the part that
/// their images explain, and the preconditioner for the rest.
MultiVector ProjectedGcr::preconditioned(const MultiVector &r) const
{
  if (recalled.n_columns() == 0)
    return free_set.precondition(r);
  const MultiVector a    = inner_products(recalled_images, r, comm);
  MultiVector       rest = r;
  rest.add_product(-1., recalled_images, a);
  MultiVector y = free_set.precondition(rest);
  y.add_product(1., recalled, a);
  return y;
}

DirectionBasis ProjectedGcr::release_directions()
{
  if (known.P.n_columns() == 0)
    known = {MultiVector(problem.n_owned(), 0), MultiVector(problem.n_owned(), 0)};
  known.is_conjugate = false;
  known.P.append(directions);
  known.FP.append(images);
  return std::move(known);
}

MultiVector ProjectedGcr::projected_residual(const MultiVector &lambda,
                                             const MultiVector &residual) const
{
  MultiVector r = free_set.free_rows().reduced_residual(lambda, residual);
  free_set.project(r);
  return r;
}

/// Minimize the projected residuals @p r over the directions from @p first on.
void ProjectedGcr::minimize(const unsigned int first,
                            const MultiVector &r,
                            MultiVector       &lambda,
                            MultiVector       &residual) const
{
  const unsigned int n = projected.n_columns() - first;
  if (n == 0)
    return;
  const MultiVector a = inner_products(projected.columns_from(first, n), r, comm);
  lambda.add_product(1., directions.columns_from(first, n), a);
  residual.add_product(-1., images.columns_from(first, n), a);
}

/// Add directions from the projected residuals @p r. Return false if they add nothing but rounding
/// errors.
bool ProjectedGcr::add_directions(const MultiVector &r)
{
  const FreeRows &free = free_set.free_rows();
  MultiVector     y    = preconditioned(r);
  free_set.project_multipliers(y);
  MultiVector z = y;
  free.expand(z);
  if (deflates)
    free_set.deflate(z);
  MultiVector Fz = problem.apply(z), q = Fz;
  free.reduce(q);
  // The directions C are zero on contact rows, so that z has the y of before there.
  free.add_compliance(1., y, q);
  free_set.project(q);
  std::vector<double> smallest;
  for (const double length : norms(q, comm))
    smallest.push_back(image_noise * length * length);
  // Orthogonalize twice, because once leaves rounding errors of the size of the removed part.
  for (unsigned int pass = 0; pass < 2 && projected.n_columns() > 0; ++pass)
    {
      const MultiVector a = inner_products(projected, q, comm);
      z.add_product(-1., directions, a);
      Fz.add_product(-1., images, a);
      q.add_product(-1., projected, a);
    }
  const MultiVector C =
    orthonormal_combinations(inner_products(q, q, comm), smallest, image_dependence);
  if (C.n_columns() == 0)
    return false;
  directions.append(times(z, C));
  images.append(times(Fz, C));
  projected.append(times(q, C));
  return true;
}

KrylovResult ProjectedGcr::solve(MultiVector               &lambda,
                                 MultiVector               &residual,
                                 const std::vector<double> &tolerances,
                                 const unsigned int         max_iterations)
{
  KrylovResult  result;
  KrylovColumns columns(comm);
  if (deflates)
    free_set.minimize_over_deflated(lambda, residual);
  minimize(0, projected_residual(lambda, residual), lambda, residual);
  double size = 0.;
  while (true)
    {
      const MultiVector r = projected_residual(lambda, residual);
      if (columns.ends(r, residual, tolerances, max_iterations, result))
        return result;
      const double before = std::exchange(size, length_of(result.residual_norms));
      if (result.iterations > 0 && size > poor_reduction * before)
        recalled = MultiVector(problem.n_owned(), 0);
      const unsigned int n_before = projected.n_columns();
      if (!add_directions(columns.leading_part(r)))
        return result;
      minimize(n_before, r, lambda, residual);
      ++result.iterations;
    }
}
} // namespace snug::qp
