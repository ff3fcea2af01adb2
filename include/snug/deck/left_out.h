#ifndef snug_deck_left_out_h
#define snug_deck_left_out_h

#include <map>
#include <string>
#include <vector>

namespace snug::deck {
/// Return "line 3", "lines 3 and 7", or, for more than 8 lines, "lines 3, 4, 5, ..., 90 (40
/// lines)".
std::string list_of_lines(const std::vector<unsigned long> &lines);

/// This class collects the keywords that are not translated, by kind, with their lines in the deck.
class LeftOut
{
public:
  void add(const std::string &what, unsigned long line);

  /// Return one line for each kind, "*NODE FILE (lines 30 and 41)", in the order of the deck.
  std::vector<std::string> lines() const;

private:
  std::vector<std::string>                          order;
  std::map<std::string, std::vector<unsigned long>> lines_of;
};
} // namespace snug::deck

#endif
