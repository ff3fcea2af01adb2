#ifndef snug_shape_formula_modes_h
#define snug_shape_formula_modes_h

#include <snug/geometry/formula.h>
#include <snug/shape/shape_basis.h>

namespace snug::shape {
/// Vector fields of the coordinates, one per design variable. The components of the fields are
/// muParser formulas. On a face, formulas may contain its coordinates s and t, the angle and the
/// length.
template <int dim>
class FormulaFields
{
public:
  /// @throws InputError naming the entry Modes.
  explicit FormulaFields(const ShapeParameters &parameters);

  unsigned int n() const { return formulas.size(); }

  /// Return whether a formula contains the variable @p name.
  bool contain(const std::string &name) const;

  /// Return whether a formula contains a variable other than x, y, z.
  bool need_coordinates() const;

  /// Return field @p i at the point @p x. @p on_face holds s, t (3D), the angle and the length, or
  /// nothing if the formulas do not need them. @throws InputError if the value is not finite.
  dealii::Tensor<1, dim>
  value(unsigned int i, const dealii::Tensor<1, dim> &x, const std::vector<double> &on_face) const;

private:
  std::vector<std::string>                            variables;
  std::vector<std::vector<geometry::VariableFormula>> formulas;
};

/// Return the modes u(x) = sum_i alpha_i v_i(x) with FormulaFields v_i, at the needed points of a
/// face. Collective. @throws InputError naming the entry Modes or an entry of FaceCoordinates.
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
