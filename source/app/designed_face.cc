#include <snug/app/designed_face.h>
#include <snug/base/errors.h>
#include <snug/io/profile.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <random>

namespace snug::app {
namespace {
using shape::Coordinates;

/// Displacements are constant along a coordinate up to this part of the maximum displacement.
const double constant = 1e-6;

/// Numbers below this part of the size of a face are round-off.
const double round_off = 1e-12;

/// Maximum number of control points of a curve.
const unsigned int most_of_curve = 500;

/// The table of the drop has one row more than these intervals, which are divided into n_between
/// steps for the highest point.
const unsigned int n_rows = 8, n_between = 25;

/// Coordinates are equal up to this part of their range.
const double equal = 1e-9;

/// The projection of a face onto a plane is a good parametrization if the cosines of the angles
/// between the normals and the normal of the plane are at least this number.
const double gentle = 0.5;

/// Return whether coordinates suit splines. The length of a curve over a projection has no bound
/// where the face is steep.
template <int dim>
bool is_suitable(const shape::ShapedFace<dim> &face, const shape::FaceCoordinates<dim> &coordinates)
{
  const auto &kept = coordinates.projection_axes();
  for (unsigned int d = 0; d < dim && !kept.empty(); ++d)
    if (std::find(kept.begin(), kept.end(), d) == kept.end())
      return std::all_of(face.normals().begin(), face.normals().end(),
                         [d](const auto &normal) { return std::abs(normal[d]) > gentle; });
  return true;
}

/// Return all coordinates of a face: arc length of an extrusion, projection of a graph, angle of a
/// surface of revolution. The axis is that of @p parameters, or for the angle x, y, z.
template <int dim>
std::vector<shape::FaceCoordinates<dim>> all_coordinates(const shape::ShapedFace<dim> &face,
                                                         shape::ShapeParameters        parameters)
{
  std::vector<std::pair<Coordinates, std::vector<double>>> choices = {
    {Coordinates::arc_length, parameters.axis},
    {Coordinates::projection, {}},
    {Coordinates::angle, parameters.axis}};
  if (dim == 3 && parameters.axis.empty())
    for (unsigned int d = 0; d < 3; ++d)
      {
        std::vector<double> axis(3, 0.);
        axis[d] = 1.;
        choices.emplace_back(Coordinates::angle, axis);
      }
  std::vector<shape::FaceCoordinates<dim>> result;
  for (const auto &[kind, axis] : choices)
    try
      {
        parameters.coordinates = kind;
        parameters.axis        = axis;
        result.emplace_back(face, parameters);
      }
    catch (const InputError &)
      {}
  return result;
}

template <int dim>
dealii::Tensor<1, 3> in_space(const dealii::Tensor<1, dim> &x)
{
  dealii::Tensor<1, 3> result;
  for (unsigned int d = 0; d < dim; ++d)
    result[d] = x[d];
  return result;
}

/// Return, for each value, the number of smaller values that are not equal.
std::vector<unsigned int> ranks_of(const std::vector<double> &values, const double range)
{
  std::vector<unsigned int> order(values.size()), ranks(values.size(), 0);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](const auto a, const auto b) { return values[a] < values[b]; });
  for (unsigned int k = 1; k < order.size(); ++k)
    ranks[order[k]] =
      ranks[order[k - 1]] + (values[order[k]] - values[order[k - 1]] > equal * range ? 1 : 0);
  return ranks;
}

