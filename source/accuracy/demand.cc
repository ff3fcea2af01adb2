#include <snug/accuracy/demand.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace snug::accuracy {
std::string text_of(const std::string &name, const Measured &measured)
{
  std::ostringstream text;
  text << name << ' ' << measured.value;
  if (!std::isfinite(measured.error))
    return text.str();
  text.precision(2);
  text << " +- " << measured.error;
  if (measured.value != 0.)
    text << " (" << 100. * measured.error / std::abs(measured.value) << " %)";
  return text.str();
}

double Demand::tolerance(const Measured &measured, const double least) const
{
  const double size = std::max(std::abs(measured.value), allowed(measured));
  return size > 0. ? step_tolerance(measured.error / size, is_energy, least) : maximum_tolerance;
}

/// Return whether recent values change their sign and the last value is not near the one before it.
bool Demand::is_noise() const
{
  const std::size_t n = values.size();
  return target.relative && n > 1 && changes_sign(values) &&
         std::abs(values[n - 1] - values[n - 2]) > 0.5 * std::abs(values[n - 1]);
}

/// Return why no mesh can meet the target of a response of this value, or an empty string if a
/// mesh may meet it.
std::string Demand::too_small(const Measured &measured) const
{
  const double least = smallest_target * std::abs(measured.value);
  if (target.allowed(measured.value) >= least)
    return "";
  std::ostringstream text;
  text << "the target " << target.value << " of " << name << " must be at least " << least
       << ", 1e-8 % of its value " << measured.value;
  return text.str();
}

/// Return errors over values. If elements lock, as those of thin bending bodies, both grow at
/// first.
std::vector<double> Demand::parts() const
{
  std::vector<double> result;
  for (std::size_t i = 0; i < errors.size(); ++i)
    {
      const double value = std::abs(values[values.size() - errors.size() + i]);
      result.push_back(value > 0. ? errors[i] / value : std::numeric_limits<double>::infinity());
    }
  return result;
}

/// Record the value and the error. A response that is zero has only the error of the solver. No
/// mesh makes this error a small share of the value, and it meets a target by chance.
std::string Demand::note(const Measured &measured, const bool is_met)
{
  errors.push_back(measured.error);
  values.push_back(measured.value);
  if (const auto why = too_small(measured); !is_met && !why.empty())
    return why;
  if (is_met && is_noise())
    return text_of(name, measured) + " changes its sign between meshes, and changes by more than "
                                     "half on the last mesh: it is probably zero; set its target "
                                     "as a number in its units";
  if (is_met)
    errors.clear();
  // Near the target the mesh after the next may meet it.
  if (measured.error < 2. * allowed(measured) || !is_unbounded(errors) || !is_unbounded(parts()))
    return "";
  return "the error of " + text_of(name, measured) +
         " has not decreased by a third on three meshes: " +
         (target.relative && (measured.error > std::abs(measured.value) || changes_sign(values))
            ? "it is probably zero; set its target as a number in its units"
            : "it is probably unbounded, like stresses at sharp edges; use another response, or "
              "round the edge");
}
} // namespace snug::accuracy
