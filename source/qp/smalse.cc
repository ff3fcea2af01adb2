#include <snug/qp/mprgp.h>
#include <snug/qp/row_set.h>
#include <snug/qp/smalse.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <sstream>

namespace snug::qp {
namespace {
const double       penalty_factor    = 10.; ///< rho / ||P F P|| at first
const double       largest_penalty   = 1e5; ///< maximum of rho / ||P F P||, by rounding of rho Q x
const unsigned int check_interval    = 20;  ///< steps between two checks of ||G_b x||
const double       wanted_fall       = 0.1; ///< rho is raised unless it falls to this part
const double       balancing_factor  = 1.;  ///< M / ||P F P|| at first
const double       balancing_descent = 0.1; ///< factor of M if L grows too little
const double       first_accuracy    = 0.1; ///< of ||g^P|| relative to ||b||
const unsigned int power_steps       = 10;
const unsigned int max_outer         = 1000;

/**
 * Return 1.05 times the maximum Rayleigh quotient in power steps with P F P. The start is the sum
 * of the normalized @p v and a pattern of the row number, which is counted over all ranks.
 */
double operator_norm(const DualProblem &problem, const FreeSet &all, MultiVector v)
{
  const MPI_Comm      comm  = problem.context().communicator();
  const double        size  = norms(v, comm)[0];
  const unsigned long n     = v.n_rows();
  unsigned long       first = 0; // first row of this rank
  MPI_Scan(&n, &first, 1, MPI_UNSIGNED_LONG, MPI_SUM, comm);
  first -= n;
  for (unsigned int i = 0; i < n; ++i)
    {
      const auto row = static_cast<double>(first + i);
      v(i)           = (size > 0. ? v(i) / size : 0.) + 1e-2 * std::cos(1. + row * row);
    }
  double norm = 0.;
  for (unsigned int k = 0; k < power_steps; ++k)
    {
      all.project(v);
      const double length = norms(v, comm)[0];
      if (length == 0.)
        break;
      MultiVector unit(v.n_rows());
      unit.add(1. / length, v);
      v    = problem.apply(unit);
      norm = std::max(norm, inner_products(unit, v, comm)(0));
    }
  if (norm == 0.)
    for (const double entry : problem.diagonal())
      norm = std::max(norm, entry);
  MPI_Allreduce(MPI_IN_PLACE, &norm, 1, MPI_DOUBLE, MPI_MAX, comm);
  return 1.05 * norm;
}

class SmalseRun
{
public:
  SmalseRun(const DualProblem &the_problem, const SolverParameters &the_parameters)
    : problem(the_problem)
    , context(the_problem.context())
    , parameters(the_parameters)
    , f_mults_before(context.work.f_mults)
  {}

  DualSolution run(const WarmStart &start);

private:
  void begin(const WarmStart &start);
  bool certified();
  void end_step(Mprgp::Stop &stop);

  KktResidual
  kkt_of(const FreeSet &free_set, const MultiVector &lambda, const MultiVector &residual) const;

  KktResidual kkt_here() const
  {
    return kkt_of(inner->free_set(), inner->feasible_lambda(), inner->residual());
  }

  unsigned long f_mults() const { return context.work.f_mults - f_mults_before; }

  const DualProblem     &problem;
  RunContext            &context;
  const SolverParameters parameters;
  const unsigned long    f_mults_before;

