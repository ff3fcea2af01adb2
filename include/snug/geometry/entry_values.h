#ifndef snug_geometry_entry_values_h
#define snug_geometry_entry_values_h

#include <snug/base/errors.h>
#include <snug/base/values.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace snug::geometry {
/// The words of @p text between blanks.
inline std::vector<std::string> words(const std::string &text)
{
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

/// 0, 1, 2 of the axes called x, y, z; 3 of other names.
inline unsigned int axis_called(const std::string &name)
{
  return name.size() == 1 ? std::min<std::size_t>(3, std::string("xyz").find(name)) : 3;
}

/// Index of @p name in @p names; their number if it is none of them.
inline unsigned int index_of(const std::vector<std::string> &names, const std::string &name)
{
  return std::find(names.begin(), names.end(), name) - names.begin();
}

/// Index of @p name in @p names, to which it is added if need be.
inline unsigned int index_in(std::vector<std::string> &names, const std::string &name)
{
  const unsigned int index = index_of(names, name);
  if (index == names.size())
    names.push_back(name);
  return index;
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
    throw bad_entry(entry, to_text(values),
                    std::string("must be ") + std::to_string(dim) +
                      (positive ? " numbers > 0" : " numbers"));
  std::copy(values.begin(), values.end(), result.begin());
  return result;
}
} // namespace snug::geometry

#endif
