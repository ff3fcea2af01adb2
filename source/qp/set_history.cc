#include <snug/qp/set_history.h>

#include <sstream>

namespace snug::qp {
SetHistory::SetHistory(const ActiveSetOptions &the_options) : options(the_options) {}

SetHistory::Care
SetHistory::enter(const std::uint64_t set, const double kkt_residual, const bool shrinks)
{
  count_visits(set);
  watch_residual(kkt_residual, shrinks);
  return care;
}

/// Count the visit and raise the care, which never decreases: exact on the visit that counts as a
/// cycle, single on the next visit. The visits are then counted anew, because changes of single
/// rows lead through other sets.
void SetHistory::count_visits(const std::uint64_t set)
{
  const unsigned int n = ++visits[set];
  if (care == single && (++single_steps > options.single_steps || n >= options.visits))
    {
      care = give_up;
      why  = "cycles";
    }
  else if (care < single && n >= options.visits)
    {
      care = n == options.visits ? exact : single;
      if (care == single)
        visits.clear();
    }
}

/// Give up if the residual decreases too slowly. Changes of single rows are excluded, because they
/// have their own limit. Shrinking sets are excluded, because they end: a slender body peels off
/// its base, and each step advances by the thickness of the body.
void SetHistory::watch_residual(const double kkt_residual, const bool shrinks)
{
  if (kkt_residual < 0.9 * least_residual)
    {
      least_residual = kkt_residual;
      idle_steps     = 0;
    }
  else if (care < single && !shrinks && ++idle_steps >= options.patience)
    {
      care = give_up;
      std::ostringstream text;
      text << "stalls (minimum KKT residual " << least_residual << ")";
      why = text.str();
    }
}

const std::string &SetHistory::reason() const
{
  return why;
}
} // namespace snug::qp
