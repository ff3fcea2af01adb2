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
/// Return the words of @p text, which blanks separate.
inline std::vector<std::string> words(const std::string &text)
{
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

/// Return 0, 1, 2 for the axes x, y, z, and 3 for other names.
inline unsigned int axis_called(const std::string &name)
{
  return name.size() == 1 ? std::min<std::size_t>(3, std::string("xyz").find(name)) : 3;
}

/// Return the index of @p name in @p names, or the number of names if @p name is not in the list.
inline unsigned int index_of(const std::vector<std::string> &names, const std::string &name)
{
  return std::find(names.begin(), names.end(), name) - names.begin();
}

/// Return the index of @p name in @p names, after adding @p name if it is not in the list.
inline unsigned int index_in(std::vector<std::string> &names, const std::string &name)
{
  const unsigned int index = index_of(names, name);
  if (index == names.size())
    names.push_back(name);
  return index;
}

/// Return one number of the entry per axis, or @p otherwise if the entry is empty.
/// @throws InputError if the number of values is wrong, a value is not finite, or @p positive is
/// true and a value is not positive.
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
