#include <snug/app/results.h>
#include <snug/cad/write_step.h>
#include <snug/geometry/face_list.h>
#include <snug/io/profile.h>
#include <snug/io/shape_export.h>
#include <snug/io/spline_surface.h>
#include <snug/io/text_file.h>
#include <snug/io/whole_mesh.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace snug::app {
namespace {
/// Maximum number of control points of a face.
const unsigned int most_points = 5000;

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

/**
 * Return coordinates of a face for splines: arc length of an extrusion, projection of a gentle
 * graph, angle of a surface of revolution, or projection of any graph. The axis is that of
 * @p parameters, or for the angle x, y, z. @throws InputError if the face has no coordinates.
 */
template <int dim>
shape::FaceCoordinates<dim> spline_coordinates(const shape::ShapedFace<dim> &face,
                                               shape::ShapeParameters        parameters)
{
  using shape::Coordinates;
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
  for (const auto &[kind, axis] : choices)
    try
      {
        parameters.coordinates = kind;
        parameters.axis        = axis;
        shape::FaceCoordinates<dim> coordinates(face, parameters);
        if (is_suitable(face, coordinates))
          return coordinates;
      }
    catch (const InputError &)
      {}
  parameters.coordinates = Coordinates::projection;
  try
    {
      return shape::FaceCoordinates<dim>(face, parameters);
    }
  catch (const InputError &)
    {
      throw InputError(
        "the face is not connected, or is not an extrusion, a surface of revolution or a "
        "graph over a coordinate plane");
    }
}

/// Return the surface as a face of a STEP file. The parameters of the splines are lengths.
template <int dim>
cad::SplineFace step_face(const io::SplineSurface<dim> &surface,
                          const shape::FaceChart<dim>  &chart,
                          const mesh::Idealization     &idealization)
{
  cad::SplineFace result;
  result.degree = surface.degree;
  for (unsigned int a = 0; a < dim - 1; ++a)
    {
      auto breaks = surface.axes[a].breaks();
      for (double &s : breaks)
        s *= chart.range()[a];
      result.axes.push_back({breaks, surface.axes[a].is_closed()});
    }
  for (const auto &x : surface.points)
    result.points.emplace_back(x[0], x[1], dim == 3 ? x[dim - 1] : 0.);
  result.reversed = !chart.is_oriented();
  if (dim == 2)
    {
      result.sweep     = idealization.is_axisymmetric() ? cad::SplineFace::Sweep::revolved
                                                        : cad::SplineFace::Sweep::extruded;
      result.thickness = idealization.thickness;
    }
  return result;
}

/// Set the loops of a face that does not fill the rectangle of its coordinates.
/// @throws InputError if the coordinates are closed.
void add_loops(const shape::FaceChart<2> & /*chart*/, cad::SplineFace & /*face*/) {}
void add_loops(const shape::FaceChart<3> &chart, cad::SplineFace &face)
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
            face.loops.back().back().emplace_back(s[0], s[1]);
        }
    }
}

template <int dim>
double size_of(const std::vector<dealii::Tensor<1, dim>> &positions)
{
  auto lower = positions.front(), upper = lower;
  for (const auto &x : positions)
    for (unsigned int d = 0; d < dim; ++d)
      {
        lower[d] = std::min(lower[d], x[d]);
        upper[d] = std::max(upper[d], x[d]);
      }
  return (upper - lower).norm();
}
} // namespace

template <int dim>
const std::vector<unsigned int> &Results<dim>::numbers_of_nodes()
{
  if (!node_numbers)
    node_numbers =
      io::gather_mesh<dim>(*problem->mesh, problem->mesh->reference_positions()).number_of;
  return *node_numbers;
}

template <int dim>
void Results<dim>::export_shape(const std::vector<double> &design)
{
  if (problem->shapes->n_variables() == 0)
    return;
  const RunContext::Timer  timer(problem->context, "output");
  const mesh::Surface<dim> faces(*problem->mesh, problem->shapes->faces());
  const auto               positions = problem->positions(design);
  const auto               at_faces  = faces.gather(positions);
  const auto              &number_of = numbers_of_nodes();
  const auto               points    = problem->shapes->control_points(design);
  const auto planes = state::symmetry_planes(*problem->mesh, problem->solver->model().supports);
  throw_collectively(problem->context.communicator(), [&]() {
    if (problem->context.rank() != 0)
      return;
    if constexpr (dim == 3)
      io::write_surface(path("surface.stl"), faces, at_faces);
    const auto name = [&](const unsigned int body, const unsigned int boundary) {
      return io::boundary_name(*problem->mesh, problem->scene, body, boundary);
    };
    const auto number = [&](const unsigned int node) {
      return number_of[faces.global_node(node)] + 1;
    };
    io::write_text_file(path("profile.csv"),
                        io::profile_text<dim>(faces, at_faces, problem->mesh->degree(),
                                              {name, number, planes}));
    io::write_control_points(path("control-points.csv"), points);
  });
  export_profile(design);
}

