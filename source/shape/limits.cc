#include <snug/base/errors.h>
#include <snug/shape/limits.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace snug::shape {
namespace {
/// Minimum part of the length of an edge of the mesh along a coordinate for which the edge measures
/// the curvature along this coordinate.
const double along_coordinate = 0.9;

/// Return 1 or -1, the sign of the component of the directions along the outward normals.
/// @throws InputError naming @p entry if the sign is not the same on the whole face.
template <int dim>
double outward_sign(const ShapedFace<dim>                 &face,
                    const typename ShapedFace<dim>::Field &directions,
                    const ShapeParameters                 &parameters,
                    const std::string                     &entry,
                    const std::string                     &value)
{
  double low = std::numeric_limits<double>::max(), top = -low;
  for (unsigned int node = 0; node < face.surface().n_nodes(); ++node)
    {
      low = std::min(low, directions[node] * face.normals()[node]);
      top = std::max(top, directions[node] * face.normals()[node]);
    }
  if (low < 1e-9 && top > -1e-9)
    throw bad_entry(parameters.path(entry), value,
                    "needs a 'Direction' that points out of the face " + parameters.face +
                      " everywhere, or into it everywhere");
  return low > 0. ? 1. : -1.;
}

/// The curvature of a face along one of its coordinates.
template <int dim>
class Curvature
{
public:
  Curvature(const ShapedFace<dim>      &face,
            const FaceCoordinates<dim> &coordinates,
            const unsigned int          axis)
    : closed(coordinates.axis(axis).closed)
  {
    const auto  points = face_points(face);
    const auto &along  = coordinates.axis(axis);
    for (const auto &[i, j] : points.edges)
      {
        const auto   x      = points.positions[j] - points.positions[i];
        const double s      = std::abs(along.values[j] - along.values[i]);
        const double length = along.unit * (along.closed ? std::min(s, along.range - s) : s);
        if (x.norm() == 0. || length < along_coordinate * x.norm())
          continue;
        const auto turn = points.normals[j] - points.normals[i];
        pieces.push_back({along.values[i] / along.range, along.values[j] / along.range,
                          (turn * x) / x.norm_square()});
      }
  }

  /// Return the minimum curvature of edges that have points between the fractions @p lower and
  /// @p upper.
  double minimum(const double lower, const double upper) const
  {
    double result = std::numeric_limits<double>::max();
    for (const auto &piece : pieces)
      if (closed || (std::max(piece.first, piece.second) >= lower &&
                     std::min(piece.first, piece.second) <= upper))
        result = std::min(result, piece.curvature);
    return pieces.empty() ? 0. : result;
  }

private:
  struct Piece
  {
    double first, second; ///< fractions
    double curvature;
  };

  bool               closed;
  std::vector<Piece> pieces;
};

Combination scaled(Combination row, const double factor)
{
  for (auto &[point, weight] : row)
    weight *= factor;
  return row;
}

/// Return the limits of the first derivative along an axis.
std::vector<ControlLimit> slope_limits(const SplineNet       &net,
                                       const unsigned int     axis,
                                       const double           length,
                                       const ShapeParameters &parameters)
{
  std::vector<ControlLimit> result;
  for (const auto &row : net.derivative(axis, 1))
    for (const double side : {-1., 1.})
      result.push_back({scaled(row, side / length), parameters.maximum_slope, "Maximum slope"});
  return result;
}

/// Return the limits of the second derivative along an axis, with the @p sign of outward moves.
template <int dim>
std::vector<ControlLimit> curvature_limits(const SplineNet       &net,
                                           const unsigned int     axis,
                                           const double           length,
                                           const double           sign,
                                           const Curvature<dim>  &curvature,
                                           const ShapeParameters &parameters)
{
  std::vector<ControlLimit> result;
  const double              allowed = parameters.convex ? 0. : 1. / parameters.tool_radius;
  for (const auto &row : net.derivative(axis, 2))
    {
      double lower = 1., upper = 0.;
      for (const auto &[point, weight] : row)
        {
          lower = std::min(lower, net.greville(point)[axis]);
          upper = std::max(upper, net.greville(point)[axis]);
        }
      result.push_back({scaled(row, sign / (length * length)),
                        allowed + curvature.minimum(lower, upper),
                        parameters.convex ? "Convex" : "Minimum tool radius"});
    }
  return result;
}
} // namespace

template <int dim>
std::vector<ControlLimit> removal_limits(const ShapedFace<dim>                 &face,
                                         const unsigned int                     n,
                                         const typename ShapedFace<dim>::Field &directions,
                                         const ShapeParameters                 &parameters)
{
  std::vector<ControlLimit> result;
  if (!parameters.only_remove)
    return result;
  const double sign = outward_sign(face, directions, parameters, "Only remove", "true");
  for (unsigned int i = 0; i < n; ++i)
    result.push_back({{{i, sign}}, 0., "Only remove"});
  return result;
}

template <int dim>
std::vector<ControlLimit> patch_limits(const ShapedFace<dim>                 &face,
                                       const FaceCoordinates<dim>            &coordinates,
                                       const SplineNet                       &net,
                                       const typename ShapedFace<dim>::Field &directions,
                                       const ShapeParameters                 &parameters)
{
  auto       result = removal_limits(face, net.n_points(), directions, parameters);
  const auto add    = [&result](const std::vector<ControlLimit> &more) {
    result.insert(result.end(), more.begin(), more.end());
  };
  const bool limits_curvature = parameters.convex || parameters.tool_radius > 0.;
  for (unsigned int axis = 0; axis < dim - 1; ++axis)
    {
      if (parameters.control_points[axis] == 1)
        continue;
      // Around an axis, slopes and curvatures are maximum at the minimum radius.
      const auto  &along  = coordinates.axis(axis);
      const double length = along.range * along.minimum_unit;
      if (parameters.maximum_slope > 0.)
        add(slope_limits(net, axis, length, parameters));
      if (!limits_curvature)
        continue;
      const std::string entry = parameters.convex ? "Convex" : "Minimum tool radius";
      const std::string value = parameters.convex ? "true" : to_text(parameters.tool_radius);
      if (net.degree(axis) < 2)
        throw bad_entry(parameters.path(entry), value,
                        "needs splines of the degree 2 or higher along s and t");
      add(curvature_limits(net, axis, length,
                           outward_sign(face, directions, parameters, entry, value),
                           Curvature<dim>(face, coordinates, axis), parameters));
    }
  return result;
}

#define SNUG_INSTANTIATE(dim)                                                                      \
  template std::vector<ControlLimit> removal_limits(const ShapedFace<dim> &, unsigned,             \
                                                    const ShapedFace<dim>::Field &,                \
                                                    const ShapeParameters &);                      \
  template std::vector<ControlLimit> patch_limits(const ShapedFace<dim> &,                         \
                                                  const FaceCoordinates<dim> &, const SplineNet &, \
                                                  const ShapedFace<dim>::Field &,                  \
                                                  const ShapeParameters &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::shape
