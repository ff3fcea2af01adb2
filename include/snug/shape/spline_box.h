#ifndef snug_shape_spline_box_h
#define snug_shape_spline_box_h

#include <snug/shape/shape_basis.h>
#include <snug/shape/spline.h>

namespace snug::shape {
/**
 * Free-form deformation: the nodes of some bodies inside a box move by
 *   u(x) = sum_i B_i(s) p_i,  s = (x - corner) / size,
 * with products B_i of Bernstein polynomials or B-splines along the axes
 * and the moves p_i of control points, which stand at their Greville
 * abscissae: points moved by an affine map move the box by that map.
 * Variables of a point: its moves along x, y, z, or along one direction.
 *
 * Where a side of the box cuts a body, the control points of that side
 * are frozen, so that the field is continuous. So are points that move no
 * node.
 *
 * Source: T. W. Sederberg, S. R. Parry, SIGGRAPH 1986.
 */
template <int dim>
class SplineBox : public Shape<dim>
{
public:
  using Field = typename ShapeBasis<dim>::Field;

  /// Splines of @p degree, or Bernstein polynomials if it is 0. Collective.
  /// @throws InputError naming the entry Bodies, Box corner, Box size,
  /// Control points or Direction. The mesh must outlive the box.
  SplineBox(const mesh::BodyMesh<dim> &mesh,
            const BodyNames           &bodies,
            const ShapeParameters     &parameters,
            unsigned int               degree);

  unsigned int              n_variables() const override;
  Field                     apply(const std::vector<double> &alpha) const override;
  std::vector<double>       transpose(const Field &gradient) const override;
  std::vector<Control<dim>> controls() const override;
  std::vector<std::pair<unsigned int, unsigned int>> faces() const override;

private:
  void find_nodes(const std::vector<bool> &is_wanted);
  void freeze_cut_sides(const std::vector<bool> &is_wanted);
  void freeze_idle_points();

  const mesh::BodyMesh<dim>          &mesh;
  SplineNet                           net;
  std::vector<dealii::Tensor<1, dim>> directions; ///< of each point
  dealii::Point<dim>                  corner;
  dealii::Tensor<1, dim>              size;
  std::vector<unsigned int>           nodes;  ///< inside, none hanging
  std::vector<std::vector<double>>    places; ///< s of nodes
  std::vector<bool>                   frozen; ///< control points
};

/// The entries Box corner and Box size. @throws InputError
template <int dim>
std::pair<dealii::Tensor<1, dim>, dealii::Tensor<1, dim>> box_of(const ShapeParameters &parameters);

/// Whether each body is in the entry Bodies; an empty one means all.
/// @throws InputError
std::vector<bool> wanted_bodies(const BodyNames &bodies, const ShapeParameters &parameters);

/// (body, boundary) of boundary faces with one of the local nodes marked,
/// of all ranks, ascending. Collective.
template <int dim>
std::vector<std::pair<unsigned int, unsigned int>>
boundaries_of(const mesh::BodyMesh<dim> &mesh, const std::vector<bool> &is_marked);
} // namespace snug::shape

#endif
