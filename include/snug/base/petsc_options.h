#ifndef snug_base_petsc_options_h
#define snug_base_petsc_options_h

#include <mpi.h>

#include <string>
#include <vector>

namespace snug::petsc {
/// What PETSc's options say of -PREFIXNAME, or @p fallback.
std::string option(const std::string &prefix, const std::string &name, const std::string &fallback);

/// Sets -PREFIXNAME among PETSc's options for its own life, unless the user has set it.
class DefaultOption
{
public:
  DefaultOption(const std::string &prefix, const std::string &name, const std::string &value);
  ~DefaultOption();
  DefaultOption(const DefaultOption &)            = delete;
  DefaultOption &operator=(const DefaultOption &) = delete;

private:
  std::string key; ///< empty if it is the user's
};

/// "-NAME VALUE" of PETSc's options that no rank has asked for yet; none if -options_left makes
/// PETSc report them at its end. Collective; the result is rank 0's, the others get none.
std::vector<std::string> unused_options(MPI_Comm communicator);
} // namespace snug::petsc

#endif
