#ifndef snug_base_statements_h
#define snug_base_statements_h

#include <snug/base/errors.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace snug {
/// Types of the values of entries in JSON.
enum class ValueType
{
  text, ///< a string, or a number, true or false
  number,
  whole_number,
  boolean,
  numbers, ///< a list
  whole_numbers,
  names
};

/**
 * One `set NAME = VALUE` of a parameter file or of the command line, or the opening of a
 * subsection (empty name). The statement stores its origin. Errors that checks across entries
 * find later name this origin.
 */
struct Statement
{
  std::string section; ///< "" at the top, "A/B" for nested subsections
  std::string name;
  std::string value;
  Place       origin;
  /// type of a value of a JSON file; none: the text decides
  std::optional<ValueType> type = {};

  std::string path() const;
};

/**
 * Return the statements of a text in the format of dealii::ParameterHandler (set, subsection,
 * end, # comments, \ at the end of continued lines).
 * @throws InputError naming @p file and the line of anything else.
 */
std::vector<Statement> parse_statements(const std::string &text, const std::string &file);

/// Return the statement of `--set "Subsection/Entry=value"`. @throws InputError
Statement parse_override(const std::string &argument);

/// Origins of the values of entries.
class Origins
{
public:
  /// Construct origins for scenes that were made by a program: the origins are empty.
  Origins() = default;

  Origins(const std::string &file, const std::vector<Statement> &statements);

  /// Return the place of an entry, or the file if the entry was not set.
  Place of(const std::string &path) const;

  /// Return the error of an entry, one line.
  InputError error(const std::string &path,
                   const std::string &value,
                   const std::string &allowed,
                   const std::string &suggestion = "") const;

private:
  std::string                  file;
  std::map<std::string, Place> places;
};

/// Return @p text as a part of a message: one line without control characters, cut after 80
/// characters.
std::string quotable(const std::string &text);

/// Return the name of @p known that is close to @p word, or "" if none is.
std::string suggestion(const std::string &word, const std::vector<std::string> &known);
} // namespace snug

#endif
