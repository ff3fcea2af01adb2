#include <snug/scene/values.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace snug::scene {
namespace {
using namespace dealii;

template <typename Pattern>
std::shared_ptr<const Patterns::PatternBase> shared(const Pattern &pattern)
{
  return std::make_shared<Pattern>(pattern);
}

/// The trimmed parts of a text; separators within parentheses, as of
/// max(x, y), do not count.
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
    part = Utilities::trim(part);
  if (parts.back().empty())
    parts.pop_back();
  return parts;
}

template <typename T>
std::string joined_values(const std::vector<T> &values, const std::string &separator)
{
  std::string text;
  for (const auto &value : values)
    text += (text.empty() ? "" : separator) + to_text(value);
  return text;
}

/// "key: value, key: value".
template <typename Pairs, typename Write>
std::string joined_pairs(const Pairs &pairs, const char separator, const Write &write)
{
  std::string text;
  for (const auto &[key, value] : pairs)
    text += (text.empty() ? "" : std::string(1, separator) + " ") + key + ": " + write(value);
  return text;
}

/// The pairs of a text, split at the first colon of each.
TextPairs split_pairs(const std::string &text, const char separator)
{
  TextPairs pairs;
  for (const auto &item : split(text, separator))
    {
      const auto colon = item.find(':');
      if (colon == std::string::npos)
        throw std::invalid_argument("no ':'");
      pairs.emplace_back(Utilities::trim(item.substr(0, colon)),
                         Utilities::trim(item.substr(colon + 1)));
      if (pairs.back().first.empty() || pairs.back().second.empty())
        throw std::invalid_argument("nothing beside ':'");
    }
  return pairs;
}

/// Pairs whose keys differ, values converted by @p read.
template <typename Map, typename Read>
void read_map(const std::string &text, const char separator, Map &map, const Read &read)
{
  Map result;
  for (const auto &[key, value] : split_pairs(text, separator))
    if (!result.emplace(key, read(value)).second)
      throw std::invalid_argument("a key occurs twice");
  map = result;
}

template <typename T>
void read_list(const std::string &text, std::vector<T> &values)
{
  std::vector<T> result;
  for (const auto &item : split(text, ','))
    from_text(item, result.emplace_back());
  values = result;
}

const std::vector<std::pair<Task, std::string>> task_names = {{Task::state, "state"},
                                                              {Task::sensitivity, "sensitivity"},
                                                              {Task::optimize, "optimize"}};

constexpr int largest = std::numeric_limits<int>::max();
} // namespace

Form form_of(double)
{
  return {shared(Patterns::Double()), "a number", {}};
}

Form form_of(unsigned int)
{
  return {shared(Patterns::Integer(0, largest)), "a whole number, 0 or larger", {}};
}

Form form_of(bool)
{
  return {shared(Patterns::Bool()), "true or false", {"true", "false"}};
}

Form form_of(const std::string &)
{
  return anything("text");
}

Form form_of(const std::vector<double> &)
{
  return {shared(Patterns::List(Patterns::Double())), "numbers separated by commas", {}};
}

Form form_of(const std::vector<unsigned int> &)
{
  return {shared(Patterns::List(Patterns::Integer(1, largest))),
          "whole numbers of at least 1 separated by commas",
          {}};
}

Form form_of(const NumberMap &)
{
  return pairs("a list 'boundary: number, ...' of different boundaries");
}

Form form_of(const VectorMap &)
{
  return pairs("a list 'boundary: x y z, ...' of different boundaries and "
               "vectors, components separated by blanks");
}

Form choice(const std::string &names)
{
  const auto choices = split(names, '|');
  return {shared(Patterns::Selection(names)),
          (choices.size() > 1 ? "one of " : "") + joined_values(choices, ", "), choices};
}

Form pairs(const std::string &allowed, const char separator)
{
  const Patterns::List pattern(Patterns::Anything(), 0, Patterns::List::max_int_value,
                               std::string(1, separator));
  return {shared(pattern), allowed, {}};
}

Form anything(const std::string &allowed)
{
  return {shared(Patterns::Anything()), allowed, {}};
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

std::string to_text(const Task value)
{
  for (const auto &[task, name] : task_names)
    if (task == value)
      return name;
  return "";
}

std::string to_text(const std::vector<double> &values)
{
  return joined_values(values, ", ");
}

std::string to_text(const std::vector<unsigned int> &values)
{
  return joined_values(values, ", ");
}

std::string to_text(const std::vector<std::string> &values)
{
  return joined_values(values, ", ");
}

std::string to_text(const NumberMap &map)
{
  return joined_pairs(map, ',', [](const double v) { return to_text(v); });
}

std::string to_text(const VectorMap &map)
{
  return joined_pairs(map, ',', [](const std::vector<double> &v) { return joined_values(v, " "); });
}

std::string to_text(const TextMap &map, const char separator)
{
  return joined_pairs(map, separator, [](const std::string &v) { return v; });
}

std::string to_text(const TextPairs &pairs, const char separator)
{
  return joined_pairs(pairs, separator, [](const std::string &v) { return v; });
}

bool all_finite(const std::vector<double> &values)
{
  return std::all_of(values.begin(), values.end(), [](const double v) { return std::isfinite(v); });
}

std::vector<std::string> components(const std::string &text)
{
  std::vector<std::string> result;
  for (const auto &part : split(text, ' '))
    if (!part.empty())
      result.push_back(part);
  return result;
}

std::vector<std::string> vector_components(const std::string &text)
{
  const auto parts = split(text, ',');
  return parts.size() > 1 ? parts : components(text);
}

void from_text(const std::string &text, double &value)
{
  if (!Patterns::Double().match(text))
    throw std::invalid_argument("no number");
  value = Utilities::string_to_double(text);
}

void from_text(const std::string &text, unsigned int &value)
{
  if (!Patterns::Integer(0, largest).match(text))
    throw std::invalid_argument("no whole number");
  value = Utilities::string_to_int(text);
}

void from_text(const std::string &text, bool &value)
{
  value = text == "true" || text == "yes";
}

void from_text(const std::string &text, std::string &value)
{
  value = text;
}

void from_text(const std::string &text, Task &value)
{
  for (const auto &[task, name] : task_names)
    if (name == text)
      value = task;
}

void from_text(const std::string &text, std::vector<double> &values)
{
  read_list(text, values);
}

void from_text(const std::string &text, std::vector<unsigned int> &values)
{
  read_list(text, values);
}

void from_text(const std::string &text, NumberMap &map)
{
  read_map(text, ',', map, [](const std::string &item) {
    double value;
    from_text(item, value);
    return value;
  });
}

void from_text(const std::string &text, VectorMap &map)
{
  read_map(text, ',', map, [](const std::string &item) {
    std::vector<double> vector;
    for (const auto &component : components(item))
      from_text(component, vector.emplace_back());
    return vector;
  });
}

void from_text(const std::string &text, TextMap &map, const char separator)
{
  read_map(text, separator, map, [](const std::string &v) { return v; });
}

void from_text(const std::string &text, TextPairs &pairs, const char separator)
{
  pairs = split_pairs(text, separator);
}
} // namespace snug::scene
