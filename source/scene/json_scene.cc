#include <snug/scene/json_scene.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace snug::scene {
namespace {
using Json = nlohmann::ordered_json;

/// Return the shortest text from which the same number is read; 4 for 4.0.
std::string number_text(const Json &number)
{
  const double largest_exact = 9e15;
  const double value         = number.get<double>();
  return number.is_number_float() && std::trunc(value) == value && std::abs(value) < largest_exact
           ? std::to_string(static_cast<long long>(value))
           : number.dump();
}

/// Parse a text. @throws InputError also for an object with two members of the same name.
Json parse(const std::string &text, const Place &place)
{
  std::vector<std::set<std::string>> names; // of the objects that contain the present place
  const auto check = [&](int /*depth*/, const Json::parse_event_t event, const Json &parsed) {
    using Event = Json::parse_event_t;
    if (event == Event::object_start)
      names.emplace_back();
    if (event == Event::object_end)
      names.pop_back();
    if (event == Event::key && !names.back().insert(parsed.get<std::string>()).second)
      throw InputError("'" + quotable(parsed.get<std::string>()) + "' is given twice", place);
    return true;
  };
  try
    {
      return Json::parse(text, check);
    }
  catch (const Json::exception &error)
    {
      const std::string message = error.what();
      throw InputError(message.substr(message.find("] ") + 2), place);
    }
}

Statement statement(const std::string &section,
                    const std::string &name,
                    const Json        &value,
                    const Place       &place)
{
  const auto found = entry_value(value);
  if (found)
    return {section, name, found->first, place, found->second};
  const auto path = Statement{section, name, "", place}.path();
  throw InputError(WrongEntry{quotable(path), quotable(value.dump()),
                              "must be a text, a number, true, false, or a list of numbers or of "
                              "texts",
                              ""},
                   place);
}
} // namespace

bool is_json(const std::string &text)
{
  const auto first = text.find_first_not_of(" \t\r\n");
  return first != std::string::npos && text[first] == '{';
}

std::vector<Statement> parse_json(const std::string &text, const std::string &file)
{
  const Place            place = {file};
  const Json             scene = parse(text, place);
  std::vector<Statement> statements;
  for (const auto &[name, value] : scene.items())
    if (value.is_object())
      {
        statements.push_back({name, "", "", place});
        for (const auto &[entry, of_entry] : value.items())
          statements.push_back(statement(name, entry, of_entry, place));
      }
    else if (name != "$schema")
      statements.push_back(statement("", name, value, place));
  return statements;
}

std::optional<std::pair<std::string, ValueType>> entry_value(const Json &value)
{
  if (value.is_string())
    return {{value.get<std::string>(), ValueType::text}};
  if (value.is_number())
    return {{number_text(value), ValueType::number}};
  if (value.is_boolean())
    return {{value.dump(), ValueType::boolean}};
  if (!value.is_array())
    return {};
  // An empty list is one of names and of numbers.
  const bool  are_numbers = !value.empty() && value.front().is_number();
  std::string text;
  for (const Json &part : value)
    {
      if (are_numbers ? !part.is_number() : !part.is_string())
        return {};
      text += (text.empty() ? "" : ", ") + entry_value(part)->first;
    }
  return {{text, are_numbers ? ValueType::numbers : ValueType::names}};
}
} // namespace snug::scene
