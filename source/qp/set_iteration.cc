#include <snug/base/assertions.h>
#include <snug/base/narrow.h>
#include <snug/qp/row_set.h>
#include <snug/qp/set_iteration.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace snug::qp {
SetIteration::SetIteration(const DualProblem      &the_problem,
                           const SolverParameters &the_parameters,
                           const SetRules         &the_rules)
  : problem(the_problem)
  , context(the_problem.context())
  , parameters(the_parameters)
  , rules(the_rules)
  , history(the_rules)
  , f_mults_before(context.work.f_mults)
  , has_friction(any(!the_problem.cones().empty(), context.communicator()))
  , sets(the_problem)
  , friction(the_problem, the_rules.is_lagging)
  , inner_tolerance(the_rules.forcing)
{}

KktResidual SetIteration::kkt_of(const FreeSet     &face,
                                 const MultiVector &x,
                                 const MultiVector &residual_of_x) const
{
  const auto reduced = face.free_rows().reduced_residual(x, residual_of_x);
  return kkt_residual(problem, face.amplitudes(reduced), x, residual_of_x, scale);
}

/// Set up the start of the iteration. All ranks decide together whether the start is warm and has a
/// set, because a rank without rows has empty vectors in any case.
void SetIteration::begin(const WarmStart &from)
{
  const MPI_Comm comm    = context.communicator();
  const bool     warm    = any(from.lambda.n_rows() > 0, comm);
  const bool     has_set = any(!from.active.empty(), comm);
  const bool     is_warm = warm || has_set;
  kkt.w                  = MultiVector(problem.n_owned());
  lambda                 = warm ? from.lambda : MultiVector(problem.n_owned());
  SNUG_ASSERT_EQUAL(lambda.n_rows(), problem.n_owned());
  SNUG_ASSERT(!has_set || from.active.size() == problem.n_owned(), "each row is active or not");
  if (is_warm)
    free_set = sets.balanced(has_set ? FreeRows(from.active, from.slips) : friction.at(lambda),
                             kkt.w, scale, lambda);
  // equality_part() replaces the columns of its argument by d - F times the columns. It does this
  // in the application of F that lambda_Im needs anyway.
  residual              = is_warm ? lambda : MultiVector(problem.n_owned(), 0);
  EqualityPart equality = equality_part(problem, problem.initial_active_set(), residual);
  scale                 = equality.scale;
  // Start cold if the start has a larger KKT residual than lambda_Im: forces of a distant state
  // predict the set worse than the expected contacts do.
  if (!is_warm ||
      (!has_set && kkt_of(*equality.free_set, equality.lambda, equality.residual).relative <
                     kkt_of(*free_set, lambda, residual).relative))
    {
      lambda   = equality.lambda;
      residual = equality.residual;
      free_set = std::move(equality.free_set);
    }
  krylov = std::make_unique<FaceKrylov>(problem, *free_set, from.directions);
  history.enter(fingerprint(free_set->free_rows().rows(), comm), std::numeric_limits<double>::max(),
                false);
}

/// Solve the linear problem on the set and compute the KKT residual.
void SetIteration::solve_on_set()
{
  // The limit counts F-mults, not steps, because all solvers measure their work in F-mults.
  if (f_mults() >= parameters.max_iterations)
    throw not_converged(rules.method, kkt_of(*free_set, lambda, residual).relative,
                        parameters.relative_tolerance, f_mults(), true);
  // An inner solve below half of the wanted KKT residual would only polish a set that may still
  // change. After a cycle the signs of small entries decide, so inner solves may go further down.
  const double least =
    (inner_accuracy == CycleDetector::none ? 0.5 : 0.005) * parameters.relative_tolerance;
  const KrylovResult inner =
    krylov->solve(lambda, residual, {std::max(inner_tolerance, least) * scale},
                  narrow<unsigned int>(parameters.max_iterations - f_mults()));
  solved = inner.converged;
  recurrences += inner.iterations;
  at_rounding = inner.at_rounding;
  // The w of the rows outside the set decides which rows enter. It needs the rigid amplitudes of
  // this set.
  kkt        = kkt_of(*free_set, lambda, residual);
  negligible = force_rounding(problem, lambda, kkt, scale, parameters.relative_tolerance);
  ++outer;
  std::ostringstream line;
  line << rules.method << ", step " << outer << ": KKT residual " << kkt.relative << ", "
       << counted(f_mults(), "F-mult");
  context.progress(line.str());
}

