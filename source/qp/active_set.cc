#include <snug/base/assertions.h>
#include <snug/base/narrow.h>
#include <snug/qp/active_set.h>
#include <snug/qp/friction_newton.h>
#include <snug/qp/pcpg.h>
#include <snug/qp/row_set.h>
#include <snug/qp/set_iteration.h>
#include <snug/qp/smalse.h>


#include <algorithm>
#include <limits>
#include <ostream>

namespace snug::qp {
namespace {
/// Number of consecutive steps that may fail to halve the KKT residual of one set, or to solve the
/// linear problem on the set.
const unsigned int allowed_stalls = 3;

/// State of one solve: the iterate, the active set and the data that belong to them.
class ActiveSetRun : public SetIteration
{
public:
  ActiveSetRun(const DualProblem      &the_problem,
               const SolverParameters &the_parameters,
               const ActiveSetOptions &the_options)
    : SetIteration(the_problem, the_parameters, the_options, "active set", the_options.forcing)
    , options(the_options)
  {}

  /// Solve from @p from. Return false if the set does not settle: another solver must then continue
  /// from start().
  bool run(const WarmStart &from);

  /// Return the reason why the set does not settle.
  std::string reason() const;

  WarmStart start() const { return {lambda, mask}; }

  DualSolution solution() const;

private:
  /// Return whether a cycle has used F-mults that another solver may need.
  bool is_long_cycle() const
  {
    return inner_accuracy != CycleDetector::none && f_mults() > parameters.max_iterations / 4;
  }

  KktResidual kkt_here() const override
  {
    return kkt_residual(problem, free_set->amplitudes(residual), lambda, residual, scale);
  }

  double kkt_of(const EqualityPart &equality) const
  {
    return kkt_residual(problem, equality.free_set->amplitudes(equality.residual), equality.lambda,
                        equality.residual, scale)
      .relative;
  }

  void   begin(const WarmStart &from);
  RowSet next_set() const;
  bool   change_set(const RowSet &next);
  void   keep_set();