/// Return the coordinates of the chart of B-splines on a swept or other face as loops.
/// Set the loops of a face that does not fill the rectangle of its coordinates. The first parameter
/// of the face is the first coordinate divided by @p unit.
/// @throws InputError if the coordinates are closed.
void add_loops(const shape::FaceChart<2> & /*chart*/, double /*unit*/, cad::SplineFace & /*face*/)
{}
void add_loops(const shape::FaceChart<3> &chart, const double unit, cad::SplineFace &face)
{
  if (chart.fills_rectangle())
    return;
  if (chart.is_closed(0) || chart.is_closed(1))
    throw InputError("the face surrounds the body and has a border other than the ends of its "
                     "coordinates; divide the face into two boundaries");
  for (const auto &loop : chart.loops())
    {
      face.loops.emplace_back();
      for (const auto &piece : loop)
        {
          face.loops.back().emplace_back();
          for (const auto &s : piece)
            face.loops.back().back().emplace_back(s[0] / unit, s[1]);
        }
    }
}

} // namespace

template <int dim>
cad::SplineFace spline_face(const io::SplineSurface<dim>     &surface,
                            const dealii::Tensor<1, dim - 1> &range,
                            const dealii::Tensor<1, dim - 1> &lower)
{
  cad::SplineFace result;
  result.degree = surface.degree;
  for (unsigned int a = 0; a < dim - 1; ++a)
    {
      auto breaks = surface.axes[a].breaks();
      for (double &s : breaks)
        s = lower[a] + s * range[a];
      result.axes.push_back({breaks, surface.axes[a].is_closed()});
    }
  for (const auto &x : surface.points)
    result.points.emplace_back(in_space<dim>(x));
  return result;
}

Sweep::Sweep(const bool rotates, const shape::Axis &axis, const double lower, const double extent)
  : rotates(rotates), axis(axis), lower(lower), extent(extent)
{
  across[0] = shape::reference_direction(axis.direction);
  across[1] = cross_product_3d(axis.direction, across[0]);
  if (rotates)
    across[0] = std::cos(lower) * across[0] + std::sin(lower) * across[1];
}

dealii::Tensor<1, 2> Sweep::section(const Vector &x) const
{
  const Vector         lever = x - axis.point;
  const double         along = lever * axis.direction;
  dealii::Tensor<1, 2> result;
  result[0] = rotates ? (lever - along * axis.direction).norm() : lever * across[0];
  result[1] = rotates ? along : lever * across[1];
  return result;
}

cad::SplineFace Sweep::face(const io::SplineSurface<2> &curve,
                            const dealii::Tensor<1, 1> &range) const
{
  auto result = spline_face<2>(curve, range);
  result.points.clear();
  for (const auto &q : curve.points)
    result.points.emplace_back(
      axis.point + q[0] * across[0] +
      (rotates ? q[1] * axis.direction : q[1] * across[1] + lower * axis.direction));
  result.sweep     = rotates ? cad::SplineFace::Sweep::revolved : cad::SplineFace::Sweep::extruded;
  result.centre    = dealii::Point<3>(axis.point);
  result.direction = dealii::Point<3>(axis.direction);
  result.extent    = extent;
  return result;
}

template <int dim>
DesignedFace<dim>::DesignedFace(const mesh::BodyMesh<dim>    &mesh,
                                const shape::BodyNames       &names,
                                const shape::ShapeParameters &parameters,
                                const mesh::Field<dim>       &positions)
  : name(parameters.face)
  , face(std::make_shared<shape::ShapedFace<dim>>(mesh, names, parameters))
  , at_points(face->surface().gather(positions))
{
  for (unsigned int k = 0; k < at_points.size(); ++k)
    {
      moves.push_back((at_points[k] - face->positions()[k]) * face->normals()[k]);
      largest_move = std::max(largest_move, std::abs(moves.back()));
    }
  const auto all = all_coordinates<dim>(*face, parameters);
  for (const auto &coordinates : all)
    if (!swept)
      add_sweep(coordinates);
  if (all.empty())
    return;
  const auto best = std::find_if(all.begin(), all.end(),
                                 [&](const auto &one) { return is_suitable<dim>(*face, one); });
  coordinates.emplace(best == all.end() ? all.front() : *best);
  // Axes of graphs are sorted by their ranges, other coordinates run along the axis first.
  unsigned int first = dim - 2;
  if (dim == 3 && coordinates->kind() == Coordinates::projection &&
      coordinates->axis(0).range > (1. - equal) * coordinates->axis(1).range)
    first = 0;
  for (const unsigned int a : {first, dim - 2 - first})
    {
      auto values = coordinates->axis(a).values;
      values.resize(face->surface().n_nodes());
      ranks.push_back(ranks_of(values, coordinates->axis(a).range));
    }
}

