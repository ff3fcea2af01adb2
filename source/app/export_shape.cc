#include <snug/app/designed_face.h>
#include <snug/app/results.h>
#include <snug/geometry/face_list.h>
#include <snug/io/profile.h>
#include <snug/io/shape_export.h>
#include <snug/io/text_file.h>
#include <snug/io/whole_mesh.h>

#include <algorithm>
#include <sstream>

namespace snug::app {
namespace {
/// Return the shaped faces of a design. Collective.
template <int dim>
std::vector<DesignedFace<dim>> designed_faces(const ShapeProblem<dim> &problem,
                                              const mesh::Field<dim>  &positions)
{
  shape::BodyNames names;
  for (const auto &body : problem.scene.bodies)
    names.names.push_back(body.name);
  std::vector<DesignedFace<dim>> result;
  for (const auto &[body, boundary] : problem.shapes->faces())
    {
      shape::ShapeParameters parameters;
      parameters.face =
        names.names[body] + '.' + problem.mesh->geometry(body).boundary_names()[boundary];
      for (const auto &one : problem.scene.shapes)
        {
          const auto list = geometry::face_list(one.face);
          if (std::find(list.begin(), list.end(), parameters.face) != list.end())
            {
              parameters.axis       = one.axis;
              parameters.axis_point = one.axis_point;
            }
        }
      result.emplace_back(*problem.mesh, names, parameters, positions);
    }
  return result;
}

} // namespace

template <int dim>
const std::vector<unsigned int> &Results<dim>::numbers_of_nodes()
{
  if (!node_numbers)
    node_numbers = io::gather_node_numbers(*problem->mesh);
  return *node_numbers;
}

template <int dim>
void Results<dim>::export_shape(const std::vector<double> &design)
{
  if (problem->shapes->n_variables() == 0)
    return;
  const RunContext::Timer  timer(problem->context, "output");
  const auto               boundaries = problem->shapes->faces();
  const mesh::Surface<dim> surface(*problem->mesh, boundaries);
  const auto               positions  = problem->positions(design);
  const auto               at_surface = surface.gather(positions);
  const auto              &number_of  = numbers_of_nodes();
  const auto               points     = problem->shapes->control_points(design);
  const auto planes = state::symmetry_planes(*problem->mesh, problem->solver->model().supports);
  const auto faces  = designed_faces(*problem, positions);
  throw_collectively(problem->context.communicator(), [&]() {
    if (problem->context.rank() != 0)
      return;
    if constexpr (dim == 3)
      io::write_surface(path("surface.stl"), surface, at_surface);
    const auto name = [&](const unsigned int body, const unsigned int boundary) {
      return io::boundary_name(*problem->mesh, problem->scene, body, boundary);
    };
    const auto number = [&](const unsigned int node) {
      return number_of[surface.global_node(node)] + 1;
    };
    const auto place = [&](const io::SurfacePiece &piece, const unsigned int node) {
      const auto found =
        std::find(boundaries.begin(), boundaries.end(), std::make_pair(piece.body, piece.boundary));
      return faces[found - boundaries.begin()].place(surface.global_node(node));
    };
    io::write_text_file(path("profile.csv"),
                        io::profile_text<dim>(surface, at_surface, problem->mesh->degree(),
                                              {name, number, planes, place}));
    io::write_control_points(path("control-points.csv"), points);
    for (const auto &face : faces)
      problem->context.out() << face.crown(Units(problem->scene.units).name("length"), planes);
    export_profile(faces);
  });
}

template <int dim>
void Results<dim>::export_profile(const std::vector<DesignedFace<dim>> &designed)
{
  const auto &scene = problem->scene;
  if (scene.output.profile_deviation == 0.)
    return;
  summary.profile.clear();
  std::vector<std::string>     failures;
  std::vector<cad::SplineFace> faces;
  for (const auto &one : designed)
    try
      {
        const double asked            = scene.output.profile_deviation * one.size();
        const auto [face, of_summary] = one.splines(asked);
        faces.push_back(face);
        summary.profile.push_back(of_summary);
      }
    catch (const InputError &error)
      {
        failures.push_back("profile.step lacks the face " + one.name + ": " + error.what());
      }
  if (!faces.empty())
    cad::write_step(path("profile.step"), Units(scene.units).name("length"), faces);
  report_profile(failures);
  export_solids(designed);
}

template <int dim>
void Results<dim>::report_profile(std::vector<std::string> lines)
{
  const std::string unit = Units(problem->scene.units).after_number("length");
  for (const auto &face : summary.profile)
    {
      std::ostringstream line;
      line << "profile.step: face " << face.name << ", "
           << (face.kind == "revolved curve" ? "revolved B-spline of " : "B-splines of ")
           << face.spans.front();
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
  template void Results<dim>::export_profile(const std::vector<DesignedFace<dim>> &);                \
  template void Results<dim>::report_profile(std::vector<std::string>);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::app
