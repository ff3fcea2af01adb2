#include <snug/base/errors.h>
#include <snug/shape/entries.h>
#include <snug/shape/face_coordinates.h>
#include <snug/shape/face_places.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace snug::shape {
namespace {
using Vector = dealii::Tensor<1, 3>;

/// Minimum cosine of the angle between a normal of the face and the mean normal. A face with a
/// smaller cosine has no useful projection onto a plane.
const double least_cosine = 0.1;

/// Return all axes except the axis closest to the mean normal if the face is a graph over them,
/// else no axes.
template <int dim>
std::vector<unsigned int> graph_axes(const ShapedFace<dim> &face)
{
  const auto   mean_normal = mean_direction(face, face.normals());
  unsigned int across      = 0;
  for (unsigned int d = 1; d < dim; ++d)
    // The last of equal components is taken, so that round-off does not decide.
    if (std::abs(mean_normal[d]) > std::abs(mean_normal[across]) - 1e-9)
      across = d;
  for (const auto &normal : face.normals())
    // At the end of a quarter of a ring the normal lies in the plane of s and t. A face that turns
    // further is no graph over the plane. The negated comparison rejects NaN as well.
    if (!(normal * mean_normal > least_cosine && normal[across] * mean_normal[across] > -1e-9))
      return {};
  std::vector<unsigned int> axes;
  for (unsigned int d = 0; d < dim; ++d)
    if (d != across)
      axes.push_back(d);
  return axes;
}

/// Return the entry Axis point in 3D, or nothing.
std::optional<Vector> given_point(const ShapeParameters &parameters)
{
  if (parameters.axis_point.empty())
    return {};
  Vector result;
  for (unsigned int d = 0; d < parameters.axis_point.size(); ++d)
    result[d] = parameters.axis_point[d];
  return result;
}

/// Return the directions in which the axis of a face may point: that of the entry Axis, or that of
/// a known surface on which a part of the face lies, and x, y, z.
template <int dim>
std::vector<Vector> axis_candidates(const ShapedFace<dim> &face, const ShapeParameters &parameters)
{
  Vector z;
  z[2] = 1.;
  if (dim == 2)
    return {z};
  if (!parameters.axis.empty())
    return {unit_direction<3>(parameters, "Axis")};
  std::vector<Vector> result;
  if constexpr (dim == 3)
    for (const auto &one : face.surface().faces())
      if (result.empty() && one.known != nullptr &&
          one.known->kind != geometry::KnownSurface<dim>::Kind::sphere)
        result.push_back(one.known->axis);
  for (unsigned int d = 0; d < 3; ++d)
    {
      Vector e;
      e[d] = 1.;
      if (result.empty() || std::abs(result.front() * e) < 1. - 1e-9)
        result.push_back(e);
    }
  return result;
}

/// Return the axes about which the face is a surface of revolution.
template <int dim>
std::vector<Axis> revolution_axes(const ShapedFace<dim> &face,
                                  const FacePoints      &points,
                                  const ShapeParameters &parameters)
{
  std::vector<Axis> result;
  for (Vector direction : axis_candidates(face, parameters))
    {
      // The axis of a known surface may have either sense.
      if (parameters.axis.empty() &&
          *std::max_element(direction.begin_raw(), direction.end_raw()) <
            -*std::min_element(direction.begin_raw(), direction.end_raw()))
        direction *= -1.;
      if (const auto axis = revolution_axis(points, direction, given_point(parameters)))
        result.push_back(*axis);
    }
  return result;
}
} // namespace

template <int dim>
dealii::Tensor<1, dim> mean_direction(const ShapedFace<dim>                 &face,
                                      const typename ShapedFace<dim>::Field &directions)
{
  dealii::Tensor<1, dim> mean;
  for (unsigned int node = 0; node < directions.size(); ++node)
    // The weights are areas, so that the mean does not depend on local refinement.
    mean += face.areas()[node] * directions[node];
  mean /= mean.norm();
  return mean;
}

template <int dim>
FaceCoordinates<dim>::FaceCoordinates(const ShapedFace<dim> &face,
                                      const ShapeParameters &parameters)
  : face(face), chosen(parameters.coordinates)
{
  const bool automatic = chosen == Coordinates::automatic;
  if (automatic || chosen == Coordinates::projection)
    kept_axes = graph_axes(face);
  if (!kept_axes.empty())
    {
      set_projection();
      return;
    }
  if (chosen == Coordinates::projection)
    throw bad_entry(parameters.path("Face"), parameters.face,
                    "must have normals within 84 degrees of their mean and within 90 degrees of a "
                    "coordinate axis for Coordinates = projection; use arc length or angle");
  const auto points = face_points(face);
  if (automatic)
    chosen = dim == 3 && revolution_axes(face, points, parameters).size() == 1
               ? Coordinates::angle
               : Coordinates::arc_length;
  chosen == Coordinates::angle ? set_angles(points, parameters)
                               : set_arc_lengths(points, parameters);
}

