#include <snug/optimization/minimize.h>

#include <sstream>

namespace snug::optimization {
std::string complaint(const OptimizationResult &result, const OptimizationParameters &parameters)
{
  const bool is_feasible  = result.constraint_violation <= parameters.constraint_tolerance;
  const bool is_cut_short = result.end == End::interrupted || result.end == End::evaluations;
  if (result.success || (is_feasible && is_cut_short))
    return "";
  std::ostringstream text;
  text << "the optimization is not solved to its tolerance: it stopped by " << result.stop_reason;
  if (!is_feasible)
    text << "; the design found violates a constraint by " << result.constraint_violation
         << " of its limit";
  return text.str();
}

bool takes_equalities(const Algorithm algorithm)
{
  return algorithm != Algorithm::MMA && algorithm != Algorithm::CCSAQ;
}
} // namespace snug::optimization
