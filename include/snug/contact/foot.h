#ifndef snug_contact_foot_h
#define snug_contact_foot_h

#include <snug/contact/normal_rays.h>
#include <snug/contact/projection.h>

namespace snug::contact {
/**
 * The foot of a Projection as a function of positions. It follows within
 * its face: xi and t solve T (x(xi) + t v(xi) - x_s) = 0 again, and zeta is
 * where this ray meets the true surface. xi may leave [0,1] a little, so
 * that all is smooth. Coordinates that were those of nodes stay: which face
 * lies beside such a foot is arbitrary, and derivatives would be one-sided.
 * Where some are fixed T = (x,_xi + t v,_xi, v)' as paired, else T does not
 * matter. Feet on nodes and those without a ray stay altogether.
 */
template <int dim>
class Foot
{
public:
  using Field = typename mesh::Surface<dim>::Field;

  /// Derivatives of the weights of Place: zeros, and no surface, for feet
  /// that stay.
  struct Slopes
  {
    Weights masters, surface;
  };

  /// The foot at given positions and normals of the master's nodes.
  class Place
  {
  public:
    /// As of Projection, always of the same nodes and points.
    Weights masters, surface;
    /// Of feet that follow: how far they have left their face, in parts of it.
    std::optional<double> off_face;

    /// Derivatives of the weights along velocities of positions and normals.
    Slopes slopes(const Field &velocity, const Field &normal_velocity) const;

    /**
     * Its transpose: adds derivatives by positions and by normals of a
     * function whose derivatives by the weights are @p by_masters and
     * @p by_surface.
     */
    void add_transpose(const std::vector<double> &by_masters,
                       const std::vector<double> &by_surface,
                       Field                     &gradient,
                       Field                     &normal_gradient) const;

  private:
    friend class Foot;
    using Rays = NormalRays<dim>;

    const Foot          *foot;
    typename Rays::Point point;
    typename Rays::Hit   hit; ///< of faces with samples

    explicit Place(const Foot &foot) : foot(&foot) {}

    /// Of the equations' derivative by xi and t.
    dealii::Tensor<2, dim> inverse() const
    {
      return dealii::invert(foot->equations.matrix(point.slope));
    }
  };

  /// Paired at @p positions, with @p normals of the master's nodes. The
  /// references must outlive this.
  Foot(const mesh::Surface<dim>    &surface,
       const faces::FaceShape<dim> &shape,
       const Projection<dim>       &projection,
       const Field                 &positions,
       const Field                 &normals);

  /// @throws TangledMesh where the foot is farther than a face off its face.
  Place at(const Field &positions, const Field &normals) const;

  const Projection<dim> paired;

private:
  const typename mesh::Surface<dim>::Face &face;
  const faces::FaceShape<dim>             &shape;
  dealii::Point<dim - 1>                   start; ///< xi, rounding at nodes taken off
  RayEquations<dim>                        equations;
  bool                                     follows;
  std::vector<unsigned int>                taking_part; ///< indices of nodes in the face

  NormalRays<dim> rays(const Field &positions, const Field &normals) const
  {
    return {face, shape, positions, normals};
  }
};
} // namespace snug::contact

#endif
