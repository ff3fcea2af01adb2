#ifndef snug_shape_shape_basis_h
#define snug_shape_shape_basis_h

#include <snug/shape/interior.h>

#include <functional>
#include <map>
#include <memory>
#include <optional>
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
  /// Where it is shown and how it moves there, if that is not the above.
  std::optional<std::pair<dealii::Point<dim>, dealii::Tensor<1, dim>>> shown = {};
};

/**
 * A linear operator from design variables to the moves of nodes and
 * samples, by points: those of a shaped face, the same on all ranks, or the
 * local ones of the mesh; of a face perhaps of its nodes only. Hanging nodes
 * do not count.
 */
template <int dim>
struct Modes
{
  using Field = std::vector<dealii::Tensor<1, dim>>; ///< per node
  /// Variables that move a node, and its move per variable.
  using Row = std::vector<std::pair<unsigned int, dealii::Tensor<1, dim>>>;

  unsigned int n_variables = 0, n_nodes = 0;
  /// Row of a node. Asked for each time, so that bases that would fill the
  /// memory with their rows need not keep them.
  std::function<Row(unsigned int)> row = [](unsigned int) { return Row(); };
  /// One per variable, or none if variables have no place.
  std::vector<Control<dim>> controls;
  /// Row of the point of the body at the place where control point @p i is shown, as of a node;
  /// only with controls.
  std::function<Row(unsigned int i)> row_at_point = {};

  Field               apply(const std::vector<double> &alpha) const;
  std::vector<double> transpose(const Field &gradient) const;
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

  /// V alpha on the local points. Collective.
  virtual Field apply(const std::vector<double> &alpha) const = 0;

  /// V' gradient summed over ranks: gradient by points -> dJ/dalpha, where
  /// @p gradient adds up to the whole over ranks. Collective.
  virtual std::vector<double> transpose(const Field &gradient) const = 0;

  /// Column i on the local points, made when it is asked for first and kept
  /// for all designs. Collective.
  Field column(unsigned int i) const;

private:
  /// Nodes that a variable moves, and their velocities.
  mutable std::map<unsigned int, std::vector<std::pair<unsigned int, dealii::Tensor<1, dim>>>> kept;
  mutable unsigned int n_nodes = 0;
};

/// Node positions of a design: reference + V alpha, never moved step by
/// step. Collective.
template <int dim>
typename mesh::BodyMesh<dim>::Field positions(const mesh::BodyMesh<dim> &mesh,
                                              const ShapeBasis<dim>     &basis,
                                              const std::vector<double> &design);

/**
 * A basis made from the entries of one subsection: V = H E C M with the
 * modes M. Of modes of a face, C makes its hanging nodes follow and E its
 * body's interior; others have none of these. H interpolates the hanging
 * nodes of the mesh and the samples whose moves the modes do not give.
 */
template <int dim>
class Shape : public ShapeBasis<dim>
{
public:
  using Field = typename ShapeBasis<dim>::Field;

  /// Modes of the local points of the mesh, which must outlive this.
  Shape(const mesh::BodyMesh<dim> &mesh, Modes<dim> modes);

  /// Modes of a face.
  Shape(std::unique_ptr<ShapedFace<dim>> face,
        Modes<dim>                       modes,
        std::unique_ptr<Interior<dim>>   interior);

  unsigned int        n_variables() const override { return modes.n_variables; }
  Field               apply(const std::vector<double> &alpha) const override;
  std::vector<double> transpose(const Field &gradient) const override;

  const std::vector<Control<dim>> &controls() const { return modes.controls; }

  /// Return the move of the point of the body at the place where control point @p i is shown, by
  /// this basis' own variables.
  dealii::Tensor<1, dim> move_at_point(unsigned int i, const std::vector<double> &alpha) const;

  /// (body, boundary) of the faces that are shaped, ascending. Collective.
  std::vector<std::pair<unsigned int, unsigned int>> faces() const;

private:
  const mesh::BodyMesh<dim>       &mesh;
  std::unique_ptr<ShapedFace<dim>> face; ///< null: of the whole mesh
  Modes<dim>                       modes;
  std::unique_ptr<Interior<dim>>   interior; ///< null without a face
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
