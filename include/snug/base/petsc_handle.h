#ifndef snug_base_petsc_handle_h
#define snug_base_petsc_handle_h

#include <petscksp.h>
#include <petscsf.h>

#include <string>
#include <utility>

namespace snug::petsc {
/// From now on errors of PETSc are only returned, for check(); nothing is printed.
void return_errors();

/// @throws std::bad_alloc if memory ran out (known after return_errors()), else
/// std::runtime_error naming the PETSc error, if @p error != 0.
void check(PetscErrorCode error);

/**
 * Owner of one reference to a PETSc object: destroyed with the handle,
 * movable, not copyable, converts to the raw handle PETSc functions take.
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

  /// The address for PETSc's creating functions; drops the object held.
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
