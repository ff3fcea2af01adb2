#ifndef snug_contact_normal_rays_h
#define snug_contact_normal_rays_h

#include <snug/faces/face_shape.h>

#include <deal.II/base/symmetric_tensor.h>

#include <array>
#include <optional>

namespace snug::contact {
/**
 * Equations for the foot of a ray: T F = 0 for the residual F = x(xi) + t v(xi) - p. Equations of
 * fixed coordinates are left out.
 */
template <int dim>
struct RayEquations
{
  std::array<bool, dim - 1> fixed{};
  /// T: row a is the equation of xi_a, the last row is the equation of t
  dealii::Tensor<2, dim> rows = dealii::unit_symmetric_tensor<dim>();

  /// Return T F, with 0 for fixed coordinates.
  dealii::Tensor<1, dim> residual(const dealii::Tensor<1, dim> &F) const;
  /// Return the derivative of residual() with respect to xi and t, where @p slope is the derivative
  /// of F. The row of a fixed coordinate is that of dxi_a itself.
  dealii::Tensor<2, dim> matrix(const dealii::Tensor<2, dim> &slope) const;
  /// Apply the transpose of residual().
  dealii::Tensor<1, dim> residual_transpose(dealii::Tensor<1, dim> factors) const;
};

/**
 * This class provides the rays x(xi) + t v(xi) of a master face at given positions, where
 * v(xi) = sum_k N_k(xi) n_k with the nodal normals n_k.
 */
template <int dim>
class NormalRays
{
public:
  using Field = typename mesh::Surface<dim>::Field;
  using Face  = typename mesh::Surface<dim>::Face;
  using Xi    = typename faces::FaceShape<dim>::Coordinates;

  /// A point of a ray, with x measured from an origin.
  struct Point
  {
    typename faces::FaceShape<dim>::Values values; ///< N_k(xi)
    double                                 t = 0.;
    dealii::Tensor<1, dim>                 x, v;
    dealii::Tensor<2, dim>                 slope; ///< d/d(xi, t): columns x,_a + t v,_a and v
  };

  /// Intersection of a ray with the true surface: y(zeta) = x + s v.
  struct Hit
  {
    typename faces::FaceShape<dim>::Values values; ///< shape functions of the samples at zeta
    double                                 s = 0.;
    dealii::Tensor<2, dim> slope;      ///< derivative of y - x - s v with respect to zeta and s
    dealii::Tensor<2, dim> foot_slope; ///< derivative of x + s v, like slope of Point
  };

  /// Prepare the rays of @p face. The references must outlive this object.
  NormalRays(const Face                  &face,
             const faces::FaceShape<dim> &shape,
             const Field                 &positions,
             const Field                 &normals)
    : face(face), shape(shape), positions(positions), normals(normals)
  {}

  /// Return the point at @p xi and @p t. Without @p t, return the point of the ray closest to the
  /// origin.
  Point at(const Xi &xi, const dealii::Tensor<1, dim> &origin, std::optional<double> t = {}) const;

  /// Return the ray that leads to @p p, by Newton's method from @p xi. The coordinates of the
  /// result may lie outside of the face. Return nothing where the method does not converge.
  std::optional<Point>
  to(const dealii::Tensor<1, dim> &p, const Xi &xi, const RayEquations<dim> &equations = {}) const;

  /// Compute where the ray from @p xi meets the polynomial of the face's samples, by Newton's
  /// method.
  /// @throws TangledMesh where the ray does not meet the polynomial.
  Hit on_surface(const Xi &xi) const;

private:
  const Face                  &face;
  const faces::FaceShape<dim> &shape;
  const Field                 &positions, &normals;
};
} // namespace snug::contact

#endif