  const ActiveSetOptions options;
  RowSet                 mask;
  std::unique_ptr<Pcpg>  krylov;        // of the face of mask
  bool                   solved = true; // whether the last solve on the set converged
};

/// Set up the start of the iteration. All ranks decide together whether the start is warm and has a
/// set, because a rank without rows has empty vectors in any case.
void ActiveSetRun::begin(const WarmStart &from)
{
  const MPI_Comm comm    = context.communicator();
  const bool     warm    = any(from.lambda.n_rows() > 0, comm);
  const bool     has_set = any(!from.active.empty(), comm);
  const bool     is_warm = warm || has_set;
  mask                   = RowSet(problem.n_owned(), 1);
  lambda                 = warm ? from.lambda : MultiVector(problem.n_owned());
  SNUG_ASSERT_EQUAL(lambda.n_rows(), problem.n_owned());
  SNUG_ASSERT(!has_set || from.active.size() == problem.n_owned(), "each row is active or not");
  for (unsigned int i = 0; i < problem.n_owned(); ++i)
    if (problem.bounded()[i] && is_warm)
      {
        mask[i] = has_set ? from.active[i] != 0 : lambda(i) > 0.;
        if (!mask[i])
          lambda(i) = 0.;
      }
  if (is_warm)
    free_set = balanced_set(problem, mask, lambda, scale);
  // equality_part() replaces the columns of its argument by d - F times the columns. It does this
  // in the application of F that lambda_Im needs anyway.
  residual              = is_warm ? lambda : MultiVector(problem.n_owned(), 0);
  EqualityPart equality = equality_part(problem, problem.initial_active_set(), residual);
  scale                 = equality.scale;
  // Start cold if the start has a larger KKT residual than lambda_Im: forces of a distant state
  // predict the set worse than the expected contacts do.
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

RowSet ActiveSetRun::next_set() const
{
  RowSet next(mask.size(), 1);
  // If the tolerance is met, only rows in tension are wrong. A w within the tolerance must not let
  // rows enter by its sign, because the search would start again from noise.
  const bool only_drop = is_met();
  for (unsigned int i = 0; i < next.size(); ++i)
    if (problem.bounded()[i])
      // The sign of lambda decides on the set, and the sign of w outside the set; ActiveSet says
      // why it is not lambda + c w. A row with neither force nor gap does not change, because its
      // signs are rounding errors that would let it leave and enter by turns.
      next[i] = mask[i] ? lambda(i) >= -negligible[i] : !only_drop && kkt.w(i) > kkt.rounding;
  if (inner_accuracy == CycleDetector::single && !only_drop)
    return with_one_change(mask, next, context.communicator());
  return next;
}

/// Continue on the same set with the same directions and a smaller tolerance.
void ActiveSetRun::keep_set()
{
  // The set may be the right one. Solve to at least a digit more, because otherwise each solve on
  // the set would achieve little.
  inner_tolerance = std::min(0.1 * inner_tolerance, options.forcing * kkt.relative);
  // A solve on the same set should do better than halve the residual. Only rounding in recurrence
  // and directions can prevent this. Begin another Krylov space from a residual computed anew.
  if (last_kkt > 0. && kkt.relative > 0.5 * last_kkt)
    {
      if (++stalls > allowed_stalls)
        throw not_converged("active set", kkt.relative, parameters.relative_tolerance, f_mults(),
                            false);
      krylov.reset();
      free_set = balanced_set(problem, mask, lambda, scale);
      refresh_residual();
      const bool deflates = false; // deflation has rounding errors of its own
      krylov              = std::make_unique<Pcpg>(problem, *free_set, DirectionBasis(), deflates);
    }
  last_kkt = kkt.relative;
}

/// Change the set to @p next. Return false if the set does not settle.
bool ActiveSetRun::change_set(const RowSet &next)
{
  const MPI_Comm comm    = context.communicator();
  bool           changed = false;
  for (unsigned int i = 0; i < next.size(); ++i)
    // Rows that leave lose their force, which unbalances G lambda = e. lambda must then be made
    // feasible on the next set, and its residual must be computed anew.
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
  // Directions that vanish on the leaving rows lie in the next face as well, with F P known.
  // Entering rows do not matter: balanced_set() only adds rows, so the directions stay in the face.
  // After a failed solve the directions and lambda are spoilt by rounding.
  DirectionBasis known = solved ? krylov->directions().off(leaving, comm) : DirectionBasis();
  // Destroy krylov first, because it refers to the face, which is replaced below.
  mask = next;
  krylov.reset();
  if (!solved || any(changed, comm))
    {
      free_set = balanced_set(problem, mask, lambda, scale);
      refresh_residual();
    }
  else
    free_set = problem.free_set(mask);
  krylov         = std::make_unique<Pcpg>(problem, *free_set, std::move(known));
  last_kkt       = 0.;
  stalls         = solved ? 0 : stalls + 1;
  inner_accuracy = history.enter(fingerprint(mask, comm), kkt.relative, !any(enters, comm));
  if (inner_accuracy != CycleDetector::none)
    inner_tolerance *= 0.01;
  return inner_accuracy != CycleDetector::give_up && stalls <= allowed_stalls && !is_long_cycle();
}

std::string ActiveSetRun::reason() const
{
  if (inner_accuracy == CycleDetector::give_up)
    return history.reason();
  return is_long_cycle() ? "cycles" : "does not converge on its free sets";
}

bool ActiveSetRun::run(const WarmStart &from)
{
  begin(from);
  while (true)
    {
      solved = solve_on_set(*krylov).converged;
      if (finished())
        return true;
      const RowSet next = next_set();
      if (!any(next != mask, context.communicator()))
        keep_set();
      else if (!change_set(next))
        return false;
    }
}

/// The solution includes the directions, because sensitivities solve with the same F on (part of)
/// the same face.
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
  if (any(!problem.cones().empty(), problem.context().communicator()))
    return friction_newton(problem, parameters, start);
  ActiveSetRun run(problem, parameters, options);
  if (run.run(start))
    return run.solution();
  problem.context().out() << "active set method: " << run.reason() << " after "
                          << counted(run.f_mults(), "F-mult") << ", continuing with SMALSE-M"
                          << std::endl;
  SolverParameters remaining = parameters;
  remaining.max_iterations -=
    narrow<unsigned int>(std::min<unsigned long>(run.f_mults(), remaining.max_iterations));
  const unsigned long spent  = run.f_mults();
  DualSolution        result = Smalse(remaining).solve(problem, run.start());
  result.f_mults += spent;
  // Add the steps of the run that gave up, because they were done for this solution as well.
  result.outer_iterations += run.solution().outer_iterations;
  return result;
}
} // namespace snug::qp