/// Return whether the KKT residual meets the tolerance, or has reached its rounding error.
bool SetIteration::is_met() const
{
  return kkt.relative <= parameters.relative_tolerance ||
         (at_rounding && kkt.relative - kkt.feasibility <=
                           residual_rounding / projection_rounding * kkt.rounding / scale);
}

void SetIteration::refresh_residual()
{
  residual = problem.d();
  residual.add(-1., problem.apply(lambda));
  recurrences = 0;
}

/// Return whether the tolerance is met by a lambda without tension on contact rows, and not only
/// by the recurrence of the residual. Clips forces that are rounding errors.
bool SetIteration::finished()
{
  if (!is_met())
    return false;
  clip_rounding(problem.bounded(), negligible, lambda);
  if (any(has_negative(problem.bounded(), lambda), context.communicator()))
    return false;
  if (recurrence_error(problem, residual, recurrences) <
      0.1 * parameters.relative_tolerance * scale)
    return true;
  refresh_residual();
  kkt = kkt_of(*free_set, lambda, residual);
  return is_met();
}

FreeRows SetIteration::next_rows() const
{
  const FreeRows &now = free_set->free_rows();
  RowSet          next(now.rows().size(), 1);
  // If the tolerance is met, only rows in tension are wrong. A w within the tolerance must not let
  // rows enter by its sign, because the search would start again from noise.
  const bool only_drop = is_met();
  for (unsigned int i = 0; i < next.size(); ++i)
    if (problem.bounded()[i])
      // The sign of lambda decides on the set, and the sign of w outside the set; ActiveSet says
      // why it is not lambda + c w. A row with neither force nor gap does not change, because its
      // signs are rounding errors that would let it leave and enter by turns.
      next[i] = now.rows()[i] ? lambda(i) >= -negligible[i] : !only_drop && kkt.w(i) > kkt.rounding;
  const FreeRows rows = friction.next(now, next, lambda, kkt.w, negligible);
  return inner_accuracy == CycleDetector::single && !only_drop ? sets.with_one_change(now, rows)
                                                               : rows;
}

/// Take @p rows as the next sets, changed where they do not hold the bodies, with the directions
/// @p known of the last face.
void SetIteration::take(const FreeRows &rows, const DirectionBasis &known, const bool deflates)
{
  // Destroy krylov first, because it refers to the face.
  krylov.reset();
  free_set = sets.balanced(rows, kkt.w, scale, lambda);
  refresh_residual();
  krylov = std::make_unique<FaceKrylov>(problem, *free_set, known, deflates);
}

/// Continue on the same sets with a smaller tolerance. Directions of slips in space may change.
void SetIteration::keep_rows(const FreeRows &next)
{
  // The sets may be the right ones. Solve to at least a digit more, because otherwise each solve on
  // the sets would achieve little.
  inner_tolerance = std::min(0.1 * inner_tolerance, rules.settled * rules.forcing * kkt.relative);
  // A solve on the same set should do better than halve the residual. Only rounding in recurrence
  // and directions can prevent this, or slips that turn.
  const bool has_stalled = last_kkt > 0. && kkt.relative > 0.5 * last_kkt;
  if (has_stalled && ++stalls > rules.allowed_stalls)
    throw not_converged(rules.method, kkt.relative, parameters.relative_tolerance, f_mults(),
                        false);
  last_kkt = kkt.relative;
  // In the plane the linear problem changes with the sets alone.
  const bool turns =
    has_friction && any(std::any_of(next.slips().begin(), next.slips().end(),
                                    [](const Slip &s) { return s.cone.n_tangents == 2; }),
                        context.communicator());
  // Where the residual stalls, begin another Krylov space from a residual computed anew. Deflation
  // has rounding errors of its own.
  if (has_stalled || turns || (has_friction && stalls > 0))
    take(next, has_friction ? krylov->release_directions() : DirectionBasis(), has_friction);
}

