#ifndef snug_base_petsc_handle_h
#define snug_base_petsc_handle_h

#include <petscksp.h>
#include <petscsf.h>

#include <string>
#include <utility>

namespace snug::petsc {
/// Set the error handling of PETSc: after this call errors are only returned, for check(), and
/// nothing is printed.
void return_errors();

/// Check a return code of PETSc.
/// @throws std::bad_alloc if memory ran out (detected after return_errors()), else
/// std::runtime_error naming the PETSc error, if @p error != 0.
void check(PetscErrorCode error);

/**
 * Owner of one reference to a PETSc object. The object is destroyed with the handle. The handle
 * is movable, not copyable, and converts to the raw handle that PETSc functions take.
 */
template <typename Object, PetscErrorCode (*destroy)(Object *)>
class Handle
{
public:
  Handle() = default;

  ~Handle() { reset(); }

  Handle(Handle &&other) noexcept : object(std::exchange(other.object, nullptr)) {}

  Handle &operator=(Handle &&other) noexcept
  {
    std::swap(object, other.object);
    return *this;
  }

  operator Object() const { return object; }

  /// Return the address for the creating functions of PETSc, after destroying the object held.
  Object *put()
  {
    reset();
    return &object;
  }

  void reset()
  {
    if (object != nullptr)
      destroy(&object);
    object = nullptr;
  }

private:
  Object object = nullptr;
};

using Matrix     = Handle<Mat, MatDestroy>;
using Solver     = Handle<KSP, KSPDestroy>;
using Vector     = Handle<Vec, VecDestroy>;
using Viewer     = Handle<PetscViewer, PetscViewerDestroy>;
using StarForest = Handle<PetscSF, PetscSFDestroy>;
using IndexSet   = Handle<IS, ISDestroy>;
using NullSpace  = Handle<MatNullSpace, MatNullSpaceDestroy>;
} // namespace snug::petsc

#endif