/// Set the sweep that makes the face if the coordinates have one.
template <int dim>
void DesignedFace<dim>::add_sweep(const shape::FaceCoordinates<dim> &of)
{
  const auto set = [&](const bool rotates, const shape::Axis &axis, const unsigned int curve,
                       const std::string &along) {
    const auto &across = of.axis(1 - curve);
    if (!depends_on(of.axis(curve)))
      return;
    swept.emplace(Swept{{rotates, axis, across.lower, across.range}, of.all_axes(), curve, along});
    // The curve of an extrusion is the first parameter.
    if (!rotates && curve == 1)
      {
        std::swap(swept->axes[0], swept->axes[1]);
        swept->curve = 0;
      }
  };
  const auto line = [](const unsigned int d) {
    shape::Axis result;
    result.direction[d] = 1.;
    return result;
  };
  if (dim == 2)
    {
      const auto &section = face->mesh().idealization();
      const bool  rotates = section.is_axisymmetric();
      swept.emplace(
        Swept{{rotates, line(rotates ? 1 : 2), 0., rotates ? 2. * M_PI : section.thickness},
              of.all_axes(),
              0,
              "the face"});
    }
  else if (of.kind() == Coordinates::angle)
    set(true, of.line(), 1, "the axis");
  else if (of.kind() == Coordinates::arc_length)
    set(false, of.line(), 0, "the face");
  else
    for (const unsigned int curve : {0, 1})
      {
        const auto along = line(of.projection_axes()[1 - curve]);
        if (!swept && shape::is_extrusion(shape::face_points(*face), along.direction))
          set(false, along, curve, std::string(1, "xyz"[of.projection_axes()[curve]]));
      }
}

/// Return whether a point is a hanging node, which need not lie on the true surface.
template <int dim>
bool DesignedFace<dim>::is_interpolated(const unsigned int point) const
{
  return point < face->surface().n_nodes() && face->is_hanging(point);
}

/// Return whether the displacements depend on a coordinate alone.
template <int dim>
bool DesignedFace<dim>::depends_on(const shape::FaceCoordinate &coordinate) const
{
  std::vector<double> values, of_value;
  for (unsigned int k = 0; k < moves.size(); ++k)
    if (!is_interpolated(k))
      {
        values.push_back(coordinate.values[k]);
        of_value.push_back(moves[k]);
      }
  const auto                ranks = ranks_of(values, coordinate.range);
  const unsigned int        n     = *std::max_element(ranks.begin(), ranks.end()) + 1;
  std::vector<double>       low(n, HUGE_VAL), top(n, -HUGE_VAL);
  std::vector<unsigned int> count(n, 0);
  for (unsigned int k = 0; k < ranks.size(); ++k)
    {
      low[ranks[k]] = std::min(low[ranks[k]], of_value[k]);
      top[ranks[k]] = std::max(top[ranks[k]], of_value[k]);
      ++count[ranks[k]];
    }
  const double rounding = constant * largest_move;
  for (unsigned int g = 0; g < n; ++g)
    {
      const bool is_alone = count[g] == 1 && g > 0 && g + 1 < n;
      if (top[g] - low[g] > rounding ||
          (is_alone && (top[g] > std::max(top[g - 1], top[g + 1]) + rounding ||
                        low[g] < std::min(low[g - 1], low[g + 1]) - rounding)))
        return false;
    }
  return true;
}

