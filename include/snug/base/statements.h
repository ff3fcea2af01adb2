#ifndef snug_base_statements_h
#define snug_base_statements_h

#include <snug/base/errors.h>

#include <map>
#include <string>
#include <vector>

namespace snug {
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
  std::string origin; ///< "scene.prm, line 7" or "--set"

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

  /// Return "scene.prm, line 7: ", or "scene.prm: " for an entry that was not set.
  std::string of(const std::string &path) const;

  /// Return the error "<origin>: entry '<path>' = '<value>': <allowed>", one line.
  InputError
  error(const std::string &path, const std::string &value, const std::string &allowed) const;

private:
  std::string                        file;
  std::map<std::string, std::string> places;
};

/// Return @p text as a part of a message: one line without control characters, cut after 80
/// characters.
std::string quotable(const std::string &text);

/// Return "; did you mean 'x'?" if one of @p known is close to @p word, else "".
std::string did_you_mean(const std::string &word, const std::vector<std::string> &known);
} // namespace snug

#endif
