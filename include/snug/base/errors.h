#ifndef snug_base_errors_h
#define snug_base_errors_h

#include <stdexcept>
#include <string>

namespace snug {
/// A place of the input. The line is 0 if it is unknown.
struct Place
{
  std::string  file; ///< a file, or "--set"
  unsigned int line = 0;

  /// Return "scene.prm, line 7: ", "scene.prm: ", or "" without a file.
  std::string text() const;
};

/// A wrong value of an entry. All members may be empty.
struct WrongEntry
{
  std::string entry; ///< "Subsection/Entry"
  std::string value;
  std::string allowed;    ///< what the value must be
  std::string suggestion; ///< name that may have been meant
};

/// Error for wrong input. The message gives the place, the value and the allowed values. Exit
/// status 2.
class InputError : public std::runtime_error
{
public:
  /// Construct the error @p text at @p place, about an entry if @p wrong is not empty. The message
  /// is the place and the text.
  explicit InputError(const std::string &text,
                      const Place       &place = {},
                      const WrongEntry  &wrong = {})
    : std::runtime_error(place.text() + text), of_entry(wrong), at(place), own_text(text)
  {}

  /// Construct the error "entry '<entry>' = '<value>': <allowed>", with the suggestion if there is
  /// one.
  explicit InputError(const WrongEntry &wrong, const Place &place = {});

  const WrongEntry  &wrong() const { return of_entry; }
  const Place       &place() const { return at; }
  const std::string &text() const { return own_text; } ///< the message without the place

private:
  WrongEntry  of_entry;
  Place       at;
  std::string own_text;
};

/// Error for a problem without solution, or one that was not solved to its tolerance. The message
/// states what failed and what to try. Exit status 3.
class SolveError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Error for a design whose mesh is tangled; an optimizer may step back from it.
class TangledMesh : public SolveError
{
public:
  using SolveError::SolveError;
};

/// Error for a signal that asks the program to end. All ranks throw it at the same place.
class Interrupted : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Return whether @p error, in the words of C++ or deal.II, states that memory ran out.
bool is_out_of_memory(const std::exception &error);

/// Return the message in one line, without deal.II's banner and stack.
std::string one_line(const std::exception &error);

/// Return the input error of a parameter: "<entry> = <value>: <what is allowed>".
inline InputError
bad_entry(const std::string &entry, const std::string &value, const std::string &allowed)
{
  return InputError(WrongEntry{entry, value, allowed, ""});
}
} // namespace snug

#endif
