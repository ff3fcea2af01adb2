#include <snug/base/units.h>

#include <array>
#include <utility>

namespace snug {
namespace {
/// Units of stress with names of their own: {length, force, stress}.
constexpr std::array<std::array<const char *, 3>, 8> stresses{{{{"mm", "N", "MPa"}},
                                                               {{"mm", "kN", "GPa"}},
                                                               {{"m", "N", "Pa"}},
                                                               {{"m", "kN", "kPa"}},
                                                               {{"m", "MN", "MPa"}},
                                                               {{"um", "uN", "MPa"}},
                                                               {{"in", "lbf", "psi"}},
                                                               {{"in", "kip", "ksi"}}}};

/// Replace all occurrences of @p word.
std::string replaced(std::string text, const std::string &word, const std::string &by)
{
  for (std::size_t at = text.find(word); at != std::string::npos;
       at             = text.find(word, at + by.size()))
    text.replace(at, word.size(), by);
  return text;
}
} // namespace

Units::Units(const std::vector<std::string> &names)
{
  if (names.size() == 2)
    {
      length = names[0];
      force  = names[1];
    }
}

std::string Units::name(const std::string &expression) const
{
  if (!are_named())
    return "";
  std::string stress;
  for (const auto &known : stresses)
    if (length == known[0] && force == known[1])
      stress = known[2];
  const std::string text =
    stress.empty() ? expression : replaced(expression, "force/length^2", stress);
  return replaced(replaced(text, "force", force), "length", length);
}

std::string Units::after_number(const std::string &expression) const
{
  const std::string unit = name(expression);
  return unit.empty() ? "" : " " + unit;
}
} // namespace snug
