#ifndef snug_geometry_known_surface_h
#define snug_geometry_known_surface_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <boost/serialization/void_cast.hpp>

#include <memory>
#include <string>

namespace snug::geometry {
/// This struct describes the surface of a boundary. The log states it, and warnings and advice
/// depend on it.
struct BoundaryShape
{
  std::string name = "plane";
  /// maximum distance of facets from the smooth surface that they approximate, if contact uses the
  /// facets themselves [length]
  double facet_height = 0.;

  template <class Archive>
  void serialize(Archive &archive, const unsigned int /*version*/)
  {
    archive & name & facet_height;
  }
};

/// This class is a curve or a surface onto which points are projected.
template <int dim>
class Projection
{
public:
  virtual ~Projection() = default;

  /// Return the point of the curve or surface that is closest to @p x.
  virtual dealii::Point<dim> project(const dealii::Point<dim> &x) const = 0;
};

/// This class is a curve or a surface of a CAD part. Ranks send its number, because every rank can
/// make the shape from the part.
template <int dim>
class PartProjection : public Projection<dim>
{
public:
  unsigned int                           number = 0; ///< among the curves and surfaces of the part
  std::shared_ptr<const Projection<dim>> shape  = {};

  dealii::Point<dim> project(const dealii::Point<dim> &x) const override
  {
    return shape->project(x);
  }

  template <class Archive>
  void serialize(Archive &archive, const unsigned int /*version*/)
  {
    boost::serialization::void_cast_register<PartProjection, Projection<dim>>();
    archive & number;
  }
};

/**
 * This class is a surface of revolution on which faces may lie: a sphere, in 3D also a
 * cylinder, a cone or a torus. In 2D a sphere is a circle. Normals at points of the
 * surface are exact up to round-off, as contact of bodies that may rotate freely requires.
 */
template <int dim>
class KnownSurface : public Projection<dim>
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
  Point  centre; ///< centre of a sphere or torus, point of a cylinder axis, apex of a cone
  Vector axis;   ///< unit vector, of a cone from the apex inwards; unused by spheres
  double radius        = 0.;   ///< radius, of a torus the radius of the middle circle [length]
  double tube          = 0.;   ///< radius of the section of a torus [length]
  double angle         = 0.;   ///< angle between the axis and the lines of a cone [radian]
  bool   encloses_body = true; ///< false if the body surrounds the surface, as around a hole

  /// Return the name "circle", "cylinder", ...
  std::string name() const;

  /// Return the signed distance of @p x, positive outside of the body [length].
  double distance(const Point &x) const;

  /// Return the outward unit normal of the body at the point closest to @p x.
  Vector normal(const Point &x) const;

  Point project(const Point &x) const override { return x - distance(x) * normal(x); }

  /// Return the surface after the placement x' = s Q x + t of the body.
  KnownSurface placed(double scale, const dealii::Tensor<2, dim> &Q, const Vector &shift) const;

  template <class Archive>
  void serialize(Archive &archive, const unsigned int /*version*/)
  {
    boost::serialization::void_cast_register<KnownSurface, Projection<dim>>();
    archive & kind & centre & axis & radius & tube & angle & encloses_body;
  }

private:
  /// Return the vector to @p x from the closest point of the centre of a sphere, the axis, or the
  /// middle circle of a torus.
  Vector lever(const Point &x) const;
};
} // namespace snug::geometry

#endif
