#include <snug/app/designed_face.h>
#include <snug/base/errors.h>
#include <snug/io/profile.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <numeric>
#include <random>
#include <sstream>

namespace snug::app {
namespace {
using shape::Coordinates;

/// Displacements are constant along a coordinate up to this part of the maximum displacement.
const double constant = 1e-6;

const unsigned int most_of_curve = 500; ///< control points of a curve

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
  static const double x_to_z[] = {0., 0., 1., 0., 0.}; // z, y and x, each of three numbers
  std::vector<std::pair<Coordinates, std::vector<double>>> choices = {
    {Coordinates::arc_length, parameters.axis},
    {Coordinates::projection, {}},
    {Coordinates::angle, parameters.axis}};
  if (dim == 3 && parameters.axis.empty())
    for (const double *axis : {x_to_z, x_to_z + 1, x_to_z + 2})
      choices.emplace_back(Coordinates::angle, std::vector<double>(axis, axis + 3));
  std::vector<shape::FaceCoordinates<dim>> result;
  for (const auto &[kind, axis] : choices)
    try
      {
        parameters.coordinates = kind;
        parameters.axis        = axis;
        result.emplace_back(face, parameters);
      }
    catch (const InputError &)
      {
        continue; // the face has no such coordinates
      }
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

/// Set the loops of a face that does not fill the rectangle of its coordinates. The first parameter
/// of the face is the first coordinate divided by @p unit.
/// @throws InputError if the coordinates are closed.
void add_loops(const shape::FaceChart<2> &, double, cad::SplineFace &) {}
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
  // A design may be constant around an axis, along an extrusion, or else across a plane.
  for (const auto kind : {Coordinates::angle, Coordinates::arc_length, Coordinates::projection})
    for (const auto &one : all)
      for (unsigned int a = 0; a < dim - 1; ++a)
        if (!section && one.kind() == kind &&
            (kind == Coordinates::projection || (kind == Coordinates::angle) == (a == 1)) &&
            depends_on(one.axis(a)))
          section.emplace(one, a);
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
  std::vector<std::pair<double, double>> sorted; // coordinate, displacement
  for (unsigned int k = 0; k < moves.size(); ++k)
    if (!is_interpolated(k))
      sorted.emplace_back(coordinate.values[k], moves[k]);
  std::sort(sorted.begin(), sorted.end());
  const double rounding  = constant * largest_move;
  const auto   continues = [&](const unsigned int k) {
    return sorted[k].first - sorted[k - 1].first <= equal * coordinate.range;
  };
  unsigned int first = 0; // of the points at the same coordinate
  for (unsigned int k = 1; k < sorted.size(); ++k)
    {
      const double move = sorted[k].second;
      first             = continues(k) ? first : k;
      if (std::abs(move - sorted[first].second) > rounding)
        return false;
      if (first != k || k + 1 == sorted.size() || continues(k + 1))
        continue;
      const auto [low, top] = std::minmax(sorted[k - 1].second, sorted[k + 1].second);
      if (move < low - rounding || move > top + rounding)
        return false;
    }
  return true;
}

template <int dim>
double DesignedFace<dim>::size() const
{
  Vector extent;
  for (unsigned int d = 0; d < dim; ++d)
    {
      const auto [low, top] =
        std::minmax_element(at_points.begin(), at_points.end(),
                            [d](const auto &a, const auto &b) { return a[d] < b[d]; });
      extent[d] = (*top)[d] - (*low)[d];
    }
  return extent.norm();
}

template <int dim>
std::array<unsigned int, 2> DesignedFace<dim>::place(const unsigned int global_node) const
{
  const unsigned int node = face->surface().find(global_node);
  if (ranks.empty())
    return {{0, 0}};
  return {{ranks.front()[node], ranks.back()[node]}};
}

template <int dim>
std::string DesignedFace<dim>::crown(const std::string                            &unit,
                                     const std::vector<state::SymmetryPlane<dim>> &planes) const
{
  const auto &surface = face->surface();
  const auto  m =
    io::mean_normal(surface, io::surface_pieces(surface).front(), face->mesh().degree(), planes);
  if (!section || largest_move <= 1e-12 * size())
    return "";
  const auto &[own, along] = *section;
  const auto axis          = own.line();
  // The depth of a cap is that along its axis.
  const bool around = dim == 3 && own.kind() == Coordinates::angle;
  const bool radial = around && std::abs(in_space<dim>(m) * axis.direction) < 0.99;
  if (!radial && m.norm() == 0.)
    return "";
  const auto   lever = [&](const Vector &x) { return in_space<dim>(x) - axis.point; };
  const double sign =
    lever(face->positions()[0]) * in_space<dim>(face->free_normals()[0]) < 0. ? -1. : 1.;
  const auto height = [&](const Vector &x) {
    return radial ? sign * cross_product_3d(axis.direction, lever(x)).norm() : m * x;
  };
  const auto position = [&](const unsigned int k) {
    const Vector &x = face->positions()[k];
    return !around  ? own.axis(along).lower + own.axis(along).values[k]
           : radial ? in_space<dim>(x) * axis.direction
                    : cross_product_3d(axis.direction, lever(x)).norm();
  };
  double                         before = -HUGE_VAL, after = -HUGE_VAL;
  std::map<double, unsigned int> sorted;
  for (unsigned int k = 0; k < at_points.size(); ++k)
    if (!is_interpolated(k))
      {
        sorted.emplace(position(k), k);
        before = std::max(before, height(face->positions()[k]));
        after  = std::max(after, height(at_points[k]));
      }
  std::ostringstream text;
  text << "face " << name << ", drop " << (radial || !around ? "along " : "by distances from ");
  if (around)
    text << "the axis (" << axis.direction << ')';
  else
    text << (own.kind() == Coordinates::projection
               ? std::string(1, "xyz"[own.projection_axes()[along]])
               : "the face");
  text << (unit.empty() ? "" : ", in " + unit)
       << ":\n      position   drop before    drop after        change\n"
       << std::setprecision(5);
  const double rounding = constant * largest_move;
  const auto   shown    = [&](const double x) { return std::abs(x) <= rounding ? 0. : x; };
  const double first = sorted.begin()->first, range = sorted.rbegin()->first - first;
  unsigned int row = 0;
  for (const auto &[at, k] : sorted)
    {
      if (at < first + (row / 8. - equal) * range)
        continue;
      ++row;
      const Vector &x = face->positions()[k], &y = at_points[k];
      for (const double number : {at, before - height(x), after - height(y), height(y) - height(x)})
        text << std::setw(14) << shown(number);
      text << '\n';
    }
  return text.str();
}

/// Fit a curve to the meridians of the face, at random angles, and measure its distance from all
/// points of the face.
template <>
void DesignedFace<3>::fit_revolved(cad::SplineFace          &of_file,
                                   io::Summary::ProfileFace &summary) const
{
  const shape::FaceChart<3> chart(*face, section->first);
  const auto                axis     = section->first.line();
  const auto                meridian = [&](const Vector &x) {
    const Vector         lever = x - axis.point;
    dealii::Tensor<1, 2> result;
    result[0] = cross_product_3d(axis.direction, lever).norm();
    result[1] = axis.direction * lever;
    return result;
  };
  std::mt19937                           random(1);
  std::uniform_real_distribution<double> uniform(0., 1.);
  io::CoordinatePoints<2>                points;
  points.range[0]  = chart.range()[1];
  points.closed[0] = chart.is_closed(1);
  points.point     = [&](const dealii::Tensor<1, 1> &s) -> std::optional<dealii::Tensor<1, 2>> {
    for (unsigned int trial = 0; trial < 10; ++trial)
      {
        shape::FaceChart<3>::Flat at;
        at[0] = uniform(random) * chart.range()[0];
        at[1] = s[0];
        if (const auto place = chart.find(at))
          return meridian(place->value(at_points));
      }
    return {};
  };
  const auto curve  = io::fit_splines(points, summary.asked / 2., most_of_curve);
  summary.spans     = {curve.n_spans(0)};
  summary.deviation = curve.deviation;
  for (unsigned int k = 0; k < at_points.size(); ++k)
    if (!is_interpolated(k))
      {
        dealii::Tensor<1, 1> s;
        s[0]              = section->first.fractions(k)[1];
        summary.deviation = std::max(summary.deviation, curve.distance(meridian(at_points[k]), s));
      }
  of_file           = spline_face<2>(curve, points.range);
  const auto &angle = section->first.axis(0);
  const auto  e     = shape::reference_direction(axis.direction);
  for (auto &q : of_file.points)
    q = dealii::Point<3>(axis.point + q[1] * axis.direction +
                         q[0] * (std::cos(angle.lower) * e +
                                 std::sin(angle.lower) * cross_product_3d(axis.direction, e)));
  of_file.sweep     = cad::SplineFace::Sweep::revolved;
  of_file.centre    = dealii::Point<3>(axis.point);
  of_file.direction = dealii::Point<3>(axis.direction);
  of_file.extent    = angle.range;
}

template <int dim>
std::pair<cad::SplineFace, io::Summary::ProfileFace>
DesignedFace<dim>::splines(const double asked) const
{
  if (!coordinates)
    throw InputError(
      "the face is not connected, or is not an extrusion, a surface of revolution or a "
      "graph over a coordinate plane");
  cad::SplineFace          of_file;
  io::Summary::ProfileFace summary{name, {}, "revolved curve", HUGE_VAL, asked};
  if constexpr (dim == 3)
    if (section && section->first.kind() == Coordinates::angle)
      fit_revolved(of_file, summary);
  const bool                  is_revolved = summary.deviation <= asked;
  const shape::FaceChart<dim> chart(*face, is_revolved ? section->first : *coordinates);
  if (!is_revolved)
    {
      summary.spans.clear();
      const auto surface = io::fit_splines(io::points_of(chart, at_points), asked, most_points);
      of_file            = spline_face<dim>(surface, chart.range());
      summary.kind       = dim == 2 ? "curve" : "surface";
      summary.deviation  = surface.deviation;
      for (unsigned int a = 0; a < dim - 1; ++a)
        summary.spans.push_back(surface.n_spans(a));
    }
  if (dim == 2)
    {
      const auto &idealization            = face->mesh().idealization();
      const bool  revolved                = idealization.is_axisymmetric();
      using Sweep                         = cad::SplineFace::Sweep;
      of_file.sweep                       = revolved ? Sweep::revolved : Sweep::extruded;
      of_file.direction[revolved ? 1 : 2] = 1.;
      of_file.extent                      = revolved ? 2. * M_PI : idealization.thickness;
    }
  of_file.name     = name;
  of_file.reversed = !chart.is_oriented();
  add_loops(chart, is_revolved ? section->first.axis(0).unit : 1., of_file);
  return {of_file, summary};
}

template class DesignedFace<2>;
template class DesignedFace<3>;
template cad::SplineFace spline_face<3>(const io::SplineSurface<3> &,
                                        const dealii::Tensor<1, 2> &,
                                        const dealii::Tensor<1, 2> &);
} // namespace snug::app