  EqualityPart           equality;
  Mprgp::Sizes           sizes;
  std::unique_ptr<Mprgp> inner;
  DualSolution           solution;
  double                 last_value = 0., checked_infeasibility = 0.;
};

void SmalseRun::begin(const WarmStart &start)
{
  const MPI_Comm comm = context.communicator();
  MultiVector    none(problem.n_owned(), 0);
  // The projector of SMALSE-M is that of all rows, but residuals are scaled as by the other
  // solvers.
  const double scale = equality_part(problem, problem.initial_active_set(), none).scale;
  equality           = equality_part(problem, RowSet(problem.n_owned(), 1), none);
  equality.scale     = scale;
  MultiVector b      = equality.residual;
  sizes.norm         = operator_norm(problem, *equality.free_set, b);
  sizes.rho          = penalty_factor * sizes.norm;
  const bool  warm   = any(start.lambda.n_rows() > 0, comm);
  MultiVector lambda = warm && start.lambda.n_rows() > 0 ? start.lambda : equality.lambda;
  for (unsigned int i = 0; i < lambda.n_rows(); ++i)
    if (problem.bounded()[i])
      lambda(i) = std::max(lambda(i), 0.);
  inner = std::make_unique<Mprgp>(problem, equality, sizes, lambda);
  if (!warm)
    return;
  // At the solution -g = w, hence q = -Q r - G' alpha.
  MultiVector q = inner->residual();
  equality.free_set->project(q);
  q.add(-1., inner->residual());
  q.add(1., problem.apply_Gt(inner->free_set().amplitudes(inner->residual())));
  inner->set_multipliers(q);
}

/// Rigid amplitudes are best determined from the rows with a force. Where these rows leave a motion
/// free, as of a block loaded through one node, they do not determine all amplitudes. The
/// amplitudes from the multipliers then keep the other contacts from overlapping.
KktResidual SmalseRun::kkt_of(const FreeSet     &free_set,
                              const MultiVector &lambda,
                              const MultiVector &residual) const
{
  auto of_rows =
    kkt_residual(problem, free_set.amplitudes(residual), lambda, residual, equality.scale);
  if (of_rows.relative <= parameters.relative_tolerance)
    return of_rows;
  MultiVector rigid = inner->multipliers();
  rigid.add(1., residual);
  auto of_multipliers =
    kkt_residual(problem, equality.free_set->amplitudes(rigid), lambda, residual, equality.scale);
  return of_multipliers.relative < of_rows.relative ? of_multipliers : of_rows;
}

/**
 * Return whether the solution is found: the free rows of the iterate carry a feasible lambda >= 0
 * that meets the tolerance with a residual computed anew.
 */
bool SmalseRun::certified()
{
  const MPI_Comm           comm   = context.communicator();
  MultiVector              lambda = inner->feasible_lambda();
  RowSet                   rows   = inner->free_rows();
  std::unique_ptr<FreeSet> free_set;
  const auto               rounding =
    force_rounding(problem, lambda, kkt_here(), equality.scale, parameters.relative_tolerance);
  do
    {
      free_set = problem.free_set(rows);
      free_set->make_feasible(lambda, problem.e());
      clip_rounding(problem.bounded(), rounding, lambda);
      for (unsigned int i = 0; i < rows.size(); ++i)
        if (problem.bounded()[i] && lambda(i) < 0.)
          rows[i] = 0;
  } while (any(has_negative(problem.bounded(), lambda), comm));
  MultiVector residual = problem.d();
  residual.add(-1., problem.apply(lambda));
  const KktResidual kkt = kkt_of(*free_set, lambda, residual);
  solution.kkt_residual = kkt.relative;
  if (kkt.relative > parameters.relative_tolerance)
    return false;
  solution.lambda     = lambda;
  solution.residual   = residual;
  solution.amplitudes = kkt.amplitudes;
  solution.active     = loaded_rows(problem.bounded(), lambda);
  return true;
}

/// Adapt M, the multipliers and rho. Each step lowers ||G_b x|| by a factor of about 1 / (1 + rho
/// s), with s the minimum eigenvalue of G_b A^-1 G_b' on the free rows. Where few rows carry
/// slender bodies, s is so small that the first rho would need thousands of steps. The
/// preconditioned inner solves allow any rho.
void SmalseRun::end_step(Mprgp::Stop &stop)
{
  const double infeasibility = inner->infeasibility();
  const double value         = inner->value();
  if (solution.outer_iterations > 1 &&
      value < last_value + 0.5 * sizes.rho * infeasibility * infeasibility)
    stop.gradient_factor *= balancing_descent;
  inner->update_multipliers();
  last_value = value;
  if (solution.outer_iterations % check_interval > 0)
    return;
  if (solution.outer_iterations > check_interval &&
      infeasibility > wanted_fall * checked_infeasibility &&
      solution.kkt_residual > parameters.relative_tolerance &&
      sizes.rho < largest_penalty * sizes.norm)
    {
      sizes.rho *= 10.;
      inner->set_penalty(sizes.rho);
    }
  checked_infeasibility = infeasibility;
}

DualSolution SmalseRun::run(const WarmStart &start)
{
  begin(start);
  const double tolerance = parameters.relative_tolerance * equality.scale;
  Mprgp::Stop  stop;
  stop.gradient_factor = balancing_factor * sizes.norm;
  stop.gradient_cap    = first_accuracy * equality.scale;
  stop.gradient_floor  = 0.3 * tolerance;
  stop.f_mults         = f_mults_before + parameters.max_iterations;
  double wanted        = parameters.relative_tolerance;
  double tried         = 0.; // ||G_b x|| at the last failed certification
  while (f_mults() < parameters.max_iterations && solution.outer_iterations < max_outer)
    {
      inner->minimize(stop);
      ++solution.outer_iterations;
      solution.kkt_residual = kkt_here().relative;
      std::ostringstream line;
      line << "SMALSE-M, step " << solution.outer_iterations << ": KKT residual "
           << solution.kkt_residual << ", " << counted(f_mults(), "F-mult");
      context.progress(line.str());
      // Certification removes the violation of the bounds by P x, which increases the residual. The
      // violation falls with ||G_b x||, also where the KKT residual is at its rounding error.
      if (solution.kkt_residual <= wanted ||
          (solution.kkt_residual <= parameters.relative_tolerance &&
           inner->infeasibility() <= 0.1 * tried))
        {
          if (certified())
            {
              solution.f_mults = f_mults();
              solution.method  = "SMALSE-M";
              return solution;
            }
          tried = inner->infeasibility();
          wanted *= 0.3;
          stop.gradient_floor *= 0.3;
        }
      end_step(stop);
    }
  throw not_converged("SMALSE-M", kkt_here().relative, parameters.relative_tolerance, f_mults(),
                      f_mults() >= parameters.max_iterations);
}
} // namespace

Smalse::Smalse(const SolverParameters &the_parameters) : parameters(the_parameters) {}

DualSolution Smalse::solve(const DualProblem &problem, const WarmStart &start) const
{
  return SmalseRun(problem, parameters).run(start);
}
} // namespace snug::qp
