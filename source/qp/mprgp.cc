#include <snug/qp/mprgp.h>
#include <snug/qp/row_set.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace snug::qp {
namespace {
/// Longest step of the projected gradient, in 1 / ||A||; below 2.
const double gradient_step = 1.9;

/// The norm of A = P F P + rho Q is the larger of those of its parts, whose ranges are orthogonal.
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

/// Residual and gradient from scratch: one F-mult.
/// As lambda = lambda_Im + x and P lambda_Im = 0, P lambda = P x and Q x = lambda - P lambda -
/// lambda_Im. With r = d - F (lambda_Im + P x) the gradient is g = A x - b + q = q + rho Q x - P r.
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

/// The face of the rows that are free at lambda. Its preconditioner is costly, so it is only made
/// again when the set has changed; conjugate directions do not outlive any change of the problem.
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

/// A stays and b changes by -rho Q x, so the gradient follows without an F-mult.
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

/// Free gradient phi, chopped gradient beta, and phi_reduced = phi . min(lambda/a, phi) with the
/// reduced free gradient of Dostál and Schöberl: a small lambda_i counts little, as a step of
/// length a along phi would end at its bound at once.
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
  // p'Ap and p'g in one reduction.
  const MultiVector products = inner_products(p, both, comm);
  image.p_Ap                 = products(0, 0);
  image.p_g                  = products(0, 1);
  return image;
}

/// mask_F (P M_F^{-1} P + Q / rho) phi
MultiVector Mprgp::precondition(const MultiVector &phi) const
{
  MultiVector Pphi = phi;
  equality.free_set->project(Pphi);
  MultiVector z = free_face->precondition(Pphi);
  equality.free_set->project(z);
  // On the range of Q, A is rho Q and its inverse Q / rho. P M_F^-1 P phi has no part there, so
  // that without this term directions could not reduce G_b x.
  z.add(1. / sizes.rho, phi);
  z.add(-1. / sizes.rho, Pphi);
  for (unsigned int i = 0; i < z.n_rows(); ++i)
    if (!free[i])
      z(i) = 0.;
  return z;
}

/// The largest a for which lambda - a p stays feasible.
double Mprgp::largest_feasible_step(const MultiVector &p) const
{
  double a = std::numeric_limits<double>::max();
  for (unsigned int i = 0; i < p.n_rows(); ++i)
    if (problem.bounded()[i] && p(i) > 0.)
      a = std::min(a, lambda(i) / p(i));
  MPI_Allreduce(MPI_IN_PLACE, &a, 1, MPI_DOUBLE, MPI_MIN, comm);
  return a;
}

/// x <- x - a p with all that follows it.
void Mprgp::step(double a, const MultiVector &p, const Image &image)
{
  // No step passed here leads out of the bounds: what is clipped below is the rounding of one that
  // ends at a bound, and g, r and Qx need not follow.
  lambda.add(-a, p);
  for (unsigned int i = 0; i < lambda.n_rows(); ++i)
    if (problem.bounded()[i])
      lambda(i) = std::max(lambda(i), 0.);
  g.add(-a, image.Ap);
  r.add(a, image.FPp);
  Qx.add(-a, image.Qp);
}

/// lambda <- max(lambda - a p, 0); back to a half feasible step and one
/// along the gradient if that does not lower the function.
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
  // Of a quadratic function f(new) - f(old) = (new - old)'(g_new + g_old) / 2, without its values.
  move.add(-1., old);
  sum.add(1., old_g);
  if (dot(move, sum) > 0.)
    {
      // The expansion of the original MPRGP: a feasible half step and one of fixed length below
      // 2/||A|| along the projected gradient. It cannot fail to decrease, which the proof of
      // convergence needs.
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

/// One conjugate gradient step; false if no decrease is left to find.
bool Mprgp::conjugate_step(const Gradient &gradient)
{
  if (direction.n_columns() == 0)
    direction = precondition(gradient.phi);
  const Image image = apply(direction);
  // A is positive definite: only at the rounding floor, or with NaN, can this be.
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
  // A-orthogonal to the last direction by construction, whatever rounding did to z.
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
      // Inexactness of SMALSE-M: the inner problem is solved only as well as G_b x = 0 is met.
      const double wanted =
        std::max(std::min(stop.gradient_factor * infeasibility(), stop.gradient_cap),
                 stop.gradient_floor);
      if (!(gradient.norm > wanted))
        return;
      // Not proportional (with Gamma = 1): freeing active rows gains more than the face does.
      if (gradient.beta_beta > gradient.phi_reduced)
        proportion(gradient);
      else if (!conjugate_step(gradient))
        return;
    }
}
} // namespace snug::qp
