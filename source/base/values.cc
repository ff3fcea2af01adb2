#include <snug/base/values.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <limits>

namespace snug {
namespace {
/// Return the number that @p read, strtod or strtol, reads from the whole text. The text must
/// consist of @p digits: nan, inf and hexadecimal numbers are not allowed.
template <typename Read>
auto number(const std::string &text, const char *digits, const Read &read)
{
  char *end         = nullptr;
  errno             = 0;
  const auto result = read(text.c_str(), &end);
  if (text.empty() || text.find_first_not_of(digits) != std::string::npos || *end != '\0' ||
      errno != 0)
    throw std::invalid_argument("no number");
  return result;
}

/// Return @p text without what is within parentheses.
std::string outside_of_parentheses(const std::string &text)
{
  std::string result;
  int         depth = 0;
  for (const char c : text)
    {
      depth -= c == ')';
      if (depth <= 0)
        result += c;
      depth += c == '(';
    }
  return result;
}
} // namespace

std::string trim(const std::string &text)
{
  constexpr const char *white_space = " \t\r\n\v\f";
  const auto            first       = text.find_first_not_of(white_space);
  if (first == std::string::npos)
    return "";
  return text.substr(first, text.find_last_not_of(white_space) + 1 - first);
}

std::vector<std::string> split(const std::string &text, const char separator)
{
  std::vector<std::string> parts(1);
  int                      depth = 0;
  for (const char c : text)
    {
      depth += (c == '(') - (c == ')');
      if (c == separator && depth <= 0)
        parts.emplace_back();
      else
        parts.back() += c;
    }
  for (auto &part : parts)
    part = trim(part);
  if (parts.back().empty())
    parts.pop_back();
  return parts;
}

std::vector<std::string> components(const std::string &text)
{
  std::vector<std::string> result;
  for (const auto &part : split(text, ' '))
    if (!part.empty())
      result.push_back(part);
  return result;
}

std::string decimal_point_hint(const std::string &text)
{
  const std::string digits = "0123456789", line = outside_of_parentheses(text);
  for (auto i = line.find_first_of(digits); i != std::string::npos;)
    {
      const auto  end    = std::min(line.find_first_not_of(digits + ".,", i), line.size());
      std::string number = line.substr(i, end - i);
      // A comma before a blank separates numbers.
      if (number.back() == ',' && (end == line.size() || line[end] == ' '))
        number.pop_back();
      // 1,2,3 and 1,2.5 are lists.
      const auto comma = number.find_first_of(",.");
      if (comma != std::string::npos && comma == number.find_last_of(",.") && number[comma] == ',')
        return "; write " + number.substr(0, comma) + "." + number.substr(comma + 1) +
               " instead of " + number;
      i = line.find_first_of(digits, end);
    }
  return "";
}

std::vector<std::string> vector_components(const std::string &text)
{
  const auto parts = split(text, ',');
  // Lists separate all of their numbers alike, and nobody writes a zero with a sign.
  if ((outside_of_parentheses(text).find(", ") != std::string::npos || text.rfind("-0,", 0) == 0) &&
      !decimal_point_hint(text).empty())
    throw std::invalid_argument("a comma may be a decimal point");
  return parts.size() > 1 ? parts : components(text);
}

std::string counted(const std::size_t n, const std::string &noun, const std::string &plural)
{
  const std::string several = plural.empty() ? noun + "s" : plural;
  return std::to_string(n) + " " + (n == 1 ? noun : several);
}

std::string to_text(const double value)
{
  char       buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof(buffer), value).ptr;
  return std::string(buffer, end);
}

std::string to_text(const unsigned int value)
{
  return std::to_string(value);
}

std::string to_text(const bool value)
{
  return value ? "true" : "false";
}

std::string to_text(const std::string &value)
{
  return value;
}

std::string to_text(const TextPairs &pairs, const char separator)
{
  std::vector<std::string> items;
  for (const auto &[key, value] : pairs)
    items.push_back(key + ": " + value);
  return to_text(items, separator);
}

void from_text(const std::string &text, double &value)
{
  value = number(text, "0123456789+-.eE", std::strtod);
}

void from_text(const std::string &text, unsigned int &value)
{
  const long whole = number(text, "0123456789+-", [](const char *begin, char **end) {
    return std::strtol(begin, end, 10);
  });
  if (whole < 0 || whole > std::numeric_limits<int>::max())
    throw std::invalid_argument("no whole number");
  value = static_cast<unsigned int>(whole);
}

void from_text(const std::string &text, bool &value)
{
  value = text == "true";
}

void from_text(const std::string &text, std::string &value)
{
  value = text;
}

void from_text(const std::string &text, TextPairs &pairs, const char separator)
{
  pairs.clear();
  for (const auto &item : split(text, separator))
    {
      const auto colon = item.find(':');
      pairs.emplace_back(trim(item.substr(0, colon)),
                         colon == std::string::npos ? "" : trim(item.substr(colon + 1)));
      if (pairs.back().first.empty() || pairs.back().second.empty())
        throw std::invalid_argument("no 'key: value'");
    }
}
} // namespace snug
