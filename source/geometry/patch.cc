#include <snug/geometry/patch.h>

#include <algorithm>
#include <cmath>

namespace snug::geometry {
template <int dim>
dealii::Point<dim> GeometryConstraints<dim>::onto(dealii::Point<dim> x) const
{
  using Vector = dealii::Tensor<1, dim>;
  // For surfaces at an angle below 6 degrees, the last digits of the surfaces would determine their
  // intersection.
  const double touching = 0.1;
  if (first)
    x = first->project(x);
  for (unsigned int turn = 0; turn < 30; ++turn)
    {
      std::vector<Vector> directions; // orthonormal, planes first
      const auto          add = [&](Vector n) {
        for (const auto &e : directions)
          n -= (n * e) * e;
        const bool counts = n.norm() > touching;
        if (counts)
          directions.push_back(n / n.norm());
        return counts;
      };
      for (const auto &n : planes)
        add(n);
      const std::size_t n_planes = directions.size();
      // In the basis of the directions, the matrix of the normals is triangular.
      Vector step;
      double largest = 0.;
      for (const auto &surface : surfaces)
        {
          const Vector n = surface.normal(x);
          if (!add(n))
            continue;
          const double d = surface.distance(x) + step * n;
          largest        = std::max(largest, std::abs(d) / x.distance(surface.centre));
          step -= d / (n * directions.back()) * directions.back();
        }
      x += step;
      // One step onto a single surface is exact. With several surfaces or planes, the point is
      // exact up to round-off after a step of relative size 1e-8.
      if ((surfaces.size() == 1 && n_planes == 0) || largest < 1e-8)
        break;
    }
  return x;
}

template <int dim>
dealii::Tensor<1, dim> Curve<dim>::offset(const double t) const
{
  const Point chord  = Point((1. - t) * a + t * b);
  Vector      result = t * (1. - t) * ((1. - t) * c[0] + t * c[1]);
  if (constraints.first || !constraints.surfaces.empty())
    result = constraints.onto(chord + result) - chord;
  return this->scale == 1. ? result : this->scale * result;
}

template <int dim>
dealii::Point<dim> Curve<dim>::position(const dealii::Point<2> &at) const
{
  return Point((1. - at[0]) * a + at[0] * b) + offset(at[0]);
}

dealii::Point<2> FacetPatch::corner(const unsigned int i, const unsigned int n)
{
  return {i == 1 || (n == 4 && i == 2) ? 1. : 0., i >= 2 ? 1. : 0.};
}

FacetPatch::Point FacetPatch::on_chord(const unsigned int side, const double t) const
{
  return Point((1. - t) * corners[side] + t * corners[(side + 1) % corners.size()]);
}

FacetPatch::Vector FacetPatch::offset(const unsigned int side, const double t) const
{
  const Side &own = sides[side];
  return own.curve ? own.curve->offset(own.reversed ? 1. - t : t) : Vector();
}

FacetPatch::Vector
FacetPatch::blended(const dealii::Point<2>                            &at,
                    const std::function<Vector(unsigned int, double)> &offsets) const
{
  const double u = at[0], v = at[1];
  Vector       result;
  if (corners.size() == 4)
    return (1. - v) * offsets(0, u) + u * offsets(1, v) + v * offsets(2, 1. - u) +
           (1. - u) * offsets(3, 1. - v);
  const std::array<double, 3> lambda = {{1. - u - v, u, v}};
  for (unsigned int i = 0; i < 3; ++i)
    {
      const double a = lambda[i], b = lambda[(i + 1) % 3], rest = 0.5 * lambda[(i + 2) % 3];
      // The ends would give 0 / 0 and are skipped, because the offset is 0 at the ends.
      if (a > 0. && b > 0.)
        result += a * b / ((a + rest) * (b + rest)) * offsets(i, b + rest);
    }
  return result;
}

FacetPatch::Point FacetPatch::position(const dealii::Point<2> &at) const
{
  const double u = at[0], v = at[1];
  Point x = corners.size() == 3 ? Point((1. - u - v) * corners[0] + u * corners[1] + v * corners[2])
                                : Point((1. - v) * ((1. - u) * corners[0] + u * corners[1]) +
                                        v * ((1. - u) * corners[3] + u * corners[2]));
  x += blended(at, [&](const unsigned int side, const double t) { return offset(side, t); });
  if (surface)
    {
      // The blended term keeps the positions of curves that do not lie on the surface.
      const Point on = surface->project(x) + blended(at, [&](const unsigned int e, const double t) {
                         const Point own = on_chord(e, t) + offset(e, t);
                         return own - surface->project(own);
                       });
      return scale == 1. ? on : Point(x + scale * (on - x));
    }
  return x + scale * 16. * u * (1. - u) * v * (1. - v) * bubble;
}

double FacetPatch::gap() const
{
  double result = 0.;
  for (unsigned int e = 0; e < sides.size(); ++e)
    for (const double t : {0., 0.25, 0.5, 0.75})
      {
        const Point x = on_chord(e, t) + offset(e, t);
        result        = std::max(result, x.distance(surface->project(x)));
      }
  return result;
}

template struct GeometryConstraints<2>;
template struct GeometryConstraints<3>;
template class Curve<2>;
template class Curve<3>;
} // namespace snug::geometry
