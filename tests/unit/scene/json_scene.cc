#include <gtest/gtest.h>

#include "error_checks.h"

#include <snug/scene/json_scene.h>

using namespace snug;
using Json = nlohmann::json;

namespace {
const std::string json_text = R"json({
  "$schema": "snug.json",
  "Task": "optimize", "Dimension": 3, "Bodies": ["punch", "foundation"],
  "Body punch": {
    "Box corner": [0, 0.0, 1e0], "Box cells": [3, 4, 5],
    "Curved faces": "bottom: sphere 4; top: 0.1*min(x,y)",
    "Young's modulus": 210000.0, "Poisson's ratio": 0.3, "Supports": "left: x, front: y",
    "Pressure": "top: 100", "Traction": "top: 0 0 -5.5, left:  1 0  0"
  },
  "Body foundation": {
    "Box size": [2, 1, 1], "Box cells": [2, 2, 2], "Box grading": [1, 1, 0.5], "Refinements": 1,
    "Young's modulus": 7e4, "Supports": "bottom: xyz"
  },
  "Contact": {"Pairs": "punch.bottom: foundation.top"},
  "Shape": {"Basis": "Bezier patch", "Face": "foundation.top", "Control points": [3, 2],
            "Direction": [0, 0, 1], "Bounds": [-0.25, 0.25]},
  "Optimization": {"Constraints": "volume: initial"}
})json";

/// Return the error of the scene with a part of its text replaced.
InputError wrong(const std::string &from, const std::string &to)
{
  try
    {
      read_with({}, replaced(json_text, from, to));
    }
  catch (const InputError &error)
    {
      return error;
    }
  return InputError("none");
}
} // namespace

TEST(JsonScene, IsTheSceneOfTheParameterFile)
{
  EXPECT_EQ(printed(read_with({}, json_text)), printed(read_with({}, scene_text())));
  EXPECT_EQ(printed(read_with({"Body punch/Box cells=4, 4, 4"}, json_text)),
            printed(read_with({"Body punch/Box cells=4, 4, 4"}, scene_text())));
}

TEST(JsonScene, ErrorsHaveThePartsOfTheirMessages)
{
  const auto range = wrong("0.3", "0.7");
  EXPECT_STREQ(range.what(), "scene.prm: entry 'Body punch/Poisson's ratio' = '0.7': must be above "
                             "-1 and below 0.5");
  EXPECT_EQ(range.place().file, "scene.prm");
  EXPECT_EQ(range.wrong().entry, "Body punch/Poisson's ratio");
  EXPECT_EQ(range.wrong().value, "0.7");
  EXPECT_EQ(range.wrong().allowed, "must be above -1 and below 0.5");
  const auto name = wrong("\"Poisson's ratio\"", "\"Poissons ratio\"");
  EXPECT_EQ(name.wrong().entry, "Body punch/Poissons ratio");
  EXPECT_EQ(name.wrong().suggestion, "Poisson's ratio");
  EXPECT_EQ(wrong("\"Body punch\"", "\"Body punhc\"").wrong().suggestion, "Body punch");
  EXPECT_EQ(wrong("optimize", "optimise").wrong().suggestion, "optimize");
}

TEST(JsonScene, ValuesHaveTheTypesOfTheirEntries)
{
  const auto entry = [](const std::string &from, const std::string &to) {
    return wrong(from, to).wrong();
  };
  EXPECT_EQ(entry("210000.0", "\"210000\"").allowed, "must be a number in JSON");
  EXPECT_EQ(entry("\"Refinements\": 1", "\"Refinements\": 1.5").allowed.substr(0, 22),
            "must be a whole number");
  EXPECT_EQ(entry("[\"punch\", \"foundation\"]", "\"punch, foundation\"").entry, "Bodies");
  EXPECT_EQ(entry("[3, 4, 5]", "\"3, 4, 5\"").allowed, "must be a list of whole numbers in JSON");
  EXPECT_EQ(entry("[3, 4, 5]", "[3, \"4\", 5]").value, "[3,\"4\",5]");
  for (const std::string value : {"null", "[[1]]", "[true]", "[1, null]", "[\"a\", 1]"})
    EXPECT_EQ(entry("\"top: 100\"", value).entry, "Body punch/Pressure") << value;
  EXPECT_EQ(entry("\"optimize\"", "{}").entry, "Task");
}

TEST(JsonScene, MalformedTexts)
{
  EXPECT_TRUE(has(wrong("\"Dimension\": 3,", "\"Dimension\": 3 ").what(), "line 3, column"));
  EXPECT_STREQ(wrong("\"Dimension\": 3,", "\"Dimension\": 3, \"Task\": \"state\",").what(),
               "scene.prm: 'Task' is given twice");
  EXPECT_STREQ(wrong("\"Box size\"", "\"Box cells\"").what(),
               "scene.prm: 'Box cells' is given twice");
  EXPECT_TRUE(has(wrong("0.3", "NaN").what(), "parse error at line"));
}

TEST(JsonScene, SchemaHasTypesRangesAndUnits)
{
  std::ostringstream out;
  scene::print_schema(out);
  const auto schema = Json::parse(out.str());
  EXPECT_EQ(schema["properties"]["Task"]["enum"], Json({"state", "sensitivity", "optimize"}));
  EXPECT_EQ(schema["properties"]["Dimension"]["enum"], Json({2, 3}));
  const auto body = schema["patternProperties"]["^Body .+$"];
  EXPECT_EQ(body["additionalProperties"], false);
  EXPECT_EQ(body["properties"]["Poisson's ratio"]["exclusiveMaximum"], 0.5);
  EXPECT_EQ(body["properties"]["Refinements"]["type"], "integer");
  EXPECT_EQ(body["properties"]["Box cells"]["items"]["minimum"], 1);
  EXPECT_EQ(body["properties"]["Young's modulus"]["x-unit"], "force/length^2");
  // Numbers of load cases may be formulas of the case number.
  const auto load_case = schema["patternProperties"]["^Load case .+$"]["properties"];
  EXPECT_EQ(load_case["Weight"]["anyOf"][1]["type"], "string");
}
