#ifndef snug_geometry_patch_h
#define snug_geometry_patch_h

#include <snug/geometry/known_surface.h>

#include <array>
#include <functional>
#include <memory>
#include <vector>

namespace snug::geometry {
/// Surfaces and planes that a point moves to and within.
template <int dim>
struct Guides
{
  std::vector<KnownSurface<dim>>      surfaces;
  std::vector<dealii::Tensor<1, dim>> planes; ///< unit normals

  /// The point near @p x on all surfaces whose planes are those of @p x: Newton's method with
  /// the shortest steps. Of surfaces that almost touch there, later ones do not count.
  dealii::Point<dim> onto(dealii::Point<dim> x) const;
};

/// A curve or a surface by coordinates of its own, of curves the first one in [0,1].
template <int dim>
class Patch
{
public:
  virtual ~Patch() = default;

  virtual dealii::Point<dim> position(const dealii::Point<2> &at) const = 0;

  /// Of the distance from the straight edge or facet; 1 but where cells were too thin.
  double scale = 1.;
};

/// From a to b: x(t) = (1 - t) a + t b + t (1 - t) ((1 - t) c_0 + t c_1), then moved onto guides.
/// c_0 = c_1 = 4 m of a quadratic curve whose middle node lies m from the middle.
template <int dim>
class Curve : public Patch<dim>
{
public:
  using Point  = dealii::Point<dim>;
  using Vector = dealii::Tensor<1, dim>;

  Curve(const Point &a, const Point &b, const std::array<Vector, 2> &c, Guides<dim> guides = {})
    : a(a), b(b), c(c), guides(std::move(guides))
  {}

  Point position(const dealii::Point<2> &at) const override;

  /// From the straight edge.
  Vector offset(double t) const;

private:
  Point                 a, b;
  std::array<Vector, 2> c;
  Guides<dim>           guides;
};

/**
 * A facet of a boundary in 3D, bounded by curves: coordinates of its corners, which go round, are
 * (0,0), (1,0), (0,1) of triangles, (0,0), (1,0), (1,1), (0,1) of quadrilaterals. Offsets d_e of
 * the curves are blended (Coons; triangles: Szabo, Babuska, Finite Element Analysis, 1991), which
 * is the isoparametric map if they are quadratic:
 * @f[ x = \sum_i \lambda_i x_i + \sum_e w_e d_e(t_e) + 16 u(1-u)v(1-v) b. @f]
 * On a surface that is projected onto it.
 */
class FacetPatch : public Patch<3>
{
public:
  using Point  = dealii::Point<3>;
  using Vector = dealii::Tensor<1, 3>;

  /// A curve from corner i to the next one, or back; null: straight.
  struct Side
  {
    std::shared_ptr<const Curve<3>> curve;
    bool                            reversed = false;
  };

  std::vector<Point>                     corners;
  std::vector<Side>                      sides;
  Vector                                 bubble;  ///< b
  std::shared_ptr<const KnownSurface<3>> surface; ///< null: none

  Point position(const dealii::Point<2> &at) const override;

  /// Coordinates of corner @p i of a facet with @p n.
  static dealii::Point<2> corner(unsigned int i, unsigned int n);

  /// Largest distance of the curves from the surface.
  double gap() const;

private:
  Point  on_chord(unsigned int side, double t) const;
  Vector offset(unsigned int side, double t) const;
  Vector blended(const dealii::Point<2>                            &at,
                 const std::function<Vector(unsigned int, double)> &offsets) const;
};
} // namespace snug::geometry

#endif
