#ifndef snug_contact_normal_rays_h
#define snug_contact_normal_rays_h

#include <snug/faces/face_shape.h>

#include <deal.II/base/symmetric_tensor.h>

#include <array>
#include <optional>

namespace snug::contact {
/**
 * Which equations give the foot of a ray: T F = 0 for its residual F =
 * x(xi) + t v(xi) - p, without those of the coordinates that are fixed.
 */
template <int dim>
struct RayEquations
{
  std::array<bool, dim - 1> fixed{};
  /// T: of row a that of xi_a, the last one that of t
  dealii::Tensor<2, dim> rows = dealii::unit_symmetric_tensor<dim>();

  /// T F, 0 for fixed coordinates.
  dealii::Tensor<1, dim> residual(const dealii::Tensor<1, dim> &F) const;
  /// Its derivative by xi and t, @p slope that of F; of fixed coordinates dxi_a itself.
  dealii::Tensor<2, dim> matrix(const dealii::Tensor<2, dim> &slope) const;
  /// The transpose of residual().
  dealii::Tensor<1, dim> residual_transpose(dealii::Tensor<1, dim> factors) const;
};

/**
 * The rays x(xi) + t v(xi) of a master face, v(xi) = sum_k N_k(xi) n_k with
 * the nodal normals n_k, at given positions.
 */
template <int dim>
class NormalRays
{
public:
  using Field = typename mesh::Surface<dim>::Field;
  using Face  = typename mesh::Surface<dim>::Face;
  using Xi    = typename faces::FaceShape<dim>::Coordinates;

  /// A point of a ray; lengths from an origin.
  struct Point
  {
    typename faces::FaceShape<dim>::Values values; ///< N_k(xi)
    double                                 t = 0.;
    dealii::Tensor<1, dim>                 x, v;
    dealii::Tensor<2, dim>                 slope; ///< by xi and t: columns x,_a + t v,_a and v
  };

  /// Where a ray meets the true surface: y(zeta) = x + s v.
  struct Hit
  {
    typename faces::FaceShape<dim>::Values values; ///< of the samples at zeta
    double                                 s = 0.;
    dealii::Tensor<2, dim>                 slope;      ///< of y - x - s v by zeta and s
    dealii::Tensor<2, dim>                 foot_slope; ///< of x + s v, as of Point
  };

  /// The references must outlive this.
  NormalRays(const Face                  &face,
             const faces::FaceShape<dim> &shape,
             const Field                 &positions,
             const Field                 &normals)
    : face(face), shape(shape), positions(positions), normals(normals)
  {}

  /// The point at @p xi and @p t; no t: the one of the ray closest to the origin.
  Point at(const Xi &xi, const dealii::Tensor<1, dim> &origin, std::optional<double> t = {}) const;

  /// The ray that leads to @p p, by Newton's method from @p xi, at any
  /// coordinates; none where it does not converge.
  std::optional<Point>
  to(const dealii::Tensor<1, dim> &p, const Xi &xi, const RayEquations<dim> &equations = {}) const;

  /// Where the ray from @p xi meets the polynomial of the face's samples,
  /// by Newton's method.
  /// @throws TangledMesh where it does not.
  Hit on_surface(const Xi &xi) const;

private:
  const Face                  &face;
  const faces::FaceShape<dim> &shape;
  const Field                 &positions, &normals;
};
} // namespace snug::contact

#endif
