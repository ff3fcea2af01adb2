#ifndef snug_unit_scene_error_checks_h
#define snug_unit_scene_error_checks_h

#include <gtest/gtest.h>

#include "scene_text.h"

inline bool has(const std::string &text, const std::string &part)
{
  return text.find(part) != std::string::npos;
}
/// One wrong entry: its path, its value, and what the message must say.
struct Wrong
{
  std::string path, value, says;
};
/// The error names where, entry and value in one line, and says what counts.
inline void expect_error(const Wrong &wrong, const std::vector<std::string> &before = {})
{
  auto sets = before;
  sets.push_back(wrong.path + "=" + wrong.value);
  const std::string message = error_of(sets);
  EXPECT_TRUE(has(message, "--set: ")) << message;
  EXPECT_TRUE(has(message, "entry '" + wrong.path + "' = '" + wrong.value + "': "))
    << wrong.path << " = " << wrong.value << ": " << message;
  EXPECT_TRUE(has(message, wrong.says)) << message << "\n" << wrong.says;
  EXPECT_FALSE(has(message, "\n")) << message;
  EXPECT_FALSE(has(message, "---")) << message;
}

#endif
