#ifndef snug_base_values_h
#define snug_base_values_h

#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

/// Values as text from which exactly the same value is read. Lists are "a, b", pairs are "key:
/// value", and maps are lists of pairs.
namespace snug {
using TextMap   = std::map<std::string, std::string>;
using VectorMap = std::map<std::string, std::vector<double>>;
using TextPairs = std::vector<std::pair<std::string, std::string>>;

/// Name of a choice in parameter files, and its meaning.
struct Name
{
  std::string name, meaning = {};
  std::string former = {}; ///< name of the choice in earlier versions, which is read as well
};
using Names = std::vector<Name>;

/// Return @p text without white space at its ends.
std::string trim(const std::string &text);

/// Return the trimmed parts of a text. Separators within parentheses, as of max(x, y), are not
/// separators.
std::vector<std::string> split(const std::string &text, char separator);

/// Return the parts of "0 0 -5*max(x, y)". Blanks within parentheses do not separate parts.
std::vector<std::string> components(const std::string &text);

/// Return components separated by commas or, if there is no comma, by blanks.
/// @throws std::invalid_argument for "0,5, 1" and "-0,5", where a comma may be a decimal point.
std::vector<std::string> vector_components(const std::string &text);

/// Return "; write 0.15 instead of 0,15" for the first number of @p text that may have a decimal
/// comma, or "" if there is none. Commas within parentheses separate arguments.
std::string decimal_point_hint(const std::string &text);

/// Return a number and its noun: "1 face", "2 faces". @p plural is the noun for all numbers except
/// 1; empty: @p noun with an s.
std::string counted(std::size_t n, const std::string &noun, const std::string &plural = "");

std::string to_text(double value);
std::string to_text(unsigned int value);
std::string to_text(bool value);
std::string to_text(const std::string &value);

/// @throws std::invalid_argument if @p text is malformed, like all from_text()
void from_text(const std::string &text, double &value);
void from_text(const std::string &text, unsigned int &value);
void from_text(const std::string &text, bool &value);
void from_text(const std::string &text, std::string &value);

/// Return the name of a value. An enum that counts from 0 has a function names(E), which returns
/// the Names of its values in their order.
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

/// Return the text of a value. "auto" stands for no value.
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

/// Return "key: value"; vectors have their components separated by blanks.
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

/// Read a list. Numbers may be separated by blanks too. Counts are at least 1.
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

/// Read pairs, which are split at the first colon of each.
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
