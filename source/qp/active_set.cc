#include <snug/base/narrow.h>
#include <snug/qp/active_set.h>
#include <snug/qp/kkt.h>
#include <snug/qp/pcpg.h>
#include <snug/qp/row_set.h>
#include <snug/qp/set_history.h>
#include <snug/qp/smalse.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <limits>
#include <ostream>
#include <sstream>

namespace snug::qp {
namespace {
/// Steps in a row that may fail to halve the KKT residual of one set, or
/// to solve on it.
const unsigned int allowed_stalls = 3;

/// One solve: the iterate, the set and what belongs to it.
class ActiveSetRun
{
public:
  ActiveSetRun(const DualProblem      &the_problem,
               const SolverParameters &the_parameters,
               const ActiveSetOptions &the_options)
    : problem(the_problem)
    , context(the_problem.context())
    , parameters(the_parameters)
    , options(the_options)
    , history(the_options)
    , f_mults_before(context.work.f_mults)
    , inner_tolerance(the_options.forcing)
  {}

  /// False if the set does not settle: go on with another solver from
  /// start().
  bool run(const WarmStart &from);

  /// Why it does not.
  std::string reason() const;

  WarmStart start() const { return {lambda, mask}; }

  unsigned long f_mults() const { return context.work.f_mults - f_mults_before; }

  DualSolution solution() const;

private:
  /// Spends on a cycle what another solver may need.
  bool is_long_cycle() const
  {
    return care != SetHistory::none && f_mults() > parameters.max_iterations / 4;
  }

  KktResidual kkt_here() const
  {
    return kkt_residual(problem, free_set->amplitudes(residual), lambda, residual, scale);
  }

  double kkt_of(const EqualityPart &equality) const
  {
    return kkt_residual(problem, equality.free_set->amplitudes(equality.residual), equality.lambda,
                        equality.residual, scale)
      .relative;
  }

  /// The tolerance, or what rounding allows.
  bool is_met() const
  {
    return kkt.relative <= parameters.relative_tolerance ||
           (at_rounding && kkt.relative - kkt.feasibility <=
                             residual_rounding / projection_rounding * kkt.rounding / scale);
  }

  void   begin(const WarmStart &from);
  void   refresh_residual();
  void   solve_on_set();
  bool   finished();
  RowSet next_set() const;
  bool   change_set(const RowSet &next);
  void   keep_set();

  const DualProblem     &problem;
  RunContext            &context;
  const SolverParameters parameters;
  const ActiveSetOptions options;
  SetHistory             history;
  SetHistory::Care       care = SetHistory::none;
  const unsigned long    f_mults_before;

