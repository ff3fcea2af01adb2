#include <snug/qp/cycle_detector.h>

#include <sstream>

namespace snug::qp {
CycleDetector::CycleDetector(const SetRules &the_rules) : rules(the_rules) {}

CycleDetector::InnerAccuracy
CycleDetector::enter(const std::uint64_t set, const double kkt_residual, const bool shrinks)
{
  count_visits(set);
  watch_residual(kkt_residual, shrinks);
  return inner_accuracy;
}

/// Count the visit and raise the inner_accuracy, which never decreases: exact on the visit that
/// counts as a cycle, single on the next visit. The visits are then counted anew, because changes
/// of single rows lead through other sets.
void CycleDetector::count_visits(const std::uint64_t set)
{
  const unsigned int n = ++visits[set];
  if (inner_accuracy == single && (++single_steps > rules.single_steps || n >= rules.visits))
    {
      inner_accuracy = give_up;
      why            = "cycles";
    }
  else if (inner_accuracy < single && n >= rules.visits)
    {
      inner_accuracy = n == rules.visits ? exact : single;
      if (inner_accuracy == single)
        visits.clear();
    }
}

/// Give up if the residual decreases too slowly. Changes of single rows are excluded, because they
/// have their own limit. Shrinking sets are excluded, because they end: a slender body peels off
/// its base, and each step advances by the thickness of the body.
void CycleDetector::watch_residual(const double kkt_residual, const bool shrinks)
{
  if (kkt_residual < 0.9 * least_residual)
    {
      least_residual = kkt_residual;
      idle_steps     = 0;
    }
  else if (inner_accuracy < single && !shrinks && ++idle_steps >= rules.patience)
    {
      inner_accuracy = give_up;
      std::ostringstream text;
      text << "stalls (minimum KKT residual " << least_residual << ")";
      why = text.str();
    }
}

const std::string &CycleDetector::reason() const
{
  return why;
}
} // namespace snug::qp
