#ifndef snug_shape_shapes_h
#define snug_shape_shapes_h

#include <snug/shape/links.h>

#include <string>

namespace snug::shape {
/// A control point of a design.
template <int dim>
struct MovedPoint
{
  std::string            shape; ///< name of the shape, may be empty
  unsigned int           index; ///< within its shape
  dealii::Point<dim>     position;
  dealii::Tensor<1, dim> move; ///< from the reference to position
  /// the point of the body, for shapes of a face on the face, at the same place of the reference
  /// as the control point; it moves by this shape alone
  dealii::Point<dim> on_body = {};
  /// index among all design variables and sign, of each direction that is not fixed
  std::vector<std::pair<unsigned int, double>> variables = {};
};

/**
 * All shapes of a scene as one basis: of each shape the variables that its
 * links leave, one after the other; displacements added up.
 */
template <int dim>
class Shapes : public ShapeBasis<dim>
{
public:
  using Field = typename ShapeBasis<dim>::Field;

  /// Collective. @throws InputError naming the entry. The mesh must
  /// outlive this object.
  Shapes(const mesh::BodyMesh<dim>          &mesh,
         const BodyNames                    &bodies,
         const std::vector<ShapeParameters> &parameters);

  unsigned int        n_variables() const override { return lower.size(); }
  Field               apply(const std::vector<double> &alpha) const override;
  std::vector<double> transpose(const Field &gradient) const override;

  /// (body, boundary) of the faces that are shaped, ascending.
  std::vector<std::pair<unsigned int, unsigned int>> faces() const;

  /// @name Bounds and start of the variables
  /// @{
  const std::vector<double> &lower_bounds() const { return lower; }
  const std::vector<double> &upper_bounds() const { return upper; }
  const std::vector<double> &start() const { return initial; }
  /// @}

  /**
   * Of each variable, the change that a first step of a search may make: it moves no node by more
   * than half of the mean edge of a cell of the reference mesh that has the node. Equal for all
   * variables of a shape, but for formula modes, which may be of any kind and size. Collective.
   */
  std::vector<double> first_steps() const;

  /// Return the control points of a design, shape by shape.
  std::vector<MovedPoint<dim>> control_points(const std::vector<double> &alpha) const;

private:
  struct Part
  {
    std::string                 name;
    unsigned int                first; ///< its first variable
    bool                        alike; ///< variables are of one kind: no formula modes
    std::unique_ptr<Shape<dim>> basis;
    Links                       links;
  };

  /// The basis' own variables at a design.
  static std::vector<double> expanded(const Part &part, const std::vector<double> &alpha);
  void                       add_variables(const ShapeParameters &parameters, unsigned int n);

  const mesh::BodyMesh<dim> &mesh;
  std::vector<Part>          parts;
  std::vector<double>        lower, upper, initial;
};
} // namespace snug::shape

#endif
