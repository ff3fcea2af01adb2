#ifndef snug_shape_formula_modes_h
#define snug_shape_formula_modes_h

#include <snug/geometry/formula.h>
#include <snug/shape/shape_basis.h>

namespace snug::shape {
/// Vector fields of the coordinates, one per design variable. The components of the fields are
/// muParser formulas.
template <int dim>
class FormulaFields
{
public:
  /// @throws InputError naming the entry Modes.
  explicit FormulaFields(const ShapeParameters &parameters);

  unsigned int n() const { return formulas.size(); }

  /// Return field @p i at the point @p x. @throws InputError if the value is not finite.
  dealii::Tensor<1, dim> value(unsigned int i, const dealii::Tensor<1, dim> &x) const;

private:
  std::vector<std::vector<geometry::Formula<dim>>> formulas;
};

/// Return the modes u(x) = sum_i alpha_i v_i(x) with FormulaFields v_i, at the points of a
/// face. @throws InputError naming the entry Modes.
template <int dim>
Modes<dim> formula_modes(const ShapedFace<dim> &face, const ShapeParameters &parameters);

/// Return the same modes at the points of whole bodies. Collective.
/// @throws InputError naming the entry Bodies or Modes.
template <int dim>
Modes<dim> formula_modes(const mesh::BodyMesh<dim> &mesh,
                         const BodyNames           &bodies,
                         const ShapeParameters     &parameters);
} // namespace snug::shape

#endif
