#include <snug/shape/interior.h>

namespace snug::shape {
template <int dim>
const ChoiceTable<MakeInterior<dim>> &interior_table()
{
  // Linear blending needs the frame of a box, which is checked with the scene: it is local and
  // explicit. The others take a linear solve for each move and work in any body.
  static const ChoiceTable<MakeInterior<dim>> table = {
    {"linear blending",
     "in boxes, a share of the face's move that falls linearly to zero at "
     "the opposite face",
     linear_blending<dim>},
    {"Laplace", "each component of the move is harmonic",
     [](const auto &face, const auto &parameters) {
       return solved_interior(face, parameters, InteriorKind::Laplace);
     }},
    {"elasticity", "the body is elastic, the stiffer the smaller its cells",
     [](const auto &face, const auto &parameters) {
       return solved_interior(face, parameters, InteriorKind::elasticity);
     }}};
  return table;
}

template const ChoiceTable<MakeInterior<2>> &interior_table<2>();
template const ChoiceTable<MakeInterior<3>> &interior_table<3>();
} // namespace snug::shape
