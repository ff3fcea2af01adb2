#include <snug/shape/profile.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace snug::shape {
namespace {
using Vector  = dealii::Tensor<1, 3>;
using Section = dealii::Tensor<1, 2>;

/// Points at a smaller part of the maximum radius lie on the axis.
const double on_axis = 1e-9;

/// Numbers at points that are determined by their differences along edges.
struct Potential
{
  std::vector<double> values;
  double              period    = 0.; ///< difference along closed paths; 0 if there is none
  unsigned int        n_reached = 0;
};

/// Add up @p differences along the edges of a breadth-first tree from the first point of the first
/// edge. The edges that close a path around a closed face have the period left over.
Potential integrate(const unsigned int                                        n_points,
                    const std::vector<std::pair<unsigned int, unsigned int>> &edges,
                    const std::vector<double>                                &differences)
{
  std::vector<std::vector<std::pair<unsigned int, double>>> neighbours(n_points);
  for (unsigned int k = 0; k < edges.size(); ++k)
    {
      neighbours[edges[k].first].emplace_back(edges[k].second, differences[k]);
      neighbours[edges[k].second].emplace_back(edges[k].first, -differences[k]);
    }
  Potential result;
  result.values.resize(n_points, 0.);
  std::vector<bool>         reached(n_points, false);
  std::vector<unsigned int> queue = {edges.front().first};
  reached[queue.front()]          = true;
  for (unsigned int next = 0; next < queue.size(); ++next)
    for (const auto &[neighbour, difference] : neighbours[queue[next]])
      if (!reached[neighbour])
        {
          reached[neighbour]       = true;
          result.values[neighbour] = result.values[queue[next]] + difference;
          queue.push_back(neighbour);
        }
  result.n_reached      = queue.size();
  const auto [low, top] = std::minmax_element(result.values.begin(), result.values.end());
  double       sum      = 0.;
  unsigned int n        = 0;
  for (unsigned int k = 0; k < edges.size(); ++k)
    {
      const double left =
        std::abs(result.values[edges[k].first] + differences[k] - result.values[edges[k].second]);
      if (left > 0.5 * (*top - *low))
        {
          sum += left;
          ++n;
        }
    }
  result.period = n == 0 ? 0. : sum / n;
  return result;
}

/// Return @p value in [0, period), without round-off at the ends.
double wrapped(const double value, const double period)
{
  const double result = value - period * std::floor(value / period);
  return result > (1. - 1e-9) * period || result < 1e-9 * period ? 0. : result;
}

/// The points of a face in the plane of its profile, with their normals.
struct Profile
{
  std::vector<Section> positions, normals;
  /// per point: the end of an open profile with the smaller key is its beginning
  FacePoints::Field keys;
};

/// Return the arc length from point i to point j, see meridian_length().
double arc(const Profile &profile, const unsigned int i, const unsigned int j)
{
  const Section &a = profile.normals[i], &b = profile.normals[j];
  Section        mean = a + b;
  if (mean.norm() < 1e-3)
    mean = a;
  mean /= mean.norm();
  const double  half  = 0.5 * std::atan2(std::abs(a[0] * b[1] - a[1] * b[0]), a * b);
  const Section chord = profile.positions[j] - profile.positions[i];
  return (mean[0] * chord[1] - mean[1] * chord[0]) * (half < 1e-8 ? 1. : half / std::sin(half));
}

/// Return the number of an arc length at which the angle about the centre of a closed profile is
/// @p start, and whether the arc length increases with the angle.
std::pair<double, bool> beginning(const FacePoints          &face,
                                  const Profile             &profile,
                                  const std::vector<double> &values,
                                  const std::vector<double> &arcs,
                                  const double               start)
{
  Section centre;
  for (const auto &position : profile.positions)
    centre += position / double(profile.positions.size());
  const auto polar = [&](const unsigned int point) {
    const Section lever = profile.positions[point] - centre;
    return std::remainder(std::atan2(lever[1], lever[0]) - start, 2. * dealii::numbers::PI);
  };
  double farthest = -1., zero = 0., turn = 0.;
  for (unsigned int k = 0; k < face.edges.size(); ++k)
    {
      const auto [i, j] = face.edges[k];
      const double a = polar(i), b = polar(j);
      turn += std::remainder(b - a, 2. * dealii::numbers::PI) * arcs[k];
      // The ray from the centre may cross the profile several times.
      const double distance = (profile.positions[i] - centre).norm();
      if (std::abs(a) < 1.5 && std::abs(b) < 1.5 && a * b <= 0. && a != b && distance > farthest)
        {
          farthest = distance;
          zero     = values[i] + arcs[k] * a / (a - b);
        }
    }
  return {zero, turn > 0.};
}

/// Return the arc length of a profile.
std::optional<FaceCoordinate>
arc_length(const FacePoints &face, const Profile &profile, const double start)
{
  std::vector<double> arcs;
  for (const auto &[i, j] : face.edges)
    arcs.push_back(arc(profile, i, j));
  auto potential = integrate(face.positions.size(), face.edges, arcs);
  if (potential.n_reached < face.positions.size())
    return {};
  FaceCoordinate result;
  auto          &s = result.values = potential.values;
  result.closed                    = potential.period > 0.;
  if (result.closed)
    {
      result.range                 = potential.period;
      const auto [zero, increases] = beginning(face, profile, s, arcs, start);
      for (double &value : s)
        value = wrapped(increases ? value - zero : zero - value, result.range);
      return result;
    }
  const auto [low, top] = std::minmax_element(s.begin(), s.end());
  const double lower = *low, upper = *top;
  result.range        = upper - lower;
  const Vector ahead  = profile.keys[top - s.begin()] - profile.keys[low - s.begin()];
  bool         turned = false;
  for (unsigned int d = 3; d-- > 0;)
    if (std::abs(ahead[d]) > 1e-6 * result.range)
      turned = ahead[d] < 0.;
  for (double &value : s)
    value = turned ? upper - value : value - lower;
  return result;
}
} // namespace

