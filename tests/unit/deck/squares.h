#ifndef snug_tests_unit_deck_squares_h
#define snug_tests_unit_deck_squares_h

#include <snug/base/errors.h>
#include <snug/deck/translation.h>
#include <snug/scene/read_scene.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace snug {
/// Two squares of different materials in one element set, a third square without contact to them,
/// and a step. @p keywords stand before the step, @p loads in the step.
inline std::string squares(const std::string &keywords, const std::string &loads)
{
  return "*NODE\n1, 0, 0\n2, 1, 0\n3, 2, 0\n4, 0, 1\n5, 1, 1\n6, 2, 1\n"
         "11, 0, 2\n12, 1, 2\n13, 0, 3\n14, 1, 3\n"
         "*ELEMENT, TYPE=CPE4, ELSET=left\n1, 1, 2, 5, 4\n"
         "*ELEMENT, TYPE=CPE4, ELSET=right\n2, 2, 3, 6, 5\n"
         "*ELEMENT, TYPE=CPE4, ELSET=lid\n3, 11, 12, 14, 13\n"
         "*ELSET, ELSET=base\nleft, right\n"
         "*NSET, NSET=bottom\n1, 2, 3\n*NSET, NSET=corner\n1\n*NSET, NSET=\"lower left\"\n1, 2\n"
         "*SURFACE, NAME=top\nlid, S3\n*SURFACE, NAME=under\nlid, S1\n*SURFACE, NAME=over\nbase, "
         "S3\n"
         "*MATERIAL, NAME=steel\n*ELASTIC\n2.1e5, 0.3\n*DENSITY\n7.8e-9\n"
         "*MATERIAL, NAME=rubber\n*ELASTIC\n10, 0.45\n*DENSITY\n1e-9\n"
         "*SOLID SECTION, ELSET=left, MATERIAL=STEEL\n3.\n"
         "*SOLID SECTION, ELSET=right, MATERIAL=rubber\n3.\n"
         "*SOLID SECTION, ELSET=lid, MATERIAL=steel\n3.\n" +
         keywords + "*STEP\n*STATIC\n" + loads + "*END STEP\n";
}

inline scene::Scene scene_of(const deck::Translation &translation, const std::string &deck)
{
  return scene::read_scene(
    {"deck.inp", translation.text, {}, "", [&](const std::string &) { return deck; }});
}

inline bool lists(const deck::Translation &translation, const std::string &text)
{
  return std::any_of(translation.lacking.begin(), translation.lacking.end(),
                     [&](const auto &part) { return part.text.find(text) != std::string::npos; });
}

inline bool replaces(const deck::Translation &translation, const std::string &text)
{
  return std::any_of(translation.replaced.begin(), translation.replaced.end(),
                     [&](const auto &line) { return line.find(text) != std::string::npos; });
}

using Pairs = std::vector<std::pair<std::string, std::string>>;
} // namespace snug

#endif