  MultiVector              lambda, residual;
  RowSet                   mask;
  std::unique_ptr<FreeSet> free_set;
  std::unique_ptr<Pcpg>    krylov; // of the face
  KktResidual              kkt;
  std::vector<double>      negligible; // forces, see force_rounding()
  double                   scale = 0.;
  double                   inner_tolerance;
  double                   last_kkt    = 0.; // on the same set
  unsigned int             recurrences = 0;  // since d - F lambda
  unsigned int             outer       = 0;
  bool                     solved      = true; // on the set
  bool                     at_rounding = false;
  unsigned int             stalls      = 0;
};

/// Start of the iteration. Whether the start is warm and has a set is asked on all ranks, as a rank
/// without rows has empty vectors in any case.
void ActiveSetRun::begin(const WarmStart &from)
{
  const MPI_Comm comm    = context.communicator();
  const bool     warm    = any(from.lambda.n_rows() > 0, comm);
  const bool     has_set = any(!from.active.empty(), comm);
  const bool     is_warm = warm || has_set;
  mask                   = RowSet(problem.n_owned(), 1);
  lambda                 = warm ? from.lambda : MultiVector(problem.n_owned());
  AssertDimension(lambda.n_rows(), problem.n_owned());
  Assert(!has_set || from.active.size() == problem.n_owned(),
         dealii::ExcDimensionMismatch(from.active.size(), problem.n_owned()));
  for (unsigned int i = 0; i < problem.n_owned(); ++i)
    if (problem.bounded()[i] && is_warm)
      {
        mask[i] = has_set ? from.active[i] != 0 : lambda(i) > 0.;
        if (!mask[i])
          lambda(i) = 0.;
      }
  if (is_warm)
    free_set = balanced_set(problem, mask, lambda, scale);
  // equality_part() replaces the columns of its argument by d - F of them, in the application of F
  // that it makes for lambda_Im anyway.
  residual              = is_warm ? lambda : MultiVector(problem.n_owned(), 0);
  EqualityPart equality = equality_part(problem, problem.expected_rows(), residual);
  scale                 = equality.scale;
  // Forces of states far from this one tell less of it than the expected contacts do.
  if (!is_warm || (!has_set && kkt_of(equality) < kkt_here().relative))
    {
      mask     = equality.rows;
      lambda   = equality.lambda;
      residual = equality.residual;
      free_set = std::move(equality.free_set);
    }
  krylov = std::make_unique<Pcpg>(problem, *free_set, from.directions.off(complement(mask), comm));
  history.enter(fingerprint(mask, comm), std::numeric_limits<double>::max(), false);
}

void ActiveSetRun::refresh_residual()
{
  residual = problem.d();
  residual.add(-1., problem.apply(lambda));
  recurrences = 0;
}

void ActiveSetRun::solve_on_set()
{
  // The limit counts F-mults, the unit of work that all solvers share, not steps.
  if (f_mults() >= parameters.max_iterations)
    throw not_converged("active set", kkt_here().relative, parameters.relative_tolerance, f_mults(),
                        true);
  // Below half of the wanted KKT residual an inner solve would only polish a set that may still
  // change. After a cycle was met the signs of small entries decide, so it may go further down.
  const double least = (care == SetHistory::none ? 0.5 : 0.005) * parameters.relative_tolerance;
  const auto   inner = krylov->solve(lambda, residual, {std::max(inner_tolerance, least) * scale},
                                     narrow<unsigned int>(parameters.max_iterations - f_mults()));
  recurrences += inner.iterations;
  solved      = inner.converged;
  at_rounding = inner.at_rounding;
  // w of the rows off the set, which decides who enters, needs the rigid amplitudes of this set.
  kkt        = kkt_here();
  negligible = force_rounding(problem, lambda, kkt, scale, parameters.relative_tolerance);
  ++outer;
  std::ostringstream line;
  line << "active set, step " << outer << ": KKT residual " << kkt.relative << ", " << f_mults()
       << " F-mults";
  context.progress(line.str());
}

/// The tolerance is met by a lambda without pull, and not only by the
/// recurrence of the residual.
bool ActiveSetRun::finished()
{
  if (!is_met())
    return false;
  const MPI_Comm comm = context.communicator();
  clip_rounding(problem.bounded(), negligible, lambda);
  if (any(has_negative(problem.bounded(), lambda), comm))
    return false;
  MultiVector parts = problem.d();
  parts.add(-1., residual);
  parts.append(problem.d());
  const auto sizes = norms(parts, comm); // of F lambda and of d
  // PCPG updates d - F lambda by recurrence. Each step adds about eps (|F lambda| + |d|) of
  // rounding, so that the true residual is only known up to the sum of them: where this could hide
  // a tenth of the tolerance, one F-mult makes certain.
  const double drift = std::numeric_limits<double>::epsilon() * recurrences * (sizes[0] + sizes[1]);
  if (drift < 0.1 * parameters.relative_tolerance * scale)
    return true;
  refresh_residual();
  kkt = kkt_here();
  return is_met();
}

RowSet ActiveSetRun::next_set() const
{
  RowSet next(mask.size(), 1);
  // With the tolerance met only rows that pull are wrong. Letting others in by the sign of a w that
  // is within the tolerance would start the search again from noise.
  const bool only_drop = is_met();
  for (unsigned int i = 0; i < next.size(); ++i)
    if (problem.bounded()[i])
      // The sign of lambda on the set, of w off it; why not lambda + c w is said at ActiveSet. A
      // row with neither force nor gap stays where it is: its signs are rounding, and would drop it
      // and let it in by turns.
      next[i] = mask[i] ? lambda(i) >= -negligible[i] : !only_drop && kkt.w(i) > kkt.rounding;
  if (care == SetHistory::single && !only_drop)
    return with_one_change(mask, next, context.communicator());
  return next;
}

/// The set stays: go on with the same directions, more exactly.
void ActiveSetRun::keep_set()
{
  // The set may be the right one: by at least a digit more, or each solve on it would do little.
  inner_tolerance = std::min(0.1 * inner_tolerance, options.forcing * kkt.relative);
  // A solve on the same set ought to do better than halve the residual. Rounding in recurrence and
  // directions is what can stop it: begin a new Krylov space, from a residual computed anew.
  if (last_kkt > 0. && kkt.relative > 0.5 * last_kkt)
    {
      if (++stalls > allowed_stalls)
        throw not_converged("active set", kkt.relative, parameters.relative_tolerance, f_mults(),
                            false);
      krylov.reset();
      free_set = balanced_set(problem, mask, lambda, scale);
      refresh_residual();
      const bool deflates = false; // it has its own rounding
      krylov              = std::make_unique<Pcpg>(problem, *free_set, DirectionBasis(), deflates);
    }
  last_kkt = kkt.relative;
}

/// False if the set does not settle.
bool ActiveSetRun::change_set(const RowSet &next)
{
  const MPI_Comm comm    = context.communicator();
  bool           changed = false;
  for (unsigned int i = 0; i < next.size(); ++i)
    // Rows that leave lose their force. That unbalances G lambda = e, so that lambda has to be made
    // feasible on the new set, and its residual has to be computed anew.
    if (!next[i] && lambda(i) != 0.)
      {
        lambda(i) = 0.;
        changed   = true;
      }
  inner_tolerance = std::min(inner_tolerance, options.forcing * kkt.relative);
  RowSet leaving  = mask;
  bool   enters   = false;
  for (unsigned int i = 0; i < next.size(); ++i)
    {
      leaving[i] = mask[i] && !next[i];
      enters     = enters || (next[i] && !mask[i]);
    }
  // Directions that vanish on the rows that leave lie in the new face as well, with F P known.
  // Rows that enter do not matter: balance_load() only adds rows, so they stay in the face. Of a
  // solve that failed they are spoilt by rounding, and so is lambda.
  DirectionBasis known = solved ? krylov->directions().off(leaving, comm) : DirectionBasis();
  // krylov refers to the face, which is replaced below, and has to go first.
  mask = next;
  krylov.reset();
  if (!solved || any(changed, comm))
    {
      free_set = balanced_set(problem, mask, lambda, scale);
      refresh_residual();
    }
  else
    free_set = problem.free_set(mask);
  krylov   = std::make_unique<Pcpg>(problem, *free_set, std::move(known));
  last_kkt = 0.;
  stalls   = solved ? 0 : stalls + 1;
  care     = history.enter(fingerprint(mask, comm), kkt.relative, !any(enters, comm));
  if (care != SetHistory::none)
    inner_tolerance *= 0.01;
  return care != SetHistory::give_up && stalls <= allowed_stalls && !is_long_cycle();
}

std::string ActiveSetRun::reason() const
{
  if (care == SetHistory::give_up)
    return history.reason();
  return is_long_cycle() ? "cycles" : "does not solve on its sets";
}

bool ActiveSetRun::run(const WarmStart &from)
{
  begin(from);
  while (true)
    {
      solve_on_set();
      if (finished())
        return true;
      const RowSet next = next_set();
      if (!any(next != mask, context.communicator()))
        keep_set();
      else if (!change_set(next))
        return false;
    }
}

/// The directions go along: sensitivities solve with the same F on (part of) the same face.
DualSolution ActiveSetRun::solution() const
{
  DualSolution result;
  result.lambda           = lambda;
  result.directions       = krylov->directions();
  result.residual         = residual;
  result.amplitudes       = kkt.amplitudes;
  result.active           = loaded_rows(problem.bounded(), lambda);
  result.kkt_residual     = kkt.relative;
  result.outer_iterations = outer;
  result.f_mults          = f_mults();
  result.method           = "active set";
  return result;
}
} // namespace

ActiveSet::ActiveSet(const SolverParameters &the_parameters, const ActiveSetOptions &the_options)
  : parameters(the_parameters), options(the_options)
{}

DualSolution ActiveSet::solve(const DualProblem &problem, const WarmStart &start) const
{
  ActiveSetRun run(problem, parameters, options);
  if (run.run(start))
    return run.solution();
  problem.context().out() << "The active set " << run.reason() << " after " << run.f_mults()
                          << " F-mults; going on with SMALSE-M." << std::endl;
  SolverParameters remaining = parameters;
  remaining.max_iterations -=
    narrow<unsigned int>(std::min<unsigned long>(run.f_mults(), remaining.max_iterations));
  const unsigned long spent  = run.f_mults();
  DualSolution        result = Smalse(remaining).solve(problem, run.start());
  result.f_mults += spent;
  // The work of the run that gave up was done for this solution as well.
  result.outer_iterations += run.solution().outer_iterations;
  return result;
}
} // namespace snug::qp
