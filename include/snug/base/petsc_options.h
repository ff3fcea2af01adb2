#ifndef snug_base_petsc_options_h
#define snug_base_petsc_options_h

#include <mpi.h>

#include <string>
#include <vector>

namespace snug::petsc {
/// Return the value of -PREFIXNAME among PETSc's options, or @p fallback.
std::string option(const std::string &prefix, const std::string &name, const std::string &fallback);

/// This class sets -PREFIXNAME among PETSc's options during its lifetime, unless the user has set
/// it.
class DefaultOption
{
public:
  DefaultOption(const std::string &prefix, const std::string &name, const std::string &value);
  ~DefaultOption();
  DefaultOption(const DefaultOption &)            = delete;
  DefaultOption &operator=(const DefaultOption &) = delete;

private:
  std::string key; ///< empty if the user set the option
};

/// Return "-NAME VALUE" of those options of PETSc that no rank has queried yet. Return none if
/// -options_left makes PETSc report these options at its end. Collective; rank 0 gets the result,
/// all other ranks get none.
std::vector<std::string> unused_options(MPI_Comm communicator);
} // namespace snug::petsc

#endif
