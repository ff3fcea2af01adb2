#include <snug/app/search_progress.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace snug::app {
SearchProgress::SearchProgress(const std::string &the_name,
                               const std::string &the_unit,
                               const unsigned int the_most,
                               const double       violation)
  : name(the_name), unit(the_unit), most(the_most), feasible(violation)
{}

void SearchProgress::end(const double objective, const double violation, const double seconds)
{
  if (n_analysed++ == 0)
    first_seconds = seconds;
  last_seconds   = seconds;
  best_violation = std::min(best_violation, violation);
  if (violation <= feasible)
    best = std::min(best, objective);
}

std::string SearchProgress::text() const
{
  std::ostringstream line;
  line << "evaluation " << n_begun << " of at most " << most;
  if (std::isfinite(best))
    line << ", best " << name << ' ' << best << unit;
  else if (std::isfinite(best_violation))
    line << ", minimum violation of the constraints " << best_violation;
  if (n_analysed > 1 && n_begun <= most)
    {
      const double each = (last_seconds - first_seconds) / (n_analysed - 1);
      line << ", at most " << std::ceil(each * (most - n_begun + 1)) << " s left";
    }
  return line.str();
}
} // namespace snug::app
