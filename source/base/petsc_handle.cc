#include <snug/base/petsc_handle.h>

#include <stdexcept>

namespace snug::petsc {
void check(PetscErrorCode error)
{
  if (error == 0)
    return;
  const char *text = nullptr;
  PetscErrorMessage(error, &text, nullptr);
  throw std::runtime_error("PETSc error " + std::to_string(error) + ": " +
                           (text ? text : "unknown"));
}
} // namespace snug::petsc