/// @throws UnsettledSets if the sets do not settle.
void SetIteration::change_rows(const FreeRows &next)
{
  const MPI_Comm comm   = context.communicator();
  const RowSet  &before = free_set->free_rows().rows();
  bool           enters = false, unloads = has_friction;
  for (unsigned int i = 0; i < before.size(); ++i)
    {
      enters = enters || (next.rows()[i] && !before[i]);
      // Rows that leave lose their force, which unbalances G lambda = e. lambda must then be made
      // feasible on the next set, and its residual must be computed anew.
      unloads = unloads || (!next.rows()[i] && lambda(i) != 0.);
    }
  // Directions that vanish on the leaving rows lie in the next face as well, with F P known. After
  // a failed solve the directions and lambda are spoilt by rounding.
  const auto known = solved ? krylov->release_directions() : DirectionBasis();
  if (!solved || any(unloads, comm))
    take(next, known, true);
  else
    {
      krylov.reset();
      free_set = problem.free_set(next);
      krylov   = std::make_unique<FaceKrylov>(problem, *free_set, known);
    }
  last_kkt       = 0.;
  stalls         = solved ? 0 : stalls + 1;
  inner_accuracy = history.enter(fingerprint(free_set->free_rows().rows(), comm), kkt.relative,
                                 !any(enters, comm));
  if (inner_accuracy == CycleDetector::give_up)
    throw UnsettledSets(history.reason());
  if (stalls > rules.allowed_stalls)
    throw UnsettledSets("does not converge on its free sets");
  if (inner_accuracy != CycleDetector::none &&
      double(f_mults()) > rules.in_cycles * double(parameters.max_iterations))
    throw UnsettledSets("cycles");
}

DualSolution SetIteration::solve(const WarmStart &from)
{
  begin(from);
  while (true)
    {
      solve_on_set();
      if (finished())
        return solution();
      const FreeRows next = next_rows();
      if (any(next.rows() != free_set->free_rows().rows(), context.communicator()))
        {
          inner_tolerance = std::min(inner_tolerance, rules.forcing * kkt.relative);
          change_rows(next);
          if (inner_accuracy != CycleDetector::none)
            inner_tolerance *= 0.01;
        }
      else
        keep_rows(next);
      if (sets.n_repairs() > rules.many_repairs)
        inner_tolerance = std::min(inner_tolerance, rules.exact_forcing * kkt.relative);
    }
}

/// The solution includes conjugate directions, because sensitivities solve with the same F on (part
/// of) the same face.
DualSolution SetIteration::solution()
{
  DualSolution result;
  const auto  &free   = free_set->free_rows();
  const auto   loaded = loaded_rows(problem.bounded(), lambda);
  result.lambda       = lambda;
  if (auto directions = krylov->release_directions(); directions.is_conjugate)
    result.directions = std::move(directions);
  result.residual   = residual;
  result.amplitudes = kkt.amplitudes;
  result.active     = free.rows();
  for (unsigned int i = 0; i < loaded.size(); ++i)
    result.active[i] = free.rows()[i] && loaded[i];
  for (const FrictionCone &cone : problem.cones())
    for (unsigned int t = 0; t < cone.n_tangents; ++t)
      result.active[cone.tangents[t]] = result.active[cone.tangents[t]] && loaded[cone.normal];
  for (const Slip &slip : free.slips())
    if (loaded[slip.cone.normal])
      result.slips.push_back(slip);
  result.kkt_residual     = kkt.relative;
  result.outer_iterations = outer;
  result.f_mults          = f_mults();
  result.method           = rules.method;
  return result;
}
} // namespace snug::qp
