#ifndef snug_elasticity_formulation_h
#define snug_elasticity_formulation_h

#include <snug/base/values.h>

namespace snug::elasticity {
/// Treatment of the change of volume in an element.
enum class Formulation
{
  standard, ///< point by point
  B_bar     ///< projected, see Element
};
inline Names names(Formulation)
{
  return {{"standard", "displacements alone; locks as Poisson's ratio goes to 0.5"},
          {"B-bar",
           "the change of volume by its mean in each cell (of degree 2: by a linear function), "
           "does not lock"}};
}
} // namespace snug::elasticity

#endif
