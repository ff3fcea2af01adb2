#ifndef snug_mesh_file_deck_text_h
#define snug_mesh_file_deck_text_h

#include <snug/mesh_file/mesh_text.h>

#include <functional>
#include <map>

namespace snug::mesh_file {
/// A keyword of a deck, with its options and the place of its data lines.
struct Keyword
{
  std::string                        name;    ///< in upper case, without * and blanks: SOLIDSECTION
  std::string                        title;   ///< as in the file, in upper case: *SOLID SECTION
  std::map<std::string, std::string> options; ///< keys in upper case, without blanks
  std::string                        file;    ///< name of the included file, or ""
  unsigned long                      line;    ///< line of the keyword
  unsigned long                      data_line;  ///< line of the first data line
  std::size_t                        begin, end; ///< place of the data lines in the text

  /// Return the value of an option, or "" if it is not there.
  std::string option(const std::string &key) const;
  bool        has(const std::string &key) const { return options.count(key) > 0; }
};

/// Return the error "line 17: message" of a keyword, with the name of an included file in front.
InputError keyword_error(const Keyword &keyword, const std::string &message);

/**
 * Return a deck in which the files of *INCLUDE stand in place of the keyword, between comments from
 * which DeckText knows their names and lines. Other texts are returned as they are.
 * @param[in] read Function that returns the content of a file, whose name is as in the deck.
 * @throws InputError of @p read, and if files include each other.
 */
std::string with_includes(const std::string                                     &text,
                          const std::function<std::string(const std::string &)> &read);

/**
 * This class divides a deck of Abaqus or CalculiX (.inp) into keywords. A keyword line begins with
 * one * and has options "KEY=VALUE" behind commas; it continues on the next line after a comma at
 * its end. Data lines follow up to the next keyword; ** begins a comment. Names may stand in double
 * quotes, within which commas are allowed. Source: Abaqus keywords reference.
 */
class DeckText
{
public:
  /// @p text must outlive this object. @throws InputError "line 3: message" for data lines without
  /// a keyword.
  explicit DeckText(const std::string &text);

  const std::vector<Keyword> &keywords() const { return all; }

  /// Function of the words between commas of a data line, without quotes, and of its line number.
  using ReadLine = std::function<void(const std::vector<std::string> &words, unsigned long line)>;

  /// Call @p read for each data line of a keyword, without comments and empty lines. The name of an
  /// included file is put in front of errors.
  void for_each_line(const Keyword &keyword, const ReadLine &read) const;

private:
  const std::string   &text;
  std::vector<Keyword> all;

  void begin_keyword(const std::string &line, unsigned long number);
};

std::string upper_case(std::string text);

/// Return the words between commas, without blanks at their ends and without quotes.
std::vector<std::string> deck_words(const std::string &line);

/// Return the words from index @p first on as numbers; an empty word is 0. @throws InputError at
/// @p line.
std::vector<double>
numbers_from(const std::vector<std::string> &words, std::size_t first, unsigned long line);
} // namespace snug::mesh_file

#endif
