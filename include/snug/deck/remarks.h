#ifndef snug_deck_remarks_h
#define snug_deck_remarks_h

#include <map>
#include <string>
#include <vector>

namespace snug::deck {
/// Return "line 3", "lines 3 and 7", or, for more than 8 lines, "lines 3, 4, 5, ..., 90 (40
/// lines)".
std::string list_of_lines(const std::vector<unsigned long> &lines);

/// Texts, each with the lines of a deck to which it applies, in the order of the deck.
class LinesOfTexts
{
public:
  void add(const std::string &text, unsigned long line);

  /// Return the texts with their lines, "*NODE FILE (lines 30 and 41)".
  std::vector<std::string> all() const;

private:
  std::vector<std::string>                          order;
  std::map<std::string, std::vector<unsigned long>> lines_of;
};

/// A part of the model of a deck that its translation lacks.
struct LackingPart
{
  std::string kind; ///< by which --leave-out accepts it: the keyword in lower case, "contact pair"
  std::string text; ///< "*CONTACT PAIR of a body with itself (line 3)"

  template <class Archive>
  void serialize(Archive &archive, const unsigned int /*version*/)
  {
    archive & kind & text;
  }
};

/// The parts of a deck that its translation does not take over.
class Remarks
{
public:
  /// Note a keyword or an option that changes no result: requests for output, controls, names.
  void not_needed(const std::string &what, unsigned long line) { unneeded.add(what, line); }

  /// Note a part of the model that another one replaces: "small displacements instead of NLGEOM".
  void replaced(const std::string &what, unsigned long line) { replacements.add(what, line); }

  /// Note a part of the model that the translation lacks.
  void lacks(const std::string &kind, const std::string &what, unsigned long line);

  /// Return what is not needed in one line, or "".
  std::string              not_needed() const;
  std::vector<std::string> replaced() const { return replacements.all(); }
  std::vector<LackingPart> lacking() const;

private:
  LinesOfTexts                                      unneeded, replacements;
  std::vector<std::pair<std::string, LinesOfTexts>> parts; ///< by kind
};
} // namespace snug::deck

#endif
