#ifndef snug_elasticity_formulation_h
#define snug_elasticity_formulation_h

#include <snug/base/choice.h>

namespace snug::elasticity {
/// How an element takes the change of volume.
enum class Formulation
{
  standard, ///< point by point; locks as Poisson's ratio goes to 0.5
  B_bar     ///< projected, see Element
};

/// Rows "standard", "B-bar".
const ChoiceTable<Formulation()> &formulation_table();
} // namespace snug::elasticity

#endif
