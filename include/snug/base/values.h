#ifndef snug_base_values_h
#define snug_base_values_h

#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

/// Values as text that reads back to exactly the same value. Lists are
/// "a, b", pairs "key: value", and maps lists of pairs.
namespace snug {
using TextMap   = std::map<std::string, std::string>;
using VectorMap = std::map<std::string, std::vector<double>>;
using TextPairs = std::vector<std::pair<std::string, std::string>>;

/// What parameter files call a choice, and what it means.
struct Name
{
  std::string name, meaning = {};
};
using Names = std::vector<Name>;

/// Without white space at its ends.
std::string trim(const std::string &text);

/// The trimmed parts of a text; separators within parentheses, as of
/// max(x, y), do not count.
std::vector<std::string> split(const std::string &text, char separator);

/// The parts of "0 0 -5*max(x, y)": blanks within parentheses do not count.
std::vector<std::string> components(const std::string &text);

/// Components separated by commas or, where there is none, by blanks.
std::vector<std::string> vector_components(const std::string &text);

std::string to_text(double value);
std::string to_text(unsigned int value);
std::string to_text(bool value);
std::string to_text(const std::string &value);

/// @throws std::invalid_argument if it is malformed, as all from_text() do
void from_text(const std::string &text, double &value);
void from_text(const std::string &text, unsigned int &value);
void from_text(const std::string &text, bool &value);
void from_text(const std::string &text, std::string &value);

/// An enum that counts from 0 has a function names(E) beside it, which
/// gives the Names of its values in their order.
template <typename E, typename = std::enable_if_t<std::is_enum_v<E>>>
std::string to_text(const E value)
{
  return names(value).at(static_cast<std::size_t>(value)).name;
}

template <typename E, typename = std::enable_if_t<std::is_enum_v<E>>>
void from_text(const std::string &text, E &value)
{
  const Names all = names(value);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].name == text)
      {
        value = static_cast<E>(i);
        return;
      }
  throw std::invalid_argument("no such name");
}

/// "auto" stands for no value.
template <typename T>
std::string to_text(const std::optional<T> &value)
{
  return value ? to_text(*value) : "auto";
}

template <typename T>
void from_text(const std::string &text, std::optional<T> &value)
{
  if (text == "auto")
    value.reset();
  else
    from_text(text, value.emplace());
}

template <typename T>
std::string to_text(const std::vector<T> &values, char separator = ',');

/// "key: value"; vectors have their components separated by blanks.
template <typename T>
std::string to_text(const std::pair<const std::string, T> &pair)
{
  if constexpr (std::is_same_v<T, std::vector<double>>)
    return pair.first + ": " + to_text(pair.second, ' ');
  else
    return pair.first + ": " + to_text(pair.second);
}

template <typename T>
std::string to_text(const std::vector<T> &values, const char separator)
{
  std::string text;
  for (const auto &value : values)
    text += (text.empty()       ? ""
             : separator == ' ' ? " "
                                : std::string(1, separator) + " ") +
            to_text(value);
  return text;
}

template <typename T>
std::string to_text(const std::map<std::string, T> &map, const char separator = ',')
{
  return to_text(std::vector<std::pair<const std::string, T>>(map.begin(), map.end()), separator);
}

std::string to_text(const TextPairs &pairs, char separator = ',');

/// Numbers may be separated by blanks as well. Counts are at least 1.
template <typename T>
void from_text(const std::string &text, std::vector<T> &values, const char separator = ',')
{
  values.clear();
  for (const auto &item :
       std::is_arithmetic_v<T> ? vector_components(text) : split(text, separator))
    {
      from_text(item, values.emplace_back());
      if constexpr (std::is_same_v<T, unsigned int>)
        if (values.back() == 0)
          throw std::invalid_argument("a number is 0");
    }
}

/// Split at the first colon of each.
void from_text(const std::string &text, TextPairs &pairs, char separator = ',');

template <typename T>
void from_text(const std::string &text, std::map<std::string, T> &map, const char separator = ',')
{
  TextPairs pairs;
  from_text(text, pairs, separator);
  map.clear();
  for (const auto &[key, value] : pairs)
    {
      if (map.count(key) > 0)
        throw std::invalid_argument("a key occurs twice");
      from_text(value, map[key]);
    }
}
} // namespace snug

#endif
