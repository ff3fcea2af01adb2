#ifndef snug_base_errors_h
#define snug_base_errors_h

#include <stdexcept>
#include <string>

namespace snug {
/// The input is wrong: where, which value, what is allowed. Exit status 2.
class InputError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// The problem has no solution, or was not solved to its tolerance: what
/// failed and what to try. Exit status 3.
class SolveError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// A design whose mesh is tangled; an optimizer may step back from it.
class TangledMesh : public SolveError
{
public:
  using SolveError::SolveError;
};

/// A signal asked the program to end; all ranks throw it at the same place.
class Interrupted : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Whether @p error says that memory ran out, in the words of C++ or deal.II.
bool is_out_of_memory(const std::exception &error);

/// The message in one line, without deal.II's banner and stack.
std::string one_line(const std::exception &error);

/// Input error of a parameter: "<entry> = <value>: <what is allowed>".
inline InputError
bad_entry(const std::string &entry, const std::string &value, const std::string &allowed)
{
  return InputError("entry '" + entry + "' = '" + value + "': " + allowed);
}
} // namespace snug

#endif
