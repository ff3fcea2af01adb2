#include <snug/mesh_file/body_surface.h>

#include <cmath>

namespace snug::mesh_file {
namespace {
/// Return the angle between unit vectors [radian], accurate to rounding also if the angle is small.
template <int dim>
double angle(const dealii::Tensor<1, dim> &a, const dealii::Tensor<1, dim> &b)
{
  return 2. * std::asin(std::min(1., (a - b).norm() / 2.));
}

const double plane_angle = 1e-7; ///< [radian]
} // namespace

template <int dim>
BodySurface<dim>::BodySurface(std::vector<Point>            the_points,
                              Middles                       the_middles,
                              std::vector<Facet>            the_facets,
                              const std::set<unsigned int> &smooth)
  : points(std::move(the_points)), middles(std::move(the_middles)), facets(std::move(the_facets))
{
  for (unsigned int f = 0; f < facets.size(); ++f)
    {
      for (const unsigned int node : facets[f].corners)
        {
          facets_at[node].push_back(f);
          size = std::max(size, points[node].distance(points[facets[0].corners[0]]));
        }
      for (const Corners &ridge : ridges_of(f))
        ridges[ridge].facets.push_back(f);
    }
  for (auto &ridge : ridges)
    ridge.second.is_feature = stands_out(ridge.first, smooth);
  divide();
  find_flats();
}

template <int dim>
std::vector<std::vector<unsigned int>> BodySurface<dim>::edges(const unsigned int facet) const
{
  const Corners       &c = facets[facet].corners;
  std::vector<Corners> result;
  for (unsigned int i = 0; i < (dim == 2 ? 1 : c.size()); ++i)
    result.push_back(geometry::sorted({c[i], c[(i + 1) % c.size()]}));
  return result;
}

template <int dim>
std::vector<std::vector<unsigned int>> BodySurface<dim>::ridges_of(const unsigned int facet) const
{
  const Corners &c = facets[facet].corners;
  if (dim == 2)
    return {{c[0]}, {c[1]}};
  return edges(facet);
}

template <int dim>
bool BodySurface<dim>::is_quadratic(const unsigned int facet) const
{
  const auto own = edges(facet);
  return std::all_of(own.begin(), own.end(),
                     [&](const Corners &edge) { return middles.count(edge) > 0; });
}

template <int dim>
std::array<dealii::Tensor<1, dim>, 2> BodySurface<dim>::quadratic(const Corners &edge) const
{
  const auto found = middles.find(edge);
  if (found == middles.end())
    return {};
  const Vector m = points[found->second] - 0.5 * (points[edge[0]] + points[edge[1]]);
  // The edge is straight up to rounding.
  if (m.norm() <= 1e-13 * size)
    return {};
  return {{4. * m, 4. * m}};
}

template <int dim>
dealii::Point<dim> BodySurface<dim>::centre(const unsigned int facet) const
{
  Point sum;
  for (const unsigned int node : facets[facet].corners)
    sum += points[node] / double(facets[facet].corners.size());
  return sum;
}

template <>
dealii::Tensor<1, 2> BodySurface<2>::normal(const unsigned int facet) const
{
  const auto  &c = facets[facet].corners;
  const Vector t = (points[c[1]] - points[c[0]]) / points[c[1]].distance(points[c[0]]);
  return Vector({t[1], -t[0]});
}

template <>
dealii::Tensor<1, 3> BodySurface<3>::normal(const unsigned int facet) const
{
  const auto  &c = facets[facet].corners;
  const Vector n = cross_product_3d(points[c.back()] - points[c[1]], points[c[2]] - points[c[0]]);
  return n / n.norm();
}

template <>
dealii::Tensor<1, 2> BodySurface<2>::normal_at(const unsigned int facet, const Corners &node) const
{
  const auto  &c = facets[facet].corners;
  const Vector d = (node[0] == c[0] ? 1. : -1.) * quadratic(geometry::sorted(c))[0];
  const Vector t = points[c[1]] - points[c[0]] + d;
  return Vector({t[1], -t[0]}) / t.norm();
}

template <>
dealii::Tensor<1, 3> BodySurface<3>::normal_at(const unsigned int facet, const Corners &edge) const
{
  const auto          &c = facets[facet].corners;
  geometry::FacetPatch patch;
  unsigned int         side = 0;
  for (unsigned int i = 0; i < c.size(); ++i)
    {
      patch.corners.push_back(points[c[i]]);
      const Corners own = geometry::sorted({c[i], c[(i + 1) % c.size()]});
      if (own == edge)
        side = i;
      patch.sides.push_back(
        {std::make_shared<geometry::Curve<3>>(points[own[0]], points[own[1]], quadratic(own)),
         own[0] != c[i]});
    }
  // The normal is the cross product of the derivatives across the edge, at its middle, and along
  // the edge.
  const auto corner = [&](const unsigned int i) {
    return geometry::FacetPatch::corner((side + i) % c.size(), c.size());
  };
  const dealii::Point<2> from(0.5 * (corner(0) + corner(1)));
  const dealii::Point<2> to(c.size() == 3 ? corner(2) : 0.5 * (corner(2) + corner(3)));
  const Vector           across = 4. * patch.position(dealii::Point<2>(0.5 * (from + to))) -
                        3. * patch.position(from) - Vector(patch.position(to));
  const Vector n = cross_product_3d(across, points[c[(side + 1) % c.size()]] - points[c[side]]);
  return n / n.norm();
}

template <int dim>
double BodySurface<dim>::kink(const Corners &ridge) const
{
  const auto &at = ridges.at(ridge).facets;
  return angle(normal_at(at[0], ridge), normal_at(at[1], ridge)) * 180. / M_PI;
}

template <int dim>
bool BodySurface<dim>::stands_out(const Corners &ridge, const std::set<unsigned int> &smooth) const
{
  const auto &at = ridges.at(ridge).facets;
  if (at.size() != 2 || facets[at[0]].boundary != facets[at[1]].boundary ||
      facets[at[0]].face != facets[at[1]].face)
    return true;
  if (facets[at[0]].face != Facet::no_face)
    return false;
  return smooth.count(facets[at[0]].boundary) == 0 && kink(ridge) > 30.;
}

template <int dim>
void BodySurface<dim>::divide()
{
  std::vector<std::vector<unsigned int>> beside(facets.size());
  for (const auto &entry : ridges)
    if (!entry.second.is_feature)
      {
        const auto &at = entry.second.facets;
        beside[at[0]].push_back(at[1]);
        beside[at[1]].push_back(at[0]);
      }
  const unsigned int none = static_cast<unsigned int>(-1);
  part_of.assign(facets.size(), none);
  for (unsigned int first = 0; first < facets.size(); ++first)
    if (part_of[first] == none)
      {
        std::vector<unsigned int> part = {first};
        part_of[first]                 = parts.size();
        for (unsigned int k = 0; k < part.size(); ++k)
          for (const unsigned int f : beside[part[k]])
            if (part_of[f] == none)
              {
                part_of[f] = parts.size();
                part.push_back(f);
              }
        parts.push_back(part);
      }
}

/// Find the plane regions. A single pair of facets in one plane is no region, because it may be an
/// inflection or a quadrilateral that was split into triangles. A region needs a facet in whose
/// plane all of its neighbours lie.
template <int dim>
void BodySurface<dim>::find_flats()
{
  std::vector<Vector> normals;
  for (unsigned int f = 0; f < facets.size(); ++f)
    normals.push_back(normal(f));
  const auto in_plane = [&](const unsigned int f, const unsigned int g) {
    return part_of[f] == part_of[g] && angle(normals[f], normals[g]) < plane_angle;
  };
  is_flat.assign(facets.size(), false);
  for (unsigned int f = 0; f < facets.size(); ++f)
    {
      bool core = true;
      for (const unsigned int node : facets[f].corners)
        for (const unsigned int g : facets_at[node])
          core = core && (part_of[f] != part_of[g] || in_plane(f, g));
      if (core)
        for (const unsigned int node : facets[f].corners)
          for (const unsigned int g : facets_at[node])
            if (in_plane(f, g))
              is_flat[g] = true;
    }
}

template class BodySurface<2>;
template class BodySurface<3>;
} // namespace snug::mesh_file
