#ifndef snug_contact_projection_equations_h
#define snug_contact_projection_equations_h

#include <snug/faces/face_shape.h>

#include <deal.II/base/symmetric_tensor.h>

#include <array>
#include <optional>

namespace snug::contact {
/**
 * The equations T F = 0 of a projection, for the residual F = x(xi) + t v(xi) - p. Equations of
 * fixed coordinates are left out.
 */
template <int dim>
struct ReducedEquations
{
  std::array<bool, dim - 1> fixed{};
  /// T: row a is the equation of xi_a, the last row is the equation of t
  dealii::Tensor<2, dim> rows = dealii::unit_symmetric_tensor<dim>();

  /// Return T F, with 0 for fixed coordinates.
  template <typename Number>
  dealii::Tensor<1, dim, Number> residual(const dealii::Tensor<1, dim, Number> &F) const
  {
    dealii::Tensor<1, dim, Number> result = rows * F;
    for (int a = 0; a < dim - 1; ++a)
      if (fixed[a])
        result[a] = 0.;
    return result;
  }

  /// Return the derivative of residual() with respect to xi and t, where @p slope is the derivative
  /// of F. The row of a fixed coordinate is that of dxi_a itself.
  dealii::Tensor<2, dim> matrix(const dealii::Tensor<2, dim> &slope) const;
};

/**
 * This class provides the equations of projections to a master face at given positions. A point p
 * is projected to x(xi) along v(xi) = sum_k N_k(xi) n_k - n_p: p = x(xi) + t v(xi). n_k are the
 * nodal normals of the face. n_p is the normal of the slave at p where points are paired along the
 * mean of both normals (PairNormals), and 0 where they are paired along the normal of the face.
 */
template <int dim>
class ProjectionEquations
{
public:
  using Field = typename mesh::Surface<dim>::Field;
  using Face  = typename mesh::Surface<dim>::Face;
  using Xi    = typename faces::FaceShape<dim>::Coordinates;

  /// A point x + t v on a normal, with x measured from an origin.
  struct Point
  {
    typename faces::FaceShape<dim>::Values values; ///< N_k(xi)
    double                                 t = 0.;
    dealii::Tensor<1, dim>                 x, v;
    dealii::Tensor<2, dim>                 slope; ///< d/d(xi, t): columns x,_a + t v,_a and v
  };

  /// Intersection of a normal with the true surface: y(zeta) = x + s v.
  struct Intersection
  {
    typename faces::FaceShape<dim>::Values values; ///< shape functions of the samples at zeta
    double                                 s = 0.;
    dealii::Tensor<2, dim> slope;       ///< derivative of y - x - s v with respect to zeta and s
    dealii::Tensor<2, dim> point_slope; ///< derivative of x + s v, like slope of Point
  };

  /// Prepare the equations of @p face for points with the normal @p of_slave, n_p. The references
  /// must outlive this object.
  ProjectionEquations(const Face                   &face,
                      const faces::FaceShape<dim>  &shape,
                      const Field                  &positions,
                      const Field                  &normals,
                      const dealii::Tensor<1, dim> &of_slave = {})
    : face(face), shape(shape), positions(positions), normals(normals), of_slave(of_slave)
  {}

  /// Return the point at @p xi and @p t. Without @p t, return the point of the normal closest to
  /// the origin.
  Point at(const Xi &xi, const dealii::Tensor<1, dim> &origin, std::optional<double> t = {}) const;

  /// Return the point whose normal leads to @p p, by Newton's method from @p xi. The coordinates of
  /// the result may lie outside of the face. Return nothing where the method does not converge.
  std::optional<Point> solve(const dealii::Tensor<1, dim> &p,
                             const Xi                     &xi,
                             const ReducedEquations<dim>  &equations = {}) const;

  /// Compute where the normal at @p xi meets the polynomial of the face's samples, by Newton's
  /// method.
  /// @throws TangledMesh where the normal does not meet the polynomial.
  Intersection intersection(const Xi &xi) const;

private:
  const Face                  &face;
  const faces::FaceShape<dim> &shape;
  const Field                 &positions, &normals;
  dealii::Tensor<1, dim>       of_slave; ///< n_p
};
} // namespace snug::contact

#endif
