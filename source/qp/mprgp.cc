#include <snug/qp/mprgp.h>
#include <snug/qp/row_set.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace snug::qp {
namespace {
/// Length of steps along the projected gradient, in units of 1 / ||A||. It must be below 2.
const double gradient_step = 1.9;

/// Return the step length. The norm of A = P F P + rho Q is the maximum of the norms of both terms,
/// because their ranges are orthogonal.
double step_length(const Mprgp::Sizes &sizes)
{
  return gradient_step / std::max(sizes.norm, sizes.rho);
}
} // namespace

Mprgp::Mprgp(const DualProblem  &the_problem,
             const EqualityPart &the_equality,
             const Sizes        &the_sizes,
             const MultiVector  &the_lambda)
  : problem(the_problem)
  , equality(the_equality)
  , sizes(the_sizes)
  , comm(the_problem.context().communicator())
  , lambda(the_lambda)
  , r(the_equality.residual)
  , Qx(the_problem.n_owned())
  , q(the_problem.n_owned())
  , g(the_problem.n_owned())
{
  bool other = false;
  for (unsigned int i = 0; i < problem.n_owned(); ++i)
    other = other || lambda(i) != equality.lambda(i);
  if (any(other, comm))
    recompute();
  else
    {
      MultiVector Pr = r;
      equality.free_set->project(Pr);
      g.add(-1., Pr);
    }
  renew_face();
}

/// Compute residual and gradient anew, with one F-mult. As lambda = lambda_Im + x and P lambda_Im =
/// 0, P lambda = P x and Q x = lambda - P lambda - lambda_Im. With r = d - F (lambda_Im + P x) the
/// gradient is g = A x - b + q = q + rho Q x - P r.
void Mprgp::recompute()
{
  MultiVector Px = lambda;
  equality.free_set->project(Px);
  Qx = lambda;
  Qx.add(-1., Px);
  Qx.add(-1., equality.lambda);
  r = equality.residual;
  r.add(-1., problem.apply(Px));
  MultiVector Pr = r;
  equality.free_set->project(Pr);
  g = q;
  g.add(sizes.rho, Qx);
  g.add(-1., Pr);
}

/// Set the face of the rows that are free at lambda. Its preconditioner is costly, so it is made
/// again only if the set has changed. Conjugate directions are reset with every change of the
/// problem.
void Mprgp::renew_face()
{
  const RowSet rows = loaded_rows(problem.bounded(), lambda);
  if (any(rows != free || !free_face, comm))
    {
      free      = rows;
      free_face = problem.free_set(free);
    }
  direction = MultiVector(problem.n_owned(), 0);
}

/// A does not change, and b changes by -rho Q x, so the gradient is updated without an F-mult.
void Mprgp::update_multipliers()
{
  q.add(sizes.rho, Qx);
  g.add(sizes.rho, Qx);
  direction = MultiVector(problem.n_owned(), 0);
}

void Mprgp::set_penalty(const double rho)
{
  g.add(rho - sizes.rho, Qx);
  sizes.rho = rho;
  direction = MultiVector(problem.n_owned(), 0);
}

void Mprgp::set_multipliers(const MultiVector &multipliers)
{
  g.add(1., multipliers);
  g.add(-1., q);
  q = multipliers;
}

MultiVector Mprgp::multipliers() const
{
  MultiVector sum = q;
  sum.add(sizes.rho, Qx);
  return sum;
}

double Mprgp::value() const
{
  // x'(Ax - 2 (b - q)) / 2 with A x = g + b - q and b = P residual_Im
  MultiVector x = lambda;
  x.add(-1., equality.lambda);
  MultiVector b = equality.residual;
  equality.free_set->project(b);
  MultiVector sum = g;
  sum.add(1., q);
  sum.add(-1., b);
  return 0.5 * dot(x, sum);
}

MultiVector Mprgp::feasible_lambda() const
{
  MultiVector result = lambda;
  result.add(-1., Qx);
  return result;
}

/// Return the free gradient phi, the chopped gradient beta, and phi_reduced = phi . min(lambda/a,
/// phi) with the reduced free gradient of Dostál and Schöberl. A small lambda_i has little weight,
/// because a step of length a along phi would end at its bound at once.
Mprgp::Gradient Mprgp::projected_gradient() const
{
  const unsigned int n = problem.n_owned();
  const double       a = step_length(sizes);
  Gradient           gradient{MultiVector(n), MultiVector(n)};
  double             sums[3] = {0., 0., 0.};
  for (unsigned int i = 0; i < n; ++i)
    if (free[i])
      {
        const double phi = g(i);
        gradient.phi(i)  = phi;
        sums[0] += phi * (problem.bounded()[i] ? std::min(lambda(i) / a, phi) : phi);
        sums[1] += phi * phi;
      }
    else
      {
        gradient.beta(i) = std::min(g(i), 0.);
        sums[2] += gradient.beta(i) * gradient.beta(i);
      }
  MPI_Allreduce(MPI_IN_PLACE, sums, 3, MPI_DOUBLE, MPI_SUM, comm);
  gradient.phi_reduced = sums[0];
  gradient.beta_beta   = sums[2];
  gradient.norm        = std::sqrt(sums[1] + sums[2]);
  return gradient;
}

Mprgp::Image Mprgp::apply(const MultiVector &p) const
{
  MultiVector Pp = p;
  equality.free_set->project(Pp);
  Image image;
  image.Qp = p;
  image.Qp.add(-1., Pp);
  image.FPp = problem.apply(Pp);
  image.Ap  = image.FPp;
  equality.free_set->project(image.Ap);
  image.Ap.add(sizes.rho, image.Qp);
  MultiVector both = image.Ap;
  both.append(g);
  // Compute p'Ap and p'g in one reduction.
  const MultiVector products = inner_products(p, both, comm);
  image.p_Ap                 = products(0, 0);
  image.p_g                  = products(0, 1);
  return image;
}

