#include <snug/qp/row_set.h>
#include <snug/qp/set_iteration.h>

#include <sstream>

namespace snug::qp {
SetIteration::SetIteration(const DualProblem      &the_problem,
                           const SolverParameters &the_parameters,
                           const ActiveSetOptions &the_options,
                           const std::string      &the_method,
                           const double            the_forcing)
  : problem(the_problem)
  , context(the_problem.context())
  , parameters(the_parameters)
  , method(the_method)
  , history(the_options)
  , f_mults_before(context.work.f_mults)
  , inner_tolerance(the_forcing)
{}

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

void SetIteration::evaluate(const KrylovResult &inner)
{
  recurrences += inner.iterations;
  at_rounding = inner.at_rounding;
  // The w of the rows outside the set decides which rows enter. It needs the rigid amplitudes of
  // this set.
  kkt        = kkt_here();
  negligible = force_rounding(problem, lambda, kkt, scale, parameters.relative_tolerance);
  ++outer;
  std::ostringstream line;
  line << method << ", step " << outer << ": KKT residual " << kkt.relative << ", "
       << counted(f_mults(), "F-mult");
  context.progress(line.str());
}

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
  kkt = kkt_here();
  return is_met();
}
} // namespace snug::qp
