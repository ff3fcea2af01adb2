#ifndef snug_shape_formula_modes_h
#define snug_shape_formula_modes_h

#include <snug/geometry/formula.h>
#include <snug/shape/face_basis.h>

namespace snug::shape {
/// Vector fields of the coordinates, one per design variable, as muParser
/// formulas of their components.
template <int dim>
class FormulaFields
{
public:
  /// @throws InputError naming the entry Modes.
  explicit FormulaFields(const ShapeParameters &parameters);

  unsigned int n() const;

  /// Field @p i at a point. @throws InputError if it is not finite.
  dealii::Tensor<1, dim> value(unsigned int i, const dealii::Tensor<1, dim> &x) const;

private:
  std::vector<std::vector<geometry::Formula<dim>>> formulas;
};

/// u(x) = sum_i alpha_i v_i(x) at the nodes of a face.
template <int dim>
class FormulaFace : public FaceModes<dim>
{
public:
  using FaceField = typename FaceModes<dim>::FaceField;

  /// @throws InputError naming the entry Modes.
  FormulaFace(const ShapedFace<dim> &face, const ShapeParameters &parameters);

  unsigned int              n_variables() const override;
  FaceField                 apply(const std::vector<double> &alpha) const override;
  std::vector<double>       transpose(const FaceField &gradient) const override;
  std::vector<Control<dim>> controls() const override;

private:
  std::vector<FaceField> modes;
};

/// u(x) = sum_i alpha_i v_i(x) at the nodes of whole bodies.
template <int dim>
class FormulaBodies : public Shape<dim>
{
public:
  using Field = typename ShapeBasis<dim>::Field;

  /// Collective. @throws InputError naming the entry Bodies or Modes.
  FormulaBodies(const mesh::BodyMesh<dim> &mesh,
                const BodyNames           &bodies,
                const ShapeParameters     &parameters);

  unsigned int              n_variables() const override;
  Field                     apply(const std::vector<double> &alpha) const override;
  std::vector<double>       transpose(const Field &gradient) const override;
  std::vector<Control<dim>> controls() const override;
  std::vector<std::pair<unsigned int, unsigned int>> faces() const override;

private:
  const mesh::BodyMesh<dim> &mesh;
  std::vector<Field>         modes;
};
} // namespace snug::shape

#endif
