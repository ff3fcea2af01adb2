#include <snug/qp/friction_newton.h>
#include <snug/qp/held_sets.h>
#include <snug/qp/projected_gcr.h>
#include <snug/qp/row_set.h>
#include <snug/qp/set_iteration.h>

#include <algorithm>
#include <cmath>

namespace snug::qp {
namespace {
/// Tolerance of inner solves, as a part of the last KKT residual. Measured in 3D: 0.03, 0.1, 0.3
/// and 0.7 take 27, 24, 25 and 31 F-mults.
const double forcing = 0.1;

/// The same where the sets have not changed.
const double settled_forcing = 0.03;

/// The same after several changes of sets for free motions.
const double exact_forcing = 1e-3;

/// Number of changes of sets for free motions after which inner solves are more exact.
const unsigned int many_repairs = 3;

/// Maximum D / F_TT, reached where a contact closes and has no friction force yet.
const double largest_compliance = 1e6;

/// Number of consecutive steps without a change of sets that may fail to halve the KKT residual.
const unsigned int patience_on_sets = 12;

/// A force of a warm start within this part of its limit slips.
const double at_limit = 1e-6;

/// Ways to change the sets, in the order in which they are tried.
enum class Steps
{
  full,   ///< Newton steps
  lagging ///< limits of friction forces are those of the last step
};

/// State of one solve: the iterate, the sets and the data that belong to them.
class FrictionRun : public SetIteration
{
public:
  FrictionRun(const DualProblem      &the_problem,
              const SolverParameters &the_parameters,
              const Steps             the_steps)
    : SetIteration(the_problem, the_parameters, ActiveSetOptions(), "friction", forcing)
    , steps(the_steps)
    , w(the_problem.n_owned())
    , sets(the_problem)
  {}

  DualSolution run(const WarmStart &from);

private:
  KktResidual kkt_here() const override
  {
    const auto reduced = free_set->free_rows().reduced_residual(lambda, residual);
    return kkt_residual(problem, free_set->amplitudes(reduced), lambda, residual, scale);
  }

  void     begin(const WarmStart &from);
  FreeRows rows_of(const WarmStart &from) const;
  void     take(const FreeRows &rows);
  FreeRows next_rows() const;
  void     set_friction(const FrictionCone &cone, RowSet &rows, std::vector<Slip> &slips) const;
  void     set_in_corner(const FrictionCone &cone, RowSet &rows, std::vector<Slip> &slips) const;
  FrictionCone limited(FrictionCone cone) const;
  void         keep_rows();
  void         change_rows(const FreeRows &next);
  DualSolution solution() const;

