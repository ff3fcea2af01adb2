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
  unsigned int           index; ///< index of the point within the shape
  dealii::Point<dim>     position;
  dealii::Tensor<1, dim> move; ///< displacement from the reference position to position
  /// The point of the body at the reference position where the control point is shown; for shapes
  /// of a face, this point lies on the face. Only this shape moves the point.
  dealii::Point<dim> on_body = {};
  /// index among all design variables and sign, for each direction that is not fixed
  std::vector<std::pair<unsigned int, double>> variables = {};
};

/**
 * All shapes of a scene as one basis. The design variables are the variables of the links of each
 * shape, shape by shape. The displacements of the shapes are added up.
 */
template <int dim>
class Shapes : public ShapeBasis<dim>
{
public:
  using Field = typename ShapeBasis<dim>::Field;

  /// Make all shapes. Collective. @throws InputError naming the entry. The mesh must
  /// outlive this object.
  Shapes(const mesh::BodyMesh<dim>          &mesh,
         const BodyNames                    &bodies,
         const std::vector<ShapeParameters> &parameters);

  unsigned int n_variables() const override { return lower.size(); }
  Field        apply(const std::vector<double> &alpha) const override;

  /// Return (body, boundary) of the faces that are shaped, ascending. Collective.
  std::vector<std::pair<unsigned int, unsigned int>> faces() const;

  /// @name Bounds and start of the variables
  /// @{
  const std::vector<double> &lower_bounds() const { return lower; }
  const std::vector<double> &upper_bounds() const { return upper; }
  const std::vector<double> &start() const { return initial; }
  /// @}

  /// The limit row . alpha <= bound of several variables.
  struct Limit
  {
    std::vector<double> row;
    double              bound;
    std::string         entry; ///< that sets the limit, such as "Shape/Maximum slope"
  };

  /// Return the limits of several variables. Limits of single variables are bounds.
  const std::vector<Limit> &limits() const { return all_limits; }

  /// Return the entry of the limit that @p alpha violates most, relative to the largest weight of
  /// the limit; empty if it violates none.
  std::string most_violated_limit(const std::vector<double> &alpha) const;

  /**
   * Return, for each variable, the change in the first step of a search. The change moves no node
   * by more than half of the mean edge length of any cell of the reference mesh that has the node.
   * The change is equal for all variables of a shape, except for formula modes, whose variables
   * may differ in kind and size. A variable that moves no node has the maximum double.
   * Collective.
   */
  std::vector<double> first_steps() const;

  /// Return the variables of a design by the name of their shape.
  std::vector<std::pair<std::string, std::vector<double>>>
  by_shape(const std::vector<double> &alpha) const;

  /// Return the control points of a design, shape by shape.
  std::vector<MovedPoint<dim>> control_points(const std::vector<double> &alpha) const;

private:
  struct Part
  {
    std::string                 name;
    unsigned int                first; ///< index of the first variable of the shape
    bool                        alike; ///< variables are of one kind: no formula modes
    std::unique_ptr<Shape<dim>> basis;
    Links                       links;
  };

  /// Return the variables of the basis of a part at a design.
  static std::vector<double> expanded(const Part &part, const std::vector<double> &alpha);
  void                       add_variables(const ShapeParameters &parameters, unsigned int n);
  void                       add_limits(const Part &part, const ShapeParameters &parameters);

  const mesh::BodyMesh<dim> &mesh;
  std::vector<Part>          parts;
  std::vector<double>        lower, upper, initial;
  std::vector<Limit>         all_limits;
};
} // namespace snug::shape

#endif