template <int dim>
double DesignedFace<dim>::size() const
{
  auto lower = at_points.front(), upper = lower;
  for (const auto &x : at_points)
    for (unsigned int d = 0; d < dim; ++d)
      {
        lower[d] = std::min(lower[d], x[d]);
        upper[d] = std::max(upper[d], x[d]);
      }
  return (upper - lower).norm();
}

template <int dim>
std::array<unsigned int, 2> DesignedFace<dim>::place(const unsigned int global_node) const
{
  const unsigned int node = face->surface().find(global_node);
  return ranks.empty() ? std::array<unsigned int, 2>{{0, 0}}
                       : std::array<unsigned int, 2>{{ranks.front()[node], ranks.back()[node]}};
}

/// Return the place at the coordinate @p s of the curve [length] and at one of the fractions @p
/// across of the range of the other coordinate, or nothing outside of the face.
template <int dim>
std::optional<typename shape::FaceChart<dim>::Place>
DesignedFace<dim>::on_curve(const shape::FaceChart<dim> &chart,
                            const double                 s,
                            const std::vector<double>   &across) const
{
  for (const double part : across)
    {
      auto at          = part * chart.range();
      at[swept->curve] = s;
      if (const auto place = chart.find(at))
        return place;
    }
  return {};
}

/// Return the curve of the sweep through points of the design at random places across the curve.
template <int dim>
io::SplineSurface<2> DesignedFace<dim>::fitted_curve(const shape::FaceChart<dim> &chart,
                                                     const double                 tolerance) const
{
  std::mt19937                           random(1);
  std::uniform_real_distribution<double> uniform(0., 1.);
  io::CoordinatePoints<2>                points;
  points.range[0]  = chart.range()[swept->curve];
  points.closed[0] = chart.is_closed(swept->curve);
  points.point     = [&](const dealii::Tensor<1, 1> &s) -> std::optional<dealii::Tensor<1, 2>> {
    std::vector<double> across(10);
    for (double &part : across)
      part = uniform(random);
    const auto place = on_curve(chart, s[0], across);
    if (!place)
      return {};
    return swept->sweep.section(in_space<dim>(place->value(at_points)));
  };
  return io::fit_splines(points, tolerance, most_of_curve);
}

template <int dim>
std::string DesignedFace<dim>::crown(const std::string                            &unit,
                                     const std::vector<state::SymmetryPlane<dim>> &planes) const
{
  const auto &surface = face->surface();
  const auto  m =
    io::mean_normal(surface, io::surface_pieces(surface).front(), face->mesh().degree(), planes);
  const bool rotates = swept && swept->sweep.rotates && dim == 3;
  if (!swept || !(largest_move > round_off * size()) || (!rotates && m.norm() == 0.))
    return "";
  // Around an axis, the depth is the component of the section to which the mean normal is closest.
  const auto          &axis = swept->sweep.axis;
  dealii::Tensor<1, 2> normal;
  const auto section = [&](const Vector &x) { return swept->sweep.section(in_space<dim>(x)); };
  for (unsigned int k = 0; k < surface.n_nodes(); ++k)
    normal += face->areas()[k] * (section(face->positions()[k] + 1e-3 * face->free_normals()[k]) -
                                  section(face->positions()[k]));
  const unsigned int deep   = std::abs(normal[0]) >= std::abs(normal[1]) ? 0 : 1;
  const auto         height = [&](const Vector &x) {
    return rotates ? std::copysign(1., normal[deep]) * section(x)[deep] : m * x;
  };
  const shape::FaceChart<dim>        chart(*face, swept->axes);
  std::vector<std::array<double, 3>> rows; // position, heights before and after
  std::array<double, 2>              top = {{-HUGE_VAL, -HUGE_VAL}};
  for (unsigned int k = 0; k <= n_rows * n_between; ++k)
    {
      const double range = chart.range()[swept->curve], s = range * k / (n_rows * n_between);
      const std::vector<double> across = {0.5, 0.25, 0.75, 0.125, 0.875};
      auto                      place  = on_curve(chart, s, across);
      if (!place) // at a pole
        place = on_curve(chart, std::clamp(s, 1e-4 * range, (1. - 1e-4) * range), across);
      if (!place)
        continue;
      const auto                  before = place->value(face->positions());
      const double                at     = !rotates    ? swept->axes[swept->curve].lower + s
                                           : deep == 0 ? in_space<dim>(before) * axis.direction
                                                       : section(before)[0];
      const std::array<double, 3> row    = {{at, height(before), height(place->value(at_points))}};
      top                                = {{std::max(top[0], row[1]), std::max(top[1], row[2])}};
      if (k % n_between == 0)
        rows.push_back(row);
    }
  const auto &d = axis.direction;
  std::string text =
    "face " + name + ", drop at " +
    (deep == 0 || !rotates ? "positions along " : "distances from ") + swept->along +
    (rotates ? " (" + to_text(std::vector<double>{d[0], d[1], d[2]}) + ")" : "") +
    (unit.empty() ? "" : ", in " + unit) + ":\n      position   drop before    drop after\n";
  unsigned int n = 0;
  for (const auto &[at, before, after] : rows)
    for (const double number : {at, top[0] - before, top[1] - after})
      {
        char column[32];
        std::snprintf(column, sizeof(column), "%14.5g",
                      std::abs(number) <= constant * largest_move ? 0. : number);
        text += column + std::string(++n % 3 == 0 ? "\n" : "");
      }
  return text;
}

