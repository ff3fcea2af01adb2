#ifndef snug_deck_entry_h
#define snug_deck_entry_h

#include <snug/deck/remarks.h>

#include <algorithm>
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
