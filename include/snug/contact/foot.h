#ifndef snug_contact_foot_h
#define snug_contact_foot_h

#include <snug/contact/normal_rays.h>
#include <snug/contact/projection.h>

namespace snug::contact {
/**
 * This class computes the foot of a Projection as a function of positions. The foot moves within
 * its face: xi and t solve T (x(xi) + t v(xi) - x_s) = 0 at the given positions, and zeta is the
 * point where this ray meets the true surface. xi may leave [0,1] a little, so that all functions
 * are smooth. Coordinates of xi that equal those of nodes at the pairing are fixed: the choice of
 * the face beside such a foot is arbitrary, and derivatives would be one-sided. Where some
 * coordinates are fixed, T = (x,_xi + t v,_xi, v)' as paired; otherwise the solution does not
 * depend on T. Feet on nodes and feet without a ray are fixed altogether.
 */
template <int dim>
class Foot
{
public:
  using Field = typename mesh::Surface<dim>::Field;

  /// Derivatives of the weights of Place. For fixed feet, those of masters are zero and surface is
  /// empty.
  struct Slopes
  {
    Weights masters, surface;
  };

  /// This class is the foot at given positions and normals of the nodes of the master.
  class Place
  {
  public:
    /// Weights as in Projection, for the same nodes and points at all positions.
    Weights masters, surface;
    /// Distance of a moving foot off its face, as a fraction of the face; empty for fixed feet.
    std::optional<double> off_face;

    /// Return the derivatives of the weights along velocities of positions and normals.
    Slopes slopes(const Field &velocity, const Field &normal_velocity) const;

    /**
     * Apply the transpose of slopes(). Add the derivatives with respect to positions and normals of
     * a function whose derivatives with respect to the weights are @p by_masters and @p by_surface.
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
    typename Rays::Hit   hit; ///< only for faces with samples

    explicit Place(const Foot &foot) : foot(&foot) {}

    /// Return the inverse of the derivative of the equations with respect to xi and t.
    dealii::Tensor<2, dim> inverse() const
    {
      return dealii::invert(foot->equations.matrix(point.slope));
    }
  };

  /// Pair at @p positions, with @p normals of the nodes of the master. The references must outlive
  /// this object.
  Foot(const mesh::Surface<dim>    &surface,
       const faces::FaceShape<dim> &shape,
       const Projection<dim>       &projection,
       const Field                 &positions,
       const Field                 &normals);

  /// Return the foot at @p positions and @p normals.
  /// @throws TangledMesh where the foot is farther than a face off its face.
  Place at(const Field &positions, const Field &normals) const;

  const Projection<dim> paired;

private:
  const typename mesh::Surface<dim>::Face &face;
  const faces::FaceShape<dim>             &shape;
  dealii::Point<dim - 1>                   start; ///< xi, with round-off at nodes removed
  RayEquations<dim>                        equations;
  bool                                     follows;
  std::vector<unsigned int> taking_part; ///< indices in the face of the nodes with weights

  NormalRays<dim> rays(const Field &positions, const Field &normals) const
  {
    return {face, shape, positions, normals};
  }
};
} // namespace snug::contact

#endif
