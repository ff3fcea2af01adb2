#ifndef snug_scene_json_scene_h
#define snug_scene_json_scene_h

#include <snug/base/statements.h>

#include <nlohmann/json.hpp>

#include <iosfwd>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace snug::scene {
/// Return whether the text of a scene is JSON: its first character is '{'.
bool is_json(const std::string &text);

/**
 * Return the statements of a scene in JSON, an object with the entries outside of subsections and
 * an object for each subsection:
 *
 *   {"Task": "state", "Bodies": ["a", "b"], "Body a": {"Box cells": [4, 4], "Fixed": true}}
 *
 * The member "$schema", which editors use, is ignored.
 * @throws InputError naming @p file if the text has another form, or an entry twice.
 */
std::vector<Statement> parse_json(const std::string &text, const std::string &file);

/// Return a JSON value as the text of a parameter file, and its type. The value may be a string, a
/// number, true, false, or a list of numbers or of strings; otherwise there is no result.
std::optional<std::pair<std::string, ValueType>> entry_value(const nlohmann::ordered_json &value);

/// Write the JSON Schema (draft-07) of scenes in JSON: types, ranges, choices, defaults, units and
/// meanings of all entries.
void print_schema(std::ostream &out);
} // namespace snug::scene

#endif
