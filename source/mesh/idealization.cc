#include <snug/mesh/idealization.h>

namespace snug::mesh {
/// The dimension of the kernel of a floating subdomain's stiffness matrix.
unsigned int Idealization::n_rigid_motions() const
{
  switch (kind)
    {
      case Kind::solid:
        return 6;
      case Kind::plane_strain:
      case Kind::plane_stress:
        return 3;
      case Kind::axisymmetric:
        return 1;
    }
  // for compilers that do not see that all kinds are handled
  return 0;
}

const ChoiceTable<Idealization::Kind()> &idealization_table()
{
  using Kind                                           = Idealization::Kind;
  static const ChoiceTable<Idealization::Kind()> table = {
    {"solid", "3D", []() { return Kind::solid; }},
    {"plane strain", "2D section of a body that cannot strain across it",
     []() { return Kind::plane_strain; }},
    {"plane stress", "2D section of a sheet without stress across it",
     []() { return Kind::plane_stress; }},
    {"axisymmetric",
     "2D section x >= 0 of a body of revolution, x the radius and y the "
     "axis; forces, energies and volumes are those of the full revolution",
     []() { return Kind::axisymmetric; }}};
  return table;
}
} // namespace snug::mesh
