#include <snug/base/errors.h>
#include <snug/shape/entries.h>
#include <snug/shape/limits.h>
#include <snug/shape/make_modes.h>

#include <algorithm>

namespace snug::shape {
namespace {
/// A border of a face lies at the end of a coordinate if its points deviate by at most this part of
/// the range of the coordinate.
const double end_tolerance = 1e-3;

/// Return the ends of the axes of the net. The entry Smooth across symmetry names boundaries of the
/// body. The end at which the face meets such a boundary is smooth. Collective.
template <int dim>
std::vector<SplineAxis::Ends> axis_ends(const ShapedFace<dim>      &face,
                                        const FaceCoordinates<dim> &coordinates,
                                        const ShapeParameters      &parameters)
{
  std::vector<SplineAxis::Ends> ends(dim - 1);
  for (unsigned int a = 0; a < dim - 1; ++a)
    ends[a].closed = coordinates.axis(a).closed;
  for (const auto &name : parameters.smooth)
    {
      const auto require = [&](const bool good, const std::string &allowed) {
        if (!good)
          throw bad_entry(parameters.path("Smooth across symmetry"), to_text(parameters.smooth),
                          "'" + name + "' must be " + allowed);
      };
      const auto &known = face.mesh().geometry(face.body()).boundary_names();
      const auto  found = std::find(known.begin(), known.end(), name);
      require(found != known.end(), "one of the boundaries of the body, " + to_text(known));
      const unsigned int boundary = found - known.begin();
      require(!face.has(boundary), "a boundary other than the shaped face");
      const mesh::Surface<dim>  other(face.mesh(), {{face.body(), boundary}});
      std::vector<unsigned int> common; // nodes of the face
      for (unsigned int node = 0; node < other.n_nodes(); ++node)
        if (const unsigned int own = face.surface().find(other.global_node(node));
            own < face.surface().n_nodes())
          common.push_back(own);
      bool is_end = false;
      for (unsigned int a = 0; a < dim - 1 && !common.empty(); ++a)
        for (const unsigned int side : {0, 1})
          if (!ends[a].closed && std::all_of(common.begin(), common.end(), [&](unsigned int node) {
                return std::abs(coordinates.fractions(node)[a] - side) < end_tolerance;
              }))
            is_end = ends[a].smooth[side] = true;
      require(is_end, "a boundary that meets the face along one end of s or t");
    }
  return ends;
}

/// Return the mean position of the nodes of a face.
template <int dim>
dealii::Point<dim> mean_position(const ShapedFace<dim> &face)
{
  dealii::Point<dim> result;
  const unsigned int n_nodes = face.surface().n_nodes();
  for (unsigned int node = 0; node < n_nodes; ++node)
    result += face.positions()[node] / double(n_nodes);
  return result;
}

/// Check that the face does not reach the axis if the splines vary around the axis, because the
/// point on the axis has all angles. @throws InputError
template <int dim>
void check_axis(const FaceCoordinates<dim> &coordinates, const ShapeParameters &parameters)
{
  const auto &first = coordinates.axis(0);
  if (coordinates.kind() == Coordinates::angle && parameters.control_points[0] > 1 &&
      first.minimum_unit < 1e-6 * first.unit)
    throw bad_entry(parameters.path("Control points"), to_text(parameters.control_points),
                    "must be 1 along the angle, because the face " + parameters.face +
                      " reaches the axis");
}
} // namespace

template <int dim>
Modes<dim> spline_patch(const ShapedFace<dim> &face,
                        const ShapeParameters &parameters,
                        const unsigned int     degree)
{
  spline_net(parameters, dim - 1, degree); // checks entries before the coordinates are needed
  const FaceCoordinates<dim> coordinates(face, parameters);
  const SplineNet            net =
    spline_net(parameters, dim - 1, degree, axis_ends(face, coordinates, parameters));
  check_axis(coordinates, parameters);
  const auto                 directions = face_directions(face, parameters);
  std::vector<double>        places; // fractions s, t of the points, one point after another
  typename Modes<dim>::Field moving; // directions at the points
  for (const unsigned int point : face.needed_points())
    {
      const auto fractions = coordinates.fractions(point);
      places.insert(places.end(), fractions.begin(), fractions.end());
      moving.push_back(directions[point]);
    }
  Modes<dim> modes;
  modes.n_variables = net.n_points();
  modes.n_nodes     = moving.size();
  modes.row         = [=](unsigned int point) {
    typename Modes<dim>::Row row;
    const auto               first = places.begin() + (dim - 1) * point;
    for (const auto &value : net.values({first, first + dim - 1}))
      row.emplace_back(value.first, value.second * moving[point]);
    return row;
  };
  // Symmetry compares control points, which are no nodes. All control points of a projection have
  // the same height and the mean direction, so that images are found on any mesh.
  const auto                         &kept   = coordinates.projection_axes();
  const auto                          mean   = mean_direction(face, directions);
  const auto                          middle = mean_position(face);
  std::vector<dealii::Tensor<1, dim>> shown_directions;
  for (unsigned int i = 0; i < net.n_points(); ++i)
    {
      const auto fractions = net.greville(i);
      const auto shown     = coordinates.point_at(fractions, directions);
      shown_directions.push_back(shown.second);
      if (kept.empty())
        {
          modes.controls.push_back({i, shown.first, shown.second, net.on_border(i), false, {}});
          continue;
        }
      dealii::Point<dim> position = middle;
      for (unsigned int t = 0; t < kept.size(); ++t)
        position[kept[t]] = coordinates.axis(t).lower + fractions[t] * coordinates.axis(t).range;
      modes.controls.push_back({i, position, mean, net.on_border(i), false, shown});
    }
  modes.row_at_point = [=](unsigned int i) {
    typename Modes<dim>::Row row;
    for (const auto &value : net.values(net.greville(i)))
      row.emplace_back(value.first, value.second * shown_directions[i]);
    return row;
  };
  modes.limits = patch_limits(face, coordinates, net, directions, parameters);
  return modes;
}

template Modes<2> spline_patch(const ShapedFace<2> &, const ShapeParameters &, unsigned int);
template Modes<3> spline_patch(const ShapedFace<3> &, const ShapeParameters &, unsigned int);
} // namespace snug::shape
