#include <snug/base/petsc_handle.h>

#include <cstring>
#include <new>
#include <stdexcept>

namespace snug::petsc {
namespace {
bool out_of_memory = false;

/// Record whether memory ran out. The error code alone does not show this: if memory ends, PETSc
/// 3.18 returns the number of its caller's line. PETSC_ERR_LIB is an error of CHOLMOD and MUMPS.
/// Their errors on a matrix have codes of their own, and this one remains for memory that they do
/// not get.
PetscErrorCode note_and_return(MPI_Comm,
                               int,
                               const char *function,
                               const char *,
                               PetscErrorCode error,
                               PetscErrorType type,
                               const char *,
                               void *)
{
  if (type == PETSC_ERROR_INITIAL)
    out_of_memory = error == PETSC_ERR_MEM || error == PETSC_ERR_LIB ||
                    std::strcmp(function, "PetscMallocAlign") == 0;
  return error;
}
} // namespace

void return_errors()
{
  PetscPushErrorHandler(note_and_return, nullptr);
  PetscErrorPrintf = PetscErrorPrintfNone; // messages of CHOLMOD bypass the handler
}

void check(PetscErrorCode error)
{
  if (error == 0)
    return;
  if (out_of_memory)
    throw std::bad_alloc();
  const char *text = nullptr;
  PetscErrorMessage(error, &text, nullptr);
  throw std::runtime_error("PETSc error " + std::to_string(error) + ": " +
                           (text ? text : "unknown"));
}
} // namespace snug::petsc
