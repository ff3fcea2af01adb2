#ifndef snug_base_statements_h
#define snug_base_statements_h

#include <snug/base/errors.h>

#include <map>
#include <string>
#include <vector>

namespace snug {
/**
 * One `set NAME = VALUE` of a parameter file or of the command line, or
 * the opening of a subsection (empty name). It keeps where it stood, which
 * errors name that are found later, by checks across entries.
 */
struct Statement
{
  std::string section; ///< "" at the top, "A/B" for nested subsections
  std::string name;
  std::string value;
  std::string origin; ///< "scene.prm, line 7" or "--set"

  std::string path() const;
};

/**
 * Statements of a text in the format of dealii::ParameterHandler (set,
 * subsection, end, # comments, \ at the end of continued lines).
 * @throws InputError naming @p file and the line of anything else.
 */
std::vector<Statement> parse_statements(const std::string &text, const std::string &file);

/// The statement of `--set "Subsection/Entry=value"`. @throws InputError
Statement parse_override(const std::string &argument);

/// Where entries got their values from.
class Origins
{
public:
  /// For scenes that were made by a program: origins are empty.
  Origins() = default;

  Origins(const std::string &file, const std::vector<Statement> &statements);

  /// "scene.prm, line 7: ", or "scene.prm: " for an entry nobody set.
  std::string of(const std::string &path) const;

  /// "<origin>: entry '<path>' = '<value>': <allowed>", one line.
  InputError
  error(const std::string &path, const std::string &value, const std::string &allowed) const;

private:
  std::string                        file;
  std::map<std::string, std::string> places;
};

/// @p text as a part of a message: one line without control characters,
/// cut after 80 characters.
std::string quotable(const std::string &text);

/// "; did you mean 'x'?" if one of @p known is close to @p word, else "".
std::string did_you_mean(const std::string &word, const std::vector<std::string> &known);
} // namespace snug

#endif
