#ifndef snug_base_errors_h
#define snug_base_errors_h

#include <stdexcept>
#include <string>

namespace snug {
/// Error for wrong input. The message gives the place, the value and the allowed values. Exit
/// status 2.
class InputError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
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
  return InputError("entry '" + entry + "' = '" + value + "': " + allowed);
}
} // namespace snug

#endif
