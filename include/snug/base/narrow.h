#ifndef snug_base_narrow_h
#define snug_base_narrow_h

#include <deal.II/base/exceptions.h>

namespace snug {
/// @p value as a shorter integer, such as the number of rows as the int that
/// BLAS and MPI take. Debug builds assert that it fits.
template <typename To, typename From>
To narrow(const From value)
{
  const To result = static_cast<To>(value);
  Assert(static_cast<From>(result) == value, dealii::ExcMessage("integer out of range"));
  return result;
}
} // namespace snug

#endif
