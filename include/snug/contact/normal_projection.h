#ifndef snug_contact_normal_projection_h
#define snug_contact_normal_projection_h

#include <snug/contact/projection.h>
#include <snug/contact/projection_equations.h>
#include <snug/faces/point_field.h>

namespace snug::contact {
/// Surface nodes or points with their weights as numbers of a type.
template <typename Number>
using WeightsAs = std::vector<std::pair<unsigned int, Number>>;

/**
 * This class computes the weights of a Projection as functions of positions. The foot point moves
 * within its face: xi and t solve T (x(xi) + t v(xi) - x_s) = 0 at the given positions, with the
 * vector v of PairNormals, and zeta is the point where it meets the true surface. xi may leave
 * [0,1] a little, so that all functions are smooth. Coordinates of xi that equal those of nodes at
 * the pairing are fixed: the choice of the face beside such a foot point is arbitrary, and
 * derivatives would be one-sided. Where some coordinates are fixed, T = (x,_xi + t v,_xi, v)' as
 * paired; otherwise the solution does not depend on T. Foot points on nodes and projections without
 * a normal are fixed altogether.
 */
template <int dim>
class NormalProjection
{
public:
  using Field = typename mesh::Surface<dim>::Field;

  /// The projection at given positions and normals of the nodes.
  template <typename Number>
  struct Value
  {
    /// Weights as in Projection, for the same nodes and points at all positions.
    WeightsAs<Number> masters, surface;
    /// Unit normal into the master, n = -v / |v|.
    dealii::Tensor<1, dim, Number> normal;
    /// Distance of a moving foot point off its face, as a fraction of the face; empty if fixed.
    std::optional<double> off_face;
  };

  /// Pair at @p positions, with the @p normals of the nodes there. The references to the surface
  /// and the shape must outlive this object.
  NormalProjection(const mesh::Surface<dim>                &surface,
                   const faces::FaceShape<dim>             &shape,
                   const Projection<dim>                   &projection,
                   const Field                             &positions,
                   const typename PairNormals<dim>::Fields &normals);

  /// Return the projection at @p positions and @p normals, with exact derivatives.
  /// @throws TangledMesh where the foot point is farther than a face off its face, or where v = 0.
  template <typename Number>
  Value<Number> at(const faces::PointField<dim, Number> &positions,
                   const NormalFields<dim, Number>      &normals) const;

  const Projection<dim> paired;

private:
  using Equations = ProjectionEquations<dim>;

  const typename mesh::Surface<dim>::Face &face;
  const faces::FaceShape<dim>             &shape;
  dealii::Point<dim - 1>                   start; ///< xi, with round-off at nodes removed
  ReducedEquations<dim>                    reduced;
  bool                                     follows;
  std::vector<unsigned int> taking_part; ///< indices in the face of the nodes with weights

  Equations equations(const Field                  &positions,
                      const Field                  &normals,
                      const dealii::Tensor<1, dim> &of_slave) const
  {
    return {face, shape, positions, normals, of_slave};
  }

  template <typename Number>
  Value<Number>             weights(const faces::PointField<dim, Number> &positions,
                                    const NormalFields<dim, Number>      &normals) const;
  typename Equations::Point solve(const Field &positions, const Equations &equations) const;
  double                    off_face(const dealii::Point<dim - 1> &xi) const;
};
} // namespace snug::contact

#endif