  const Steps                   steps;
  MultiVector                   w; // of the last solve
  HeldSets                      sets;
  std::unique_ptr<ProjectedGcr> krylov;
};

/// Return the sets of a warm start. Without a given set, forces at their limit slip.
FreeRows FrictionRun::rows_of(const WarmStart &from) const
{
  const bool has_set = any(!from.active.empty(), context.communicator());
  if (has_set)
    return {from.active, from.slips};
  RowSet            rows = loaded_rows(problem.bounded(), from.lambda);
  std::vector<Slip> slips;
  for (const FrictionCone &cone : problem.cones())
    {
      const double          limit = cone.limit(from.lambda);
      std::array<double, 2> force = {};
      for (unsigned int t = 0; t < cone.n_tangents; ++t)
        force[t] = from.lambda(cone.tangents[t]);
      const double length = std::hypot(force[0], force[1]);
      const bool   slides = rows[cone.normal] && length > 0. && length >= (1. - at_limit) * limit;
      for (unsigned int t = 0; t < cone.n_tangents; ++t)
        rows[cone.tangents[t]] = rows[cone.normal] && !slides;
      if (slides)
        slips.push_back({cone, {{force[0] / length, force[1] / length}}, 0.});
    }
  return {rows, slips};
}

void FrictionRun::begin(const WarmStart &from)
{
  const MPI_Comm comm    = context.communicator();
  const bool     warm    = any(from.lambda.n_rows() > 0, comm);
  const bool     has_set = any(!from.active.empty(), comm);
  if (warm || has_set)
    {
      lambda   = warm ? from.lambda : MultiVector(problem.n_owned());
      free_set = sets.balanced(rows_of({lambda, from.active, {}, from.slips}), w, scale, lambda);
    }
  residual              = warm || has_set ? lambda : MultiVector(problem.n_owned(), 0);
  EqualityPart equality = equality_part(problem, problem.initial_active_set(), residual);
  scale                 = equality.scale;
  bool is_cold          = !warm && !has_set;
  if (!is_cold && !has_set)
    is_cold = kkt_residual(problem, equality.free_set->amplitudes(equality.residual),
                           equality.lambda, equality.residual, scale)
                .relative < kkt_here().relative;
  if (is_cold)
    {
      lambda   = equality.lambda;
      residual = equality.residual;
      free_set = std::move(equality.free_set);
    }
  krylov = std::make_unique<ProjectedGcr>(problem, *free_set);
  history.enter(fingerprint(free_set->free_rows().rows(), comm), HUGE_VAL, false);
}

/// Take @p rows as the next sets, changed where they do not hold the bodies.
void FrictionRun::take(const FreeRows &rows)
{
  krylov.reset(); // refers to the face
  free_set = sets.balanced(rows, w, scale, lambda);
  refresh_residual();
  krylov = std::make_unique<ProjectedGcr>(problem, *free_set);
}

/// Return @p cone with the limit for the next step.
FrictionCone FrictionRun::limited(FrictionCone cone) const
{
  if (steps == Steps::lagging)
    {
      cone.bound       = cone.limit(lambda);
      cone.coefficient = 0.;
    }
  return cone;
}

/// Decide whether a contact slips whose node another obstacle holds, too. Along both obstacles,
/// their friction adds up: the contact with the larger limit takes the force up to this limit.
void FrictionRun::set_in_corner(const FrictionCone &cone,
                                RowSet             &rows,
                                std::vector<Slip>  &slips) const
{
  for (unsigned int t = 0; t < cone.n_tangents; ++t)
    rows[cone.tangents[t]] = 0;
  if (cone.n_along_both == 0)
    return;
  const unsigned int row   = cone.tangents[0];
  const double       own   = cone.limit(lambda);
  double             x     = lambda(row) + w(row) / cone.compliance(problem.diagonal());
  double             other = 0.; // limit of the other contact
  for (const FrictionCone &of : problem.cones())
    if (cone.other_tangent && of.normal == *cone.other_normal)
      {
        x += lambda(*cone.other_tangent);
        other = of.limit(lambda);
      }
  const bool is_larger =
    own > other || (own == other && !(cone.other_tangent && *cone.other_tangent < row));
  const bool slides = std::abs(x) > other + (is_larger ? own : 0.) + negligible[row];
  rows[row]         = is_larger && !slides;
  if (!slides)
    return;
  slips.push_back({limited(cone), {{x > 0. ? 1. : -1., 0.}}, 0.});
  slips.back().cone.n_tangents = 1;
}

/// Decide whether a closed contact sticks or slips.
void FrictionRun::set_friction(const FrictionCone &cone,
                               RowSet             &rows,
                               std::vector<Slip>  &slips) const
{
  if (cone.is_cornered(rows))
    return set_in_corner(cone, rows, slips);
  const double F      = cone.compliance(problem.diagonal());
  const double limit  = cone.limit(lambda);
  const auto   x      = cone.trial_force(F, lambda, w);
  const double length = std::hypot(x[0], x[1]);
  bool         slides = length > limit + negligible[cone.tangents[0]];
  for (const Slip &before : free_set->free_rows().slips())
    if (before.cone.normal == cone.normal &&
        before.direction[0] * x[0] + before.direction[1] * x[1] < 0.)
      slides = false;
  for (unsigned int t = 0; t < cone.n_tangents; ++t)
    rows[cone.tangents[t]] = !slides;
  if (!slides)
    return;
  slips.push_back({limited(cone),
                   {{x[0] / length, x[1] / length}},
                   F * (limit > 0. ? std::min((length - limit) / limit, largest_compliance)
                                   : largest_compliance)});
}

FreeRows FrictionRun::next_rows() const
{
  const RowSet     &rows = free_set->free_rows().rows();
  RowSet            next(rows.size(), 1);
  std::vector<Slip> slips;
  // See ActiveSet. If the tolerance is met, only contacts in tension are wrong.
  const bool only_drop = is_met();
  for (unsigned int i = 0; i < next.size(); ++i)
    if (problem.bounded()[i])
      next[i] = rows[i] ? lambda(i) >= -negligible[i] : !only_drop && w(i) > kkt.rounding;
  for (const FrictionCone &cone : problem.cones())
    if (next[cone.normal])
      set_friction(cone, next, slips);
    else
      for (unsigned int t = 0; t < cone.n_tangents; ++t)
        next[cone.tangents[t]] = 0;
  if (inner_accuracy != CycleDetector::single || only_drop)
    return {next, slips};
  return sets.with_one_change(free_set->free_rows(), {next, slips});
}

/// Continue on the same sets, where directions of slips in space may change.
void FrictionRun::keep_rows()
{
  inner_tolerance = std::min(0.1 * inner_tolerance, settled_forcing * kkt.relative);
  if (last_kkt > 0. && kkt.relative > 0.5 * last_kkt && ++stalls > patience_on_sets)
    throw not_converged("friction", kkt.relative, parameters.relative_tolerance, f_mults(), false);
  last_kkt = kkt.relative;
}

void FrictionRun::change_rows(const FreeRows &next)
{
  const MPI_Comm comm  = context.communicator();
  inner_tolerance      = std::min(inner_tolerance, forcing * kkt.relative);
  const RowSet &before = free_set->free_rows().rows();
  bool          enters = false;
  for (unsigned int i = 0; i < before.size(); ++i)
    enters = enters || (next.rows()[i] && !before[i]);
  inner_accuracy = history.enter(fingerprint(next.rows(), comm), kkt.relative, !any(enters, comm));
  last_kkt       = 0.;
  if (inner_accuracy == CycleDetector::give_up)
    throw UnsettledSets("the friction solver does not converge: it " + history.reason() +
                        " after " + counted(f_mults(), "F-mult") +
                        "; the contact may slide, or have several states");
  if (inner_accuracy != CycleDetector::none)
    inner_tolerance *= 0.01;
}

DualSolution FrictionRun::run(const WarmStart &from)
{
  begin(from);
  while (true)
    {
      solve_on_set(*krylov);
      w = kkt.w;
      if (finished())
        return solution();
      const FreeRows next   = next_rows();
      const auto    &now    = free_set->free_rows();
      const bool     change = any(next.rows() != now.rows(), context.communicator());
      if (change)
        change_rows(next);
      else
        keep_rows();
      if (sets.n_repairs() > many_repairs)
        inner_tolerance = std::min(inner_tolerance, exact_forcing * kkt.relative);
      // In the plane the linear problem changes with the sets alone.
      const bool turns = any(std::any_of(next.slips().begin(), next.slips().end(),
                                         [](const Slip &s) { return s.cone.n_tangents == 2; }),
                             context.communicator());
      if (change || turns || stalls > 0)
        take(next);
    }
}

DualSolution FrictionRun::solution() const
{
  DualSolution result;
  const auto  &free   = free_set->free_rows();
  const auto   loaded = loaded_rows(problem.bounded(), lambda);
  result.lambda       = lambda;
  result.residual     = residual;
  result.amplitudes   = kkt.amplitudes;
  result.active       = free.rows();
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
  result.method           = "friction";
  return result;
}
} // namespace

DualSolution friction_newton(const DualProblem      &problem,
                             const SolverParameters &parameters,
                             const WarmStart        &start)
{
  const unsigned long before = problem.context().work.f_mults;
  try
    {
      return FrictionRun(problem, parameters, Steps::full).run(start);
    }
  catch (const UnsettledSets &error)
    {
      problem.context().out(Verbosity::debug)
        << error.what() << "; starting again with friction limits of the last step" << std::endl;
    }
  auto result    = FrictionRun(problem, parameters, Steps::lagging).run({MultiVector(), {}});
  result.f_mults = problem.context().work.f_mults - before;
  return result;
}
} // namespace snug::qp
