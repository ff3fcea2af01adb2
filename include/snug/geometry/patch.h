#ifndef snug_geometry_patch_h
#define snug_geometry_patch_h

#include <snug/geometry/known_surface.h>

#include <boost/serialization/array.hpp>
#include <boost/serialization/base_object.hpp>
#include <boost/serialization/shared_ptr.hpp>
#include <boost/serialization/vector.hpp>

#include <array>
#include <functional>
#include <memory>
#include <vector>

namespace snug::geometry {
/// Surfaces to which a point is moved, and planes within which the point moves.
template <int dim>
struct GeometryConstraints
{
  std::vector<KnownSurface<dim>>      surfaces;
  std::vector<dealii::Tensor<1, dim>> planes; ///< unit normals
  /// curve or surface onto which points are projected first; null: none
  std::shared_ptr<const Projection<dim>> first = {};

  /// Return a point near the projection of @p x that lies on all surfaces and stays in the planes
  /// through @p x. The point is found by Newton's method with steps of minimum length. If surfaces
  /// are almost tangent at the point, only the first of these surfaces is used.
  dealii::Point<dim> onto(dealii::Point<dim> x) const;

  template <class Archive>
  void serialize(Archive &archive, const unsigned int /*version*/)
  {
    archive & surfaces & planes & first;
  }
};

/// A curve or a surface with its own coordinates. Curves use only the first coordinate, in [0,1].
template <int dim>
class Patch
{
public:
  virtual ~Patch() = default;

  virtual dealii::Point<dim> position(const dealii::Point<2> &at) const = 0;

  /// Factor on the distance from the straight edge or facet. The factor is below 1 only for patches
  /// of cells that would otherwise be too thin.
  double scale = 1.;

  template <class Archive>
  void serialize(Archive &archive, const unsigned int /*version*/)
  {
    archive & scale;
  }
};

/// The curve from a to b, x(t) = (1 - t) a + t b + t (1 - t) ((1 - t) c_0 + t c_1), moved onto the
/// constraints. A quadratic curve has c_0 = c_1 = 4 m, where m is the offset of the middle node
/// from the middle of the straight edge.
template <int dim>
class Curve : public Patch<dim>
{
public:
  using Point  = dealii::Point<dim>;
  using Vector = dealii::Tensor<1, dim>;

  Curve(const Point                 &a,
        const Point                 &b,
        const std::array<Vector, 2> &c,
        GeometryConstraints<dim>     constraints = {})
    : a(a), b(b), c(c), constraints(std::move(constraints))
  {}

  Point position(const dealii::Point<2> &at) const override;

  /// Return the offset of x(t) from the straight edge.
  Vector offset(double t) const;

  template <class Archive>
  void serialize(Archive &archive, const unsigned int /*version*/)
  {
    archive &boost::serialization::base_object<Patch<dim>>(*this) & a & b & c & constraints;
  }

private:
  friend class boost::serialization::access;
  Curve() = default; // of a curve that is received

  Point                    a, b;
  std::array<Vector, 2>    c;
  GeometryConstraints<dim> constraints;
};

/**
 * A facet of a boundary in 3D, bounded by curves. The coordinates of the corners, in cyclic order,
 * are (0,0), (1,0), (0,1) for triangles and (0,0), (1,0), (1,1), (0,1) for quadrilaterals. The
 * offsets d_e of the curves are blended (Coons; triangles: Szabo, Babuska, Finite Element
 * Analysis, 1991), which is the isoparametric map if the curves are quadratic:
 * @f[ x = \sum_i \lambda_i x_i + \sum_e w_e d_e(t_e) + 16 u(1-u)v(1-v) b. @f]
 * If the facet has a surface, the blended point is projected onto the surface, without the term
 * of b.
 */
class FacetPatch : public Patch<3>
{
public:
  using Point  = dealii::Point<3>;
  using Vector = dealii::Tensor<1, 3>;

  /// A curve from corner i to the next corner, or reversed; null for a straight side.
  struct Side
  {
    std::shared_ptr<const Curve<3>> curve;
    bool                            reversed = false;

    template <class Archive>
    void serialize(Archive &archive, const unsigned int /*version*/)
    {
      archive & curve & reversed;
    }
  };

  std::vector<Point>                   corners;
  std::vector<Side>                    sides;
  Vector                               bubble;  ///< b
  std::shared_ptr<const Projection<3>> surface; ///< null if the facet has no surface

  Point position(const dealii::Point<2> &at) const override;

  /// Return the coordinates of corner @p i of a facet with @p n corners.
  static dealii::Point<2> corner(unsigned int i, unsigned int n);

  /// Return the maximum distance of the curves from the surface, sampled at quarters of each curve.
  double gap() const;

  template <class Archive>
  void serialize(Archive &archive, const unsigned int /*version*/)
  {
    archive &boost::serialization::base_object<Patch<3>>(*this);
    archive & corners & sides & bubble & surface;
  }

private:
  Point  on_chord(unsigned int side, double t) const;
  Vector offset(unsigned int side, double t) const;
  Vector blended(const dealii::Point<2>                            &at,
                 const std::function<Vector(unsigned int, double)> &offsets) const;
};
} // namespace snug::geometry

#endif
