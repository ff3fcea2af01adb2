#ifndef snug_base_narrow_h
#define snug_base_narrow_h

#include <snug/base/assertions.h>

namespace snug {
/// Return @p value as a shorter integer, for example the number of rows as the int of BLAS and
/// MPI. Throw an InternalError if the value does not fit.
template <typename To, typename From>
To narrow(const From value)
{
  const To result = static_cast<To>(value);
  SNUG_ASSERT(static_cast<From>(result) == value, "the integer is out of range");
  return result;
}
} // namespace snug

#endif