/// Return mask_F (P M_F^{-1} P + Q / rho) phi.
MultiVector Mprgp::precondition(const MultiVector &phi) const
{
  MultiVector Pphi = phi;
  equality.free_set->project(Pphi);
  MultiVector z = free_face->precondition(Pphi);
  equality.free_set->project(z);
  // On the range of Q, A is rho Q and its inverse is Q / rho. P M_F^-1 P phi has no part in this
  // range, so without the term Q / rho directions could not reduce G_b x.
  z.add(1. / sizes.rho, phi);
  z.add(-1. / sizes.rho, Pphi);
  for (unsigned int i = 0; i < z.n_rows(); ++i)
    if (!free[i])
      z(i) = 0.;
  return z;
}

/// Return the maximum a for which lambda - a p is feasible.
double Mprgp::largest_feasible_step(const MultiVector &p) const
{
  double a = std::numeric_limits<double>::max();
  for (unsigned int i = 0; i < p.n_rows(); ++i)
    if (problem.bounded()[i] && p(i) > 0.)
      a = std::min(a, lambda(i) / p(i));
  MPI_Allreduce(MPI_IN_PLACE, &a, 1, MPI_DOUBLE, MPI_MIN, comm);
  return a;
}

/// Set x <- x - a p and update all dependent vectors.
void Mprgp::step(double a, const MultiVector &p, const Image &image)
{
  // No step given to this function violates the bounds. Clipping removes only the rounding error of
  // steps that end at a bound, so g, r and Qx need no update.
  lambda.add(-a, p);
  for (unsigned int i = 0; i < lambda.n_rows(); ++i)
    if (problem.bounded()[i])
      lambda(i) = std::max(lambda(i), 0.);
  g.add(-a, image.Ap);
  r.add(a, image.FPp);
  Qx.add(-a, image.Qp);
}

/// Set lambda <- max(lambda - a p, 0). If this does not lower the function, take a half feasible
/// step and a step along the gradient instead.
void Mprgp::expand(double a, double a_feasible)
{
  const MultiVector old = lambda, old_g = g;
  const auto        project_step = [&](double length, const MultiVector &p) {
    lambda = old;
    lambda.add(-length, p);
    for (unsigned int i = 0; i < lambda.n_rows(); ++i)
      if (problem.bounded()[i])
        lambda(i) = std::max(lambda(i), 0.);
  };
  project_step(a, direction);
  recompute();
  MultiVector move = lambda, sum = g;
  // For a quadratic function f(new) - f(old) = (new - old)'(g_new + g_old) / 2, so no function
  // values are needed.
  move.add(-1., old);
  sum.add(1., old_g);
  if (dot(move, sum) > 0.)
    {
      // This is the expansion of the original MPRGP: a feasible half step, then a step of fixed
      // length below 2/||A|| along the projected gradient. It always decreases the function, as the
      // proof of convergence requires.
      project_step(0.5 * a_feasible, direction);
      recompute();
      const Gradient gradient = projected_gradient();
      lambda.add(-step_length(sizes), gradient.phi);
      for (unsigned int i = 0; i < lambda.n_rows(); ++i)
        if (problem.bounded()[i])
          lambda(i) = std::max(lambda(i), 0.);
      recompute();
    }
  renew_face();
}

/// Take one conjugate gradient step. Return false if no decrease is left.
bool Mprgp::conjugate_step(const Gradient &gradient)
{
  if (direction.n_columns() == 0)
    direction = precondition(gradient.phi);
  const Image image = apply(direction);
  // A is positive definite, so p'Ap <= 0 occurs only at the rounding floor, and NaN with invalid
  // data.
  if (!(image.p_Ap > 0.))
    return false;
  const double a          = image.p_g / image.p_Ap;
  const double a_feasible = largest_feasible_step(direction);
  if (a > a_feasible)
    {
      expand(a, a_feasible);
      return true;
    }
  step(a, direction, image);
  MultiVector phi = g;
  for (unsigned int i = 0; i < phi.n_rows(); ++i)
    if (!free[i])
      phi(i) = 0.;
  MultiVector z = precondition(phi);
  // This makes z A-orthogonal to the last direction by construction, for any rounding in z.
  z.add(-dot(z, image.Ap) / image.p_Ap, direction);
  const bool reached_bound = any(loaded_rows(problem.bounded(), lambda) != free, comm);
  if (reached_bound)
    renew_face();
  else
    direction = z;
  return true;
}

void Mprgp::proportion(const Gradient &gradient)
{
  const Image image = apply(gradient.beta);
  step(image.p_Ap > 0. ? image.p_g / image.p_Ap : step_length(sizes), gradient.beta, image);
  renew_face();
}

void Mprgp::minimize(const Stop &stop)
{
  while (problem.context().work.f_mults < stop.f_mults)
    {
      const Gradient gradient = projected_gradient();
      // SMALSE-M is inexact: it solves the inner problem only as accurately as G_b x = 0 is
      // satisfied.
      const double wanted =
        std::max(std::min(stop.gradient_factor * infeasibility(), stop.gradient_cap),
                 stop.gradient_floor);
      if (!(gradient.norm > wanted))
        return;
      // The iterate is not proportional (with Gamma = 1): freeing active rows gains more than
      // minimizing in the face.
      if (gradient.beta_beta > gradient.phi_reduced)
        proportion(gradient);
      else if (!conjugate_step(gradient))
        return;
    }
}
} // namespace snug::qp
