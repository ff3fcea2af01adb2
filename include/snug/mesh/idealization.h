#ifndef snug_mesh_idealization_h
#define snug_mesh_idealization_h

#include <snug/base/values.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/tensor.h>

namespace snug::mesh {
/**
 * This struct describes what a mesh of dimension dim represents: a solid (3D), or the section of
 * a solid (2D). A volume or area of the solid is
 * @f[ \int w\,d\Omega,\qquad w = 1,\quad\text{thickness},\quad\text{or}
 *     \quad 2\pi r @f]
 * over the section. In axisymmetric sections x is the radius r, and y is the axis.
 */
struct Idealization
{
  enum class Kind
  {
    solid,
    plane_strain,
    plane_stress,
    axisymmetric
  };

  Kind   kind;
  double thickness = 1.; ///< of plane sections [length]

  /// Return the default: a solid in 3D, plane strain of unit thickness in 2D.
  static Idealization natural(unsigned int dim)
  {
    return {dim == 2 ? Kind::plane_strain : Kind::solid};
  }

  bool is_axisymmetric() const { return kind == Kind::axisymmetric; }

  /// Return w at @p x [length^(3-dim)].
  template <int dim>
  double weight(const dealii::Tensor<1, dim> &x) const
  {
    return is_axisymmetric() ? 2. * dealii::numbers::PI * x[0] : thickness;
  }

  /// Return dw/dx, which is constant.
  template <int dim>
  dealii::Tensor<1, dim> weight_gradient() const
  {
    dealii::Tensor<1, dim> gradient;
    gradient[0] = is_axisymmetric() ? 2. * dealii::numbers::PI : 0.;
    return gradient;
  }

  /// Return the number of rigid motions of a body, the dimension of the kernel of its stiffness
  /// matrix: 6 in solids, 3 in plane sections, and 1, along the axis, in axisymmetric sections.
  unsigned int n_rigid_motions() const
  {
    return kind == Kind::solid ? 6 : kind == Kind::axisymmetric ? 1 : 3;
  }
};

inline Names names(Idealization::Kind)
{
  return {{"solid", "3D body"},
          {"plane strain", "2D section of a body without strain across the section"},
          {"plane stress", "2D section of a sheet without stress across the section"},
          {"axisymmetric",
           "2D section x >= 0 of a body of revolution, with the radius x and the axis y. Forces, "
           "energies and volumes refer to the full revolution."}};
}
} // namespace snug::mesh

#endif
