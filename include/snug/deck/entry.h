#ifndef snug_deck_entry_h
#define snug_deck_entry_h

#include <snug/deck/remarks.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace snug::deck {
/// Entry of a parameter file, with the lines of the deck from which it comes.
struct Entry
{
  std::string                name, value = {};
  std::vector<unsigned long> lines = {};

  void add(const std::string &item, const std::string &separator = ", ")
  {
    value += (value.empty() ? "" : separator) + item;
  }

  void add_line(const unsigned long line)
  {
    if (std::find(lines.begin(), lines.end(), line) == lines.end())
      lines.push_back(line);
  }
};

/// Add an item to an entry of a list, which is made if it is not there.
inline void add_item(std::vector<Entry>               &entries,
                     const std::string                &name,
                     const std::string                &item,
                     const std::vector<unsigned long> &lines)
{
  auto entry = std::find_if(entries.begin(), entries.end(),
                            [&](const Entry &other) { return other.name == name; });
  if (entry == entries.end())
    entry = entries.insert(entries.end(), {name});
  entry->add(item);
  for (const auto line : lines)
    entry->add_line(line);
}

/// Return a number with 12 digits, which drops round-off, and without the sign of zero. A number
/// below 1e-12 of @p size is 0.
inline double rounded(const double number, const double size = 0.)
{
  std::ostringstream text;
  text << std::setprecision(12) << (std::abs(number) < 1e-12 * size ? 0. : number);
  return std::stod(text.str()) + 0.;
}

/// Write an entry of a subsection behind a comment with its lines, unless it has no value.
inline void write(std::ostream &out, const Entry &entry)
{
  if (entry.value.empty())
    return;
  if (!entry.lines.empty())
    out << "  # " << list_of_lines(entry.lines) << '\n';
  out << "  set " << entry.name << " = " << entry.value << '\n';
}
} // namespace snug::deck

#endif