std::optional<FaceCoordinate> angle(const FacePoints &face, const Axis &axis, const double start)
{
  const Vector e1 = reference_direction(axis.direction), e2 = cross_product_3d(axis.direction, e1);
  std::vector<double> theta, radius;
  for (const auto &position : face.positions)
    {
      const Vector lever = position - axis.point;
      theta.push_back(std::atan2(lever * e2, lever * e1) - start);
      radius.push_back(std::hypot(lever * e1, lever * e2));
    }
  const double        largest   = *std::max_element(radius.begin(), radius.end());
  const auto          has_angle = [&](unsigned int i) { return radius[i] > on_axis * largest; };
  std::vector<double> differences;
  std::vector<std::pair<unsigned int, unsigned int>> edges;
  for (const auto &edge : face.edges)
    if (has_angle(edge.first) && has_angle(edge.second))
      {
        edges.push_back(edge);
        differences.push_back(
          std::remainder(theta[edge.second] - theta[edge.first], 2. * dealii::numbers::PI));
      }
  auto           potential    = integrate(face.positions.size(), edges, differences);
  unsigned int   n_with_angle = 0, first = 0;
  double         area = 0.;
  FaceCoordinate result;
  result.unit         = 0.;
  result.minimum_unit = *std::min_element(radius.begin(), radius.end());
  double lower = std::numeric_limits<double>::max(), upper = -lower;
  for (unsigned int i = 0; i < radius.size(); ++i)
    {
      result.unit += face.areas[i] * radius[i];
      area += face.areas[i];
      if (!has_angle(i))
        continue;
      ++n_with_angle;
      if (potential.values[i] < lower)
        first = i;
      lower = std::min(lower, potential.values[i]);
      upper = std::max(upper, potential.values[i]);
    }
  result.unit /= area;
  if (potential.n_reached < n_with_angle)
    return {};
  result.closed = potential.period > 0.;
  result.range  = result.closed ? 2. * dealii::numbers::PI : upper - lower;
  result.lower  = result.closed ? start : theta[first] + start;
  for (unsigned int i = 0; i < radius.size(); ++i)
    result.values.push_back(!has_angle(i)   ? 0.
                            : result.closed ? wrapped(theta[i], result.range)
                                            : potential.values[i] - lower);
  return result;
}

std::optional<FaceCoordinate>
meridian_length(const FacePoints &face, const Axis &axis, const double start)
{
  Profile profile;
  for (unsigned int i = 0; i < face.positions.size(); ++i)
    {
      const Vector lever = face.positions[i] - axis.point;
      const double z     = lever * axis.direction;
      Vector       along = lever - z * axis.direction;
      const double r     = along.norm();
      if (r > 0.)
        along /= r;
      Section q, n;
      q[0] = r;
      q[1] = z;
      n[0] = face.normals[i] * along;
      n[1] = face.normals[i] * axis.direction;
      Vector key;
      key[0] = z;
      key[1] = r;
      profile.positions.push_back(q);
      profile.normals.push_back(n / std::max(n.norm(), std::numeric_limits<double>::min()));
      profile.keys.push_back(key);
    }
  return arc_length(face, profile, start);
}

std::optional<FaceCoordinate>
profile_length(const FacePoints &face, const Vector &direction, const double start)
{
  const Vector e1 = reference_direction(direction), e2 = cross_product_3d(direction, e1);
  Profile      profile;
  for (unsigned int i = 0; i < face.positions.size(); ++i)
    {
      const auto &x = face.positions[i], &n = face.normals[i];
      Section     q, normal;
      q[0]      = x * e1;
      q[1]      = x * e2;
      normal[0] = n * e1;
      normal[1] = n * e2;
      profile.positions.push_back(q);
      profile.normals.push_back(normal / normal.norm());
      profile.keys.push_back(x - (x * direction) * direction);
    }
  return arc_length(face, profile, start);
}

FaceCoordinate position_along(const FacePoints &face, const Vector &direction)
{
  FaceCoordinate result;
  for (const auto &position : face.positions)
    result.values.push_back(position * direction);
  const auto [low, top] = std::minmax_element(result.values.begin(), result.values.end());
  result.lower          = *low;
  result.range          = *top - result.lower;
  for (double &value : result.values)
    value -= result.lower;
  return result;
}

} // namespace snug::shape
