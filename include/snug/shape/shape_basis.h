#ifndef snug_shape_shape_basis_h
#define snug_shape_shape_basis_h

#include <snug/base/choice.h>
#include <snug/mesh/body_mesh.h>
#include <snug/shape/shape_parameters.h>

#include <memory>
#include <utility>
#include <vector>

namespace snug::shape {
/// What one design variable moves: its control point in the reference.
template <int dim>
struct Control
{
  unsigned int           point;          ///< index of the control point
  dealii::Point<dim>     position;       ///< [length]
  dealii::Tensor<1, dim> direction;      ///< move of the point per variable
  bool                   border = false; ///< on the rim of the shape
  bool                   frozen = false; ///< must not move
};

/**
 * A linear operator V from design variables to node displacements,
 * x = reference + V alpha. Column i is the velocity dX/dalpha_i.
 */
template <int dim>
class ShapeBasis
{
public:
  using Field = typename mesh::BodyMesh<dim>::Field;

  virtual ~ShapeBasis() = default;

  virtual unsigned int n_variables() const = 0;

  /// V alpha on the local nodes. Collective.
  virtual Field apply(const std::vector<double> &alpha) const = 0;

  /// V' gradient summed over ranks: node gradient -> dJ/dalpha, where
  /// @p gradient adds up to the whole over ranks. Collective.
  virtual std::vector<double> transpose(const Field &gradient) const = 0;

  /// Column i on the local nodes. Collective.
  Field column(unsigned int i) const;
};

/// Node positions of a design: reference + V alpha, never moved step by
/// step. Collective.
template <int dim>
typename mesh::BodyMesh<dim>::Field positions(const mesh::BodyMesh<dim> &mesh,
                                              const ShapeBasis<dim>     &basis,
                                              const std::vector<double> &design);

/// A basis made from the entries of one subsection.
template <int dim>
class Shape : public ShapeBasis<dim>
{
public:
  /// One per variable, or none if variables have no place.
  virtual std::vector<Control<dim>> controls() const = 0;

  /// (body, boundary) of the faces that are shaped, ascending.
  virtual std::vector<std::pair<unsigned int, unsigned int>> faces() const = 0;
};

/// A shape from its entries. @throws InputError naming the entry.
/// Collective. The mesh must outlive the shape.
template <int dim>
using MakeShape = std::unique_ptr<Shape<dim>>(const mesh::BodyMesh<dim> &,
                                              const BodyNames &,
                                              const ShapeParameters &);

/// Rows of the entry Basis.
template <int dim>
const ChoiceTable<MakeShape<dim>> &shape_basis_table();
} // namespace snug::shape

#endif
