#ifndef snug_base_choice_h
#define snug_base_choice_h

#include <snug/base/errors.h>

#include <functional>
#include <string>
#include <vector>

namespace snug {
/**
 * One row of a factory table. The table is the only place that lists the
 * members of a family: it feeds the choices of the parameter file, the help
 * text and the constructor.
 */
template <typename Make>
struct Choice
{
  Choice(std::string              the_name,
         std::string              the_meaning,
         std::function<Make>      how,
         std::vector<std::string> read = {})
    : name(std::move(the_name))
    , meaning(std::move(the_meaning))
    , make(std::move(how))
    , entries(std::move(read))
  {}

  std::string         name;
  std::string         meaning; ///< one line, with units
  std::function<Make> make;
  /// names of the entries it reads, where those of a family differ
  std::vector<std::string> entries;
};

template <typename Make>
using ChoiceTable = std::vector<Choice<Make>>;

/// "a|b|c", the pattern of a ParameterHandler selection.
template <typename Make>
std::string names(const ChoiceTable<Make> &table)
{
  std::string list;
  for (const auto &choice : table)
    list += (list.empty() ? "" : "|") + choice.name;
  return list;
}

/// "a: meaning; b: meaning", the help text of the entry.
template <typename Make>
std::string meanings(const ChoiceTable<Make> &table)
{
  std::string list;
  for (const auto &choice : table)
    list += (list.empty() ? "" : "; ") + choice.name + ": " + choice.meaning;
  return list;
}

/// The row called @p name. @throws InputError listing the names there are.
template <typename Make>
const Choice<Make> &choose(const ChoiceTable<Make> &table, const std::string &name)
{
  for (const auto &choice : table)
    if (choice.name == name)
      return choice;
  throw InputError("'" + name + "' is none of " + names(table));
}
} // namespace snug

#endif
