#ifndef snug_geometry_entry_values_h
#define snug_geometry_entry_values_h

#include <snug/base/errors.h>
#include <snug/base/values.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace snug::geometry {
/// One number per axis of the entry, @p otherwise where it is empty.
template <int dim, typename Number>
std::array<Number, dim> per_axis(const std::string         &entry,
                                 const std::vector<Number> &values,
                                 Number                     otherwise,
                                 bool                       positive)
{
  std::array<Number, dim> result;
  result.fill(otherwise);
  if (values.empty())
    return result;
  bool good = values.size() == dim;
  for (const Number value : values)
    good = good && std::isfinite(static_cast<double>(value)) && (!positive || value > Number());
  if (!good)
    throw bad_entry(entry, to_text(values),
                    std::string("must be ") + std::to_string(dim) +
                      (positive ? " numbers > 0" : " numbers"));
  std::copy(values.begin(), values.end(), result.begin());
  return result;
}
} // namespace snug::geometry

#endif