template <int dim>
void Results<dim>::export_profile(const std::vector<double> &design)
{
  const auto &scene = problem->scene;
  const auto &mesh  = *problem->mesh;
  if (scene.output.profile_deviation == 0.)
    return;
  summary.profile.clear();
  const auto               positions = problem->positions(design);
  shape::BodyNames         names;
  std::vector<std::string> failures;
  for (const auto &body : scene.bodies)
    names.names.push_back(body.name);
  std::vector<cad::SplineFace> faces;
  for (const auto &[body, boundary] : problem->shapes->faces())
    {
      shape::ShapeParameters parameters;
      parameters.face = names.names[body] + '.' + mesh.geometry(body).boundary_names()[boundary];
      for (const auto &one : scene.shapes)
        {
          const auto list = geometry::face_list(one.face);
          if (std::find(list.begin(), list.end(), parameters.face) != list.end())
            {
              parameters.axis       = one.axis;
              parameters.axis_point = one.axis_point;
            }
        }
      const shape::ShapedFace<dim> face(mesh, names, parameters);
      const auto                   at_points = face.surface().gather(positions);
      if (problem->context.rank() != 0)
        continue;
      try
        {
          const auto   coordinates = spline_coordinates(face, parameters);
          const double asked       = scene.output.profile_deviation * size_of<dim>(at_points);
          const shape::FaceChart<dim> chart(face, coordinates);
          const auto surface = io::fit_splines(chart, at_points, asked, most_points);
          auto       of_file = step_face(surface, chart, mesh.idealization());
          of_file.name       = parameters.face;
          add_loops(chart, of_file);
          faces.push_back(of_file);
          io::Summary::ProfileFace summarized{parameters.face, {}, surface.deviation, asked};
          for (unsigned int a = 0; a < dim - 1; ++a)
            summarized.spans.push_back(surface.n_spans(a));
          summary.profile.push_back(summarized);
        }
      catch (const InputError &error)
        {
          failures.push_back("profile.step lacks the face " + parameters.face + ": " +
                             error.what());
        }
    }
  throw_collectively(problem->context.communicator(), [&]() {
    if (!faces.empty())
      cad::write_step(path("profile.step"), scene.units.empty() ? "mm" : scene.units.front(),
                      faces);
  });
  report_profile(failures);
}

template <int dim>
void Results<dim>::report_profile(std::vector<std::string> lines)
{
  const std::string unit = Units(problem->scene.units).after_number("length");
  for (const auto &face : summary.profile)
    {
      std::ostringstream line;
      line << "profile.step: face " << face.name << ", B-splines of " << face.spans.front();
      for (unsigned int a = 1; a < face.spans.size(); ++a)
        line << " x " << face.spans[a];
      line << " spans, maximum deviation from the design " << face.deviation << unit;
      problem->context.out() << line.str() << std::endl;
      if (face.deviation > face.asked)
        {
          std::ostringstream more;
          more << "profile.step: face " << face.name << " deviates from the design by "
               << face.deviation << unit << ", more than the " << face.asked << unit
               << " of 'Output/Profile deviation', with the maximum of " << most_points
               << " control points";
          lines.push_back(more.str());
        }
    }
  if (!summary.profile.empty() && !problem->scene.units.empty() &&
      !cad::is_step_unit(problem->scene.units.front()))
    lines.push_back("profile.step is written in mm, because STEP files have no unit '" +
                    problem->scene.units.front() + "'");
  problem->context.warn("export", lines);
}

#define SNUG_INSTANTIATE(dim)                                                                        \
  template const std::vector<unsigned int> &Results<dim>::numbers_of_nodes();                        \
  template void                             Results<dim>::export_shape(const std::vector<double> &); \
  template void Results<dim>::export_profile(const std::vector<double> &);                           \
  template void Results<dim>::report_profile(std::vector<std::string>);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::app