template <int dim>
void FaceCoordinates<dim>::set_projection()
{
  chosen                       = Coordinates::projection;
  const auto        &positions = face.positions();
  const unsigned int n_nodes   = face.surface().n_nodes();
  for (const unsigned int d : kept_axes)
    {
      const auto [low, top] =
        std::minmax_element(positions.begin(), positions.begin() + n_nodes,
                            [d](const auto &a, const auto &b) { return a[d] < b[d]; });
      FaceCoordinate axis;
      axis.lower = (*low)[d];
      axis.range = (*top)[d] - axis.lower;
      for (const auto &position : positions)
        // Samples of a face with curved edges may lie outside of the rectangle of the nodes.
        axis.values.push_back(std::clamp(position[d] - axis.lower, 0., axis.range));
      axes.push_back(axis);
    }
}

template <int dim>
void FaceCoordinates<dim>::set_angles(const FacePoints &points, const ShapeParameters &parameters)
{
  const auto found = revolution_axes(face, points, parameters);
  const auto fail  = [&](const std::string &entry, const std::string &value,
                        const std::string &allowed) {
    throw bad_entry(parameters.path(entry), value, allowed);
  };
  if (found.empty() && dim == 2)
    fail("Axis point", to_text(parameters.axis_point),
         "must be the centre of the angle, because the normals of the face " + parameters.face +
           " do not meet in a point");
  if (found.empty() && !parameters.axis.empty() && parameters.axis_point.empty())
    fail("Axis", to_text(parameters.axis),
         "must be the axis of a surface of revolution, and 'Axis point' must be given for plane "
         "faces; the face " +
           parameters.face + " has no such axis");
  if (found.empty())
    fail("Coordinates", to_text(parameters.coordinates),
         "must not be angle for the face " + parameters.face +
           ", which is not a surface of revolution about the axis x, y or z; set 'Axis'");
  if (found.size() > 1)
    fail("Axis", to_text(parameters.axis),
         "must be given: the face " + parameters.face +
           " is a surface of revolution about several axes");
  const double start    = parameters.start_angle * dealii::numbers::PI / 180.;
  const auto   of_angle = angle(points, found.front(), start);
  const auto   along    = meridian_length(points, found.front(), start);
  if (!of_angle || !along)
    fail("Face", parameters.face, "must be connected for Coordinates = angle");
  own_line = found.front();
  axes     = {*of_angle};
  if (dim == 3)
    axes.push_back(*along);
}

template <int dim>
void FaceCoordinates<dim>::set_arc_lengths(const FacePoints      &points,
                                           const ShapeParameters &parameters)
{
  std::optional<Vector> direction;
  if (dim == 2)
    direction = axis_candidates(face, parameters).front();
  else if (parameters.axis.empty())
    direction = extrusion_direction(points);
  else if (is_extrusion(points, axis_candidates(face, parameters).front()))
    direction = axis_candidates(face, parameters).front();
  if (!direction)
    throw bad_entry(parameters.path("Coordinates"), to_text(parameters.coordinates),
                    "needs a face that is an extrusion" +
                      std::string(chosen == parameters.coordinates
                                    ? ""
                                    : ", a surface of revolution or a graph over a plane") +
                      "; the face " + parameters.face +
                      " is not; use node-wise, a box or formula "
                      "modes");
  const auto along =
    profile_length(points, *direction, parameters.start_angle * dealii::numbers::PI / 180.);
  if (!along)
    throw bad_entry(parameters.path("Face"), parameters.face,
                    "must be connected for Coordinates = arc length");
  own_line.direction = *direction;
  axes               = {*along};
  if (dim == 3)
    axes.push_back(position_along(points, *direction));
}

template <int dim>
std::vector<double> FaceCoordinates<dim>::fractions(const unsigned int point) const
{
  std::vector<double> result;
  for (const auto &axis : axes)
    result.push_back(std::clamp(axis.values[point] / axis.range, 0., 1.));
  return result;
}

template <int dim>
std::vector<dealii::Tensor<1, dim>> FaceCoordinates<dim>::as_lengths() const
{
  std::vector<dealii::Tensor<1, dim>> result(face.positions().size());
  for (unsigned int k = 0; k < result.size(); ++k)
    for (unsigned int a = 0; a < axes.size(); ++a)
      result[k][a] = axes[a].values[k] * axes[a].unit;
  return result;
}

template <int dim>
dealii::Tensor<1, dim> FaceCoordinates<dim>::periods() const
{
  dealii::Tensor<1, dim> result;
  for (unsigned int a = 0; a < axes.size(); ++a)
    result[a] = axes[a].closed ? axes[a].range * axes[a].unit : 0.;
  return result;
}

template <int dim>
std::pair<dealii::Point<dim>, dealii::Tensor<1, dim>>
FaceCoordinates<dim>::point_at(const std::vector<double> &fractions, const Field &directions) const
{
  dealii::Tensor<1, dim> target;
  for (unsigned int a = 0; a < axes.size(); ++a)
    target[a] = fractions[a] * axes[a].range * axes[a].unit;
  const auto place     = FacePlaces<dim>(face, as_lengths(), periods()).closest(target);
  const auto direction = place->value(directions);
  return {dealii::Point<dim>(place->value(face.positions())), direction / direction.norm()};
}

#define SNUG_INSTANTIATE(dim)                                             \
  template class FaceCoordinates<dim>;                                    \
  template dealii::Tensor<1, dim> mean_direction(const ShapedFace<dim> &, \
                                                 const ShapedFace<dim>::Field &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::shape
