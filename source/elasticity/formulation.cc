#include <snug/elasticity/formulation.h>

namespace snug::elasticity {
const ChoiceTable<Formulation()> &formulation_table()
{
  static const ChoiceTable<Formulation()> table = {
    {"standard", "displacements alone; locks as Poisson's ratio goes to 0.5",
     []() { return Formulation::standard; }},
    {"B-bar",
     "the change of volume by its mean in each cell (of degree 2: by a "
     "linear function), does not lock",
     []() { return Formulation::B_bar; }}};
  return table;
}
} // namespace snug::elasticity
