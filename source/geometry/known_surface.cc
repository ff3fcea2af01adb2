#include <snug/geometry/known_surface.h>

#include <cmath>

namespace snug::geometry {
template <int dim>
std::string KnownSurface<dim>::name() const
{
  switch (kind)
    {
      case Kind::cylinder:
        return "cylinder";
      case Kind::cone:
        return "cone";
      case Kind::torus:
        return "torus";
      case Kind::sphere:
        break;
    }
  return dim == 2 ? "circle" : "sphere";
}

template <int dim>
typename KnownSurface<dim>::Vector KnownSurface<dim>::lever(const Point &x) const
{
  Vector r = x - centre;
  if (kind == Kind::sphere)
    return r;
  const double along = r * axis;
  r -= along * axis;
  if (kind == Kind::torus)
    r += along * axis - radius / r.norm() * r;
  return r;
}

template <int dim>
typename KnownSurface<dim>::Vector KnownSurface<dim>::normal(const Point &x) const
{
  Vector       n      = lever(x);
  const double length = n.norm();
  // At the apex of a cone, and in the middle of other surfaces, the closest point is not unique.
  if (length > 0.)
    n /= length;
  // The normal is orthogonal to the line of the cone, cos(angle) axis + sin(angle) n.
  if (kind == Kind::cone)
    n = std::cos(angle) * n - std::sin(angle) * axis;
  return encloses_body ? n : -n;
}

template <int dim>
double KnownSurface<dim>::distance(const Point &x) const
{
  if (kind == Kind::cone)
    return (x - centre) * normal(x);
  const double outside = lever(x).norm() - (kind == Kind::torus ? tube : radius);
  return encloses_body ? outside : -outside;
}

template <int dim>
KnownSurface<dim> KnownSurface<dim>::placed(const double                  scale,
                                            const dealii::Tensor<2, dim> &Q,
                                            const Vector                 &shift) const
{
  KnownSurface result = *this;
  result.centre       = Point(Q * (scale * centre) + shift);
  result.axis         = Q * axis;
  result.radius *= scale;
  result.tube *= scale;
  return result;
}

template class KnownSurface<2>;
template class KnownSurface<3>;
} // namespace snug::geometry
