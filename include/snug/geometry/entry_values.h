#ifndef snug_geometry_entry_values_h
#define snug_geometry_entry_values_h

#include <snug/base/errors.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

namespace snug::geometry {
/// "a, b, c" as the user writes lists.
template <typename Number>
std::string joined(const std::vector<Number> &values)
{
  std::ostringstream text;
  for (std::size_t i = 0; i < values.size(); ++i)
    text << (i == 0 ? "" : ", ") << values[i];
  return text.str();
}

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
    throw bad_entry(entry, joined(values),
                    std::string("must be ") + std::to_string(dim) +
                      (positive ? " numbers > 0" : " numbers"));
  std::copy(values.begin(), values.end(), result.begin());
  return result;
}
} // namespace snug::geometry

#endif
