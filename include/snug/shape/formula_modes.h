#ifndef snug_shape_formula_modes_h
#define snug_shape_formula_modes_h

#include <snug/geometry/formula.h>
#include <snug/shape/shape_basis.h>

namespace snug::shape {
/// Vector fields of the coordinates, one per design variable, as muParser
/// formulas of their components.
template <int dim>
class FormulaFields
{
public:
  /// @throws InputError naming the entry Modes.
  explicit FormulaFields(const ShapeParameters &parameters);

  unsigned int n() const { return formulas.size(); }

  /// Field @p i at a point. @throws InputError if it is not finite.
  dealii::Tensor<1, dim> value(unsigned int i, const dealii::Tensor<1, dim> &x) const;

private:
  std::vector<std::vector<geometry::Formula<dim>>> formulas;
};

/// u(x) = sum_i alpha_i v_i(x) with FormulaFields v_i, at the nodes of a
/// face. @throws InputError naming the entry Modes.
template <int dim>
Modes<dim> formula_modes(const ShapedFace<dim> &face, const ShapeParameters &parameters);

/// The same at the nodes of whole bodies. Collective.
/// @throws InputError naming the entry Bodies or Modes.
template <int dim>
Modes<dim> formula_modes(const mesh::BodyMesh<dim> &mesh,
                         const BodyNames           &bodies,
                         const ShapeParameters     &parameters);
} // namespace snug::shape

#endif
