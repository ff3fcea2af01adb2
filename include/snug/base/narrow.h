#ifndef snug_base_narrow_h
#define snug_base_narrow_h

#include <deal.II/base/exceptions.h>

namespace snug {
/// Return @p value as a shorter integer, for example the number of rows as the int of BLAS and
/// MPI. Debug builds assert that the value fits.
template <typename To, typename From>
To narrow(const From value)
{
  const To result = static_cast<To>(value);
  Assert(static_cast<From>(result) == value, dealii::ExcMessage("integer out of range"));
  return result;
}
} // namespace snug

#endif
