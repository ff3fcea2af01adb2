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
  return {{"standard",
           "volumetric strain of the displacements; locks at Poisson's ratios near 0.5"},
          {"B-bar",
           "mean volumetric strain of each cell (for degree 2: a linear function); does not lock, "
           "except on quadratic tetrahedra"}};
}
} // namespace snug::elasticity

#endif
