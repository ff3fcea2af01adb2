#include <snug/scene/json_scene.h>
#include <snug/scene/read_scene.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <sstream>

namespace snug::scene {
namespace {
using Json = nlohmann::ordered_json;

/// Return the unit in the sentence "Units: length." of a meaning, or "".
std::string unit_in(const std::string &meaning)
{
  const std::string begin = "Units: ";
  const auto        at    = meaning.find(begin);
  return at == std::string::npos
           ? ""
           : meaning.substr(at + begin.size(), meaning.find('.', at) - at - begin.size());
}

/// Return the JSON value of a text of a parameter file. Words in place of numbers stay texts.
Json json_value(const ValueType type, const std::string &text)
{
  if (type == ValueType::boolean || type == ValueType::number || type == ValueType::whole_number)
    return Json::parse(text, nullptr, false).is_discarded() ? Json(text) : Json::parse(text);
  if (type == ValueType::text)
    return text;
  const bool are_names = type == ValueType::names;
  Json       list      = Json::array();
  for (const auto &part : are_names ? split(text, ',') : vector_components(text))
    list.push_back(json_value(are_names ? ValueType::text : ValueType::number, part));
  return list;
}

Json type_names(const ValueType type)
{
  switch (type)
    {
      case ValueType::number:
      case ValueType::numbers:
        return "number";
      case ValueType::whole_number:
      case ValueType::whole_numbers:
        return "integer";
      case ValueType::boolean:
        return "boolean";
      case ValueType::names:
        return "string";
      default:
        return {"string", "number", "boolean"};
    }
}

/// Add the bounds of numbers, which do not concern values of other types.
void add_interval(const Interval &interval, const double lower, Json &to)
{
  if (interval.lower >= lower && std::isfinite(interval.lower))
    to[interval.has_lower ? "minimum" : "exclusiveMinimum"] = interval.lower;
  else if (std::isfinite(lower))
    to["minimum"] = lower;
  if (std::isfinite(interval.upper))
    to[interval.has_upper ? "maximum" : "exclusiveMaximum"] = interval.upper;
}

/// Return the schema of the values of an entry.
Json value_schema(const Entries::Description &entry)
{
  const auto &form    = entry.form;
  const bool  is_list = form.type == ValueType::numbers || form.type == ValueType::whole_numbers ||
                       form.type == ValueType::names;
  Json value = {{"type", type_names(form.type)}};
  if (!form.choices.empty() && form.type != ValueType::boolean)
    {
      Json choices = Json::array();
      auto names   = form.choices;
      for (const auto &[former, name] : form.renamed)
        names.push_back(former);
      for (const auto &name : names)
        {
          if (form.type == ValueType::text)
            choices.push_back(name);
          const auto parsed = Json::parse(name, nullptr, false);
          if (parsed.is_number() || parsed.is_boolean())
            choices.push_back(parsed);
        }
      return {{"enum", choices}};
    }
  const double least = form.type == ValueType::whole_number    ? 0.
                       : form.type == ValueType::whole_numbers ? 1.
                                                               : -HUGE_VAL;
  add_interval(form.interval, least, value);
  // Numbers of load cases may be formulas of the case number.
  if (entry.section.rfind("Load case", 0) == 0 && form.type != ValueType::text)
    value = {{"anyOf",
              {is_list ? Json{{"type", "array"}, {"items", value}} : value, {{"type", "string"}}}}};
  else if (is_list)
    value = {{"type", "array"}, {"items", value}};
  if (!form.per_dimension.empty())
    value["maxItems"] = 3;
  return value;
}

Json entry_schema(const Entries::Description &entry)
{
  Json        schema   = value_schema(entry);
  std::string meaning  = entry.meaning;
  Json        examples = Json::array();
  for (const auto &value : entry.form.meanings)
    {
      meaning += "\n\n" + value.name + ": " + value.meaning;
      if (entry.form.choices.empty())
        examples.push_back(value.name);
    }
  schema["description"] = meaning;
  schema["default"]     = json_value(entry.form.type, reference_default(entry));
  if (!examples.empty())
    schema["examples"] = examples;
  if (const auto unit = unit_in(entry.meaning); !unit.empty())
    schema["x-unit"] = unit;
  if (entry.form.choices.empty())
    schema["x-form"] = entry.form.allowed;
  return schema;
}

/// Return the pattern of the names of subsections, or "" if the subsection has no name of its own.
std::string pattern_of(const std::string &section)
{
  if (section == "Shape")
    return "^Shape( .+)?$";
  if (section == "Pair SLAVE: MASTER")
    return "^Pair .+: .+$";
  const std::string name = " NAME";
  const auto        at   = section.size() - std::min(section.size(), name.size());
  return section.substr(at) == name ? "^" + section.substr(0, at) + " .+$" : "";
}
} // namespace

void print_schema(std::ostream &out)
{
  Scene      scene;
  const auto entries = reference_entries(scene);
  Json       schema  = {{"$schema", "http://json-schema.org/draft-07/schema#"},
                        {"title", "Model of Snug"},
                        {"type", "object"},
                        {"properties", {{"$schema", {{"type", "string"}}}}},
                        {"patternProperties", Json::object()},
                        {"additionalProperties", false}};
  for (const auto &section : entries.sections())
    {
      Json properties = Json::object();
      for (const auto &entry : entries.descriptions())
        if (entry.section == section.name)
          properties[entry.name] = entry_schema(entry);
      if (section.name.empty())
        schema["properties"].update(properties);
      else
        (pattern_of(section.name).empty()
           ? schema["properties"][section.name]
           : schema["patternProperties"][pattern_of(section.name)]) = {
          {"type", "object"},
          {"description", section.meaning},
          {"properties", properties},
          {"additionalProperties", false}};
    }
  out << schema.dump(2) << '\n';
}
} // namespace snug::scene
