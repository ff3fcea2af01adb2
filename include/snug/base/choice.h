#ifndef snug_base_choice_h
#define snug_base_choice_h

#include <snug/base/errors.h>
#include <snug/base/values.h>

#include <functional>
#include <string>
#include <vector>

namespace snug {
/**
 * One row of a factory table: a name, its meaning in one line with units, and the function that
 * makes the object. The table is the only place that lists the members of a family. It provides
 * the choices of the parameter file, the help text and the constructor.
 */
template <typename Make>
struct Choice : Name
{
  Choice(std::string              the_name,
         std::string              the_meaning,
         std::function<Make>      how,
         std::vector<std::string> read = {})
    : Name{std::move(the_name), std::move(the_meaning)}
    , make(std::move(how))
    , entries(std::move(read))
  {}

  std::function<Make> make;
  /// names of the entries that it reads, if those of a family differ
  std::vector<std::string> entries;
};

template <typename Make>
using ChoiceTable = std::vector<Choice<Make>>;

template <typename Make>
Names names(const ChoiceTable<Make> &table)
{
  return Names(table.begin(), table.end());
}

/// Return the row called @p name. @throws InputError listing the existing names.
template <typename Make>
const Choice<Make> &choose(const ChoiceTable<Make> &table, const std::string &name)
{
  std::string known;
  for (const auto &choice : table)
    {
      if (choice.name == name)
        return choice;
      known += (known.empty() ? "" : ", ") + choice.name;
    }
  throw InputError("'" + name + "' is not one of " + known);
}
} // namespace snug

#endif
