#ifndef snug_shape_shape_basis_h
#define snug_shape_shape_basis_h

#include <snug/shape/interior.h>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace snug::shape {
/// The control point that one design variable moves, in the reference geometry.
template <int dim>
struct Control
{
  unsigned int           point;          ///< index of the control point
  dealii::Point<dim>     position;       ///< [length]
  dealii::Tensor<1, dim> direction;      ///< move of the point per unit of the variable
  bool                   border = false; ///< on the border of the face or box
  bool                   frozen = false; ///< must not move
  /// The position at which the control point is shown and its direction there, if these differ
  /// from position and direction.
  std::optional<std::pair<dealii::Point<dim>, dealii::Tensor<1, dim>>> shown = {};
};

/// The limit sum_i row_i beta_i <= bound of the controls beta.
struct ControlLimit
{
  std::map<unsigned int, double> row;
  double                         bound;
  std::string                    entry; ///< that sets the limit, such as "Maximum slope"
};

/**
 * A linear operator from design variables to the moves of points. The points are those of
 * ShapedFace::needed_points(), or the local nodes and samples of the mesh. Modes of a face may
 * cover only the nodes of the face. The rows of hanging nodes have no effect.
 */
template <int dim>
struct Modes
{
  using Field = std::vector<dealii::Tensor<1, dim>>; ///< per point
  /// The variables that move a point, and the move of the point per variable.
  using Row = std::vector<std::pair<unsigned int, dealii::Tensor<1, dim>>>;

  unsigned int n_variables = 0, n_nodes = 0;
  /// Return the row of a point. With a function instead of an array, a basis whose rows would fill
  /// the memory can compute the rows at each call.
  std::function<Row(unsigned int)> row = [](unsigned int) { return Row(); };
  /// One control per variable, or no controls if variables have no position.
  std::vector<Control<dim>> controls;
  /// Return the row of the point of the body at the position where control point @p i is shown.
  /// Only modes with controls set this function.
  std::function<Row(unsigned int i)> row_at_point = {};
  std::vector<ControlLimit>          limits       = {};

  Field apply(const std::vector<double> &alpha) const;
};

/**
 * A linear operator V from design variables to node displacements,
 * x = reference + V alpha. Column i is the velocity dX/dalpha_i.
 */
template <int dim>
class ShapeBasis
{
public:
  using Field = mesh::Field<dim>;

  virtual ~ShapeBasis() = default;

  virtual unsigned int n_variables() const = 0;

  /// Return V alpha at the local points. Collective.
  virtual Field apply(const std::vector<double> &alpha) const = 0;

  /// Return V alpha as a sum of columns if all columns are cached, which needs no linear solve,
  /// else by apply(). Both are equal up to round-off. Collective.
  Field moved(const std::vector<double> &alpha) const;

  /// Return V' gradient summed over ranks, which maps the gradient with respect to points to
  /// dJ/dalpha. The sum of @p gradient over ranks is the whole gradient. Collective.
  std::vector<double> transpose(const Field &gradient) const;

  /// Return column i at the local points. The first call computes the column and caches it for
  /// all designs. Collective.
  Field column(unsigned int i) const;

protected:
  explicit ShapeBasis(MPI_Comm communicator) : communicator(communicator) {}

private:
  /// The points that a variable moves, and the velocities of the points.
  using Moves = std::vector<std::pair<unsigned int, dealii::Tensor<1, dim>>>;

  /// Return the moves of variable @p i, which are computed at the first call. Collective.
  const Moves &moves(unsigned int i) const;

  MPI_Comm                              communicator;
  mutable std::map<unsigned int, Moves> kept;
  mutable unsigned int                  n_nodes = 0;
};

/// Return the positions of the local points at a design, reference + V alpha. Positions never
/// accumulate the steps of designs. Collective.
template <int dim>
mesh::Field<dim> positions(const mesh::BodyMesh<dim> &mesh,
                           const ShapeBasis<dim>     &basis,
                           const std::vector<double> &design);

/**
 * The basis of one subsection of entries, V = H E C M with the modes M. For modes of a face,
 * C interpolates the hanging nodes of the face and E extends the moves into the interior of the
 * body. Modes of whole bodies have neither C nor E. H interpolates the hanging nodes of the mesh
 * and the samples whose moves the modes do not give.
 */
template <int dim>
class Shape : public ShapeBasis<dim>
{
public:
  using Field = typename ShapeBasis<dim>::Field;

  /// Construct a shape from modes of the local points of the mesh. The mesh must outlive the shape.
  Shape(const mesh::BodyMesh<dim> &mesh, Modes<dim> modes);

  /// Construct a shape from modes of a face. The mesh must outlive the shape.
  Shape(const ShapedFace<dim> &face, Modes<dim> modes, std::unique_ptr<Interior<dim>> interior);

  unsigned int n_variables() const override { return modes.n_variables; }
  Field        apply(const std::vector<double> &alpha) const override;

  const std::vector<Control<dim>> &controls() const { return modes.controls; }

  const std::vector<ControlLimit> &limits() const { return modes.limits; }

  /// Return the move of the point of the body at the position where control point @p i is shown.
  /// @p alpha holds the variables of this basis alone.
  dealii::Tensor<1, dim> move_at_point(unsigned int i, const std::vector<double> &alpha) const;

  /// Return (body, boundary) of the faces that are shaped, ascending. Collective.
  std::vector<std::pair<unsigned int, unsigned int>> faces() const;

private:
  const mesh::BodyMesh<dim>     &mesh;
  Modes<dim>                     modes;
  std::unique_ptr<Interior<dim>> interior; ///< null without a face
  // Parts of the gathered face, which as a whole would take memory of every rank.
  std::vector<std::pair<unsigned int, unsigned int>> boundaries; ///< (body, boundary)
  std::vector<typename mesh::BodyMesh<dim>::Hanging> hanging;    ///< with surface nodes
  std::vector<unsigned int> samples; ///< local numbers of the last points of the modes
};

/// Function that makes a shape from the entries of the shape. @throws InputError naming the
/// entry. Collective. The mesh must outlive the shape.
template <int dim>
using MakeShape = std::unique_ptr<Shape<dim>>(const mesh::BodyMesh<dim> &,
                                              const BodyNames &,
                                              const ShapeParameters &);

/// Return the rows of the entry Basis.
template <int dim>
const ChoiceTable<MakeShape<dim>> &shape_basis_table();
} // namespace snug::shape

#endif
