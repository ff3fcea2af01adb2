#ifndef snug_geometry_known_surface_h
#define snug_geometry_known_surface_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <string>

namespace snug::geometry {
/// What the surface of a boundary is, for the log.
struct BoundaryShape
{
  std::string name = "plane";
  /// How far facets, where contact sees them as they are, lie off what they stand for [length].
  double facet_height = 0.;
};

/**
 * A surface of revolution that faces may lie on: a sphere, in 3D also a
 * cylinder, a cone or a torus. In 2D a sphere is a circle. Normals at its
 * points are exact to rounding, as contact that may turn freely needs them.
 */
template <int dim>
class KnownSurface
{
public:
  enum class Kind
  {
    sphere,
    cylinder,
    cone,
    torus
  };

  using Point  = dealii::Point<dim>;
  using Vector = dealii::Tensor<1, dim>;

  Kind   kind = Kind::sphere;
  Point  centre;        ///< a point of the axis, the apex of a cone
  Vector axis;          ///< unit; of a cone from its apex into it; not of spheres
  double radius = 0.;   ///< of a torus that of its middle line [length]
  double tube   = 0.;   ///< radius of a torus' section [length]
  double angle  = 0.;   ///< between a cone's axis and its lines [radian]
  bool   convex = true; ///< the body is inside

  /// "circle", "cylinder", ...
  std::string name() const;

  /// Signed distance of @p x, positive outside of the body [length].
  double distance(const Point &x) const;

  /// Unit normal at the point closest to @p x, out of the body.
  Vector normal(const Point &x) const;

  /// The point closest to @p x.
  Point project(const Point &x) const { return x - distance(x) * normal(x); }

  /// The surface of the body at x' = s Q x + t.
  KnownSurface placed(double scale, const dealii::Tensor<2, dim> &Q, const Vector &shift) const;

private:
  /// From the sphere's centre, the axis or the torus' middle line to @p x.
  Vector lever(const Point &x) const;
};
} // namespace snug::geometry

#endif
