#include <snug/geometry/entry_values.h>
#include <snug/geometry/round_body.h>

namespace snug::geometry {
std::vector<unsigned int> round_cells(const BodyMeshParameters &parameters, unsigned int n)
{
  const auto &given = parameters.round_cells;
  // The default of the entry Cells is 4 cells each.
  if (given.empty())
    return std::vector<unsigned int>(n, 4);
  if (given.size() != n || std::count(given.begin(), given.end(), 0u) > 0)
    throw bad_entry("Cells", to_text(given),
                    "must be " + std::to_string(n) + " numbers of at least 1 for a " +
                      to_text(parameters.source));
  return given;
}

unsigned int n_of_part(const BodyMeshParameters &parameters, unsigned int largest)
{
  const unsigned int n = 1u << static_cast<unsigned int>(parameters.part);
  if (n <= largest)
    return n;
  throw bad_entry("Part", to_text(parameters.part),
                  "must be full, half or quarter for a " + to_text(parameters.source));
}

void require_positive(const std::string &entry, double value)
{
  if (!(std::isfinite(value) && value > 0.))
    throw bad_entry(entry, to_text(value), "must be positive");
}

void require_radii(const BodyMeshParameters &parameters)
{
  require_positive("Radius", parameters.radius);
  require_positive("Inner radius", parameters.inner_radius);
  if (parameters.inner_radius >= parameters.radius)
    throw bad_entry("Inner radius", to_text(parameters.inner_radius), "must be below the radius");
}
} // namespace snug::geometry