template <int dim>
std::pair<cad::SplineFace, io::Summary::ProfileFace>
DesignedFace<dim>::splines(const double asked) const
{
  std::pair<cad::SplineFace, io::Summary::ProfileFace> result;
  if (!coordinates)
    throw InputError(
      "the face is not connected, or is not an extrusion, a surface of revolution or a "
      "graph over a coordinate plane");
  auto &[of_file, summary] = result;
  summary                  = {name, {}, "curve", HUGE_VAL, asked};
  auto axes                = swept ? swept->axes : coordinates->all_axes();
  if (swept)
    {
      const shape::FaceChart<dim> chart(*face, axes);
      const auto                  curve = fitted_curve(chart, dim == 2 ? asked : asked / 2.);
      dealii::Tensor<1, 1>        range, s;
      range[0]          = chart.range()[swept->curve];
      of_file           = swept->sweep.face(curve, range);
      summary.spans     = {curve.n_spans(0)};
      summary.deviation = curve.deviation;
      // The file has to agree with all points, since the curve is that of some of them.
      for (unsigned int k = 0; k < at_points.size() && dim == 3; ++k)
        {
          if (is_interpolated(k))
            continue;
          s[0] = std::min(1., axes[swept->curve].values[k] * axes[swept->curve].unit / range[0]);
          summary.deviation =
            std::max(summary.deviation,
                     curve.distance(swept->sweep.section(in_space<dim>(at_points[k])), s));
        }
    }
  if constexpr (dim == 3)
    if (summary.deviation > asked)
      {
        axes = coordinates->all_axes();
        const shape::FaceChart<3> chart(*face, axes);
        const auto surface = io::fit_splines(io::points_of(chart, at_points), asked, most_points);
        of_file            = spline_face<3>(surface, chart.range());
        summary            = {
          name, {surface.n_spans(0), surface.n_spans(1)}, "surface", surface.deviation, asked};
      }
  const shape::FaceChart<dim> chart(*face, axes);
  of_file.name     = name;
  of_file.reversed = !chart.is_oriented();
  add_loops(chart, of_file.sweep == cad::SplineFace::Sweep::revolved ? axes[0].unit : 1., of_file);
  return result;
}

template class DesignedFace<2>;
template class DesignedFace<3>;
} // namespace snug::app
