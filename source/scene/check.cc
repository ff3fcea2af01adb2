#include <snug/geometry/formula.h>
#include <snug/response/response.h>
#include <snug/scene/check.h>
#include <snug/sensitivity/methods.h>

#include <algorithm>
#include <cctype>

namespace snug::scene {
namespace {
bool is_good_name(const std::string &name)
{
  return !name.empty() && std::all_of(name.begin(), name.end(), [](const unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '-' || c == ' ';
  });
}

void check_list_of_names(const std::string              &entry,
                         const std::vector<std::string> &names,
                         const Origins                  &origins)
{
  for (const auto &name : names)
    {
      if (!is_good_name(name))
        throw origins.error(entry, to_text(names),
                            "names must be made of letters, digits, "
                            "'_', '-' and blanks");
      if (std::count(names.begin(), names.end(), name) > 1)
        throw origins.error(entry, to_text(names), "'" + name + "' must not occur twice");
    }
}

void check_model(const Scene &scene, const SectionCheck &top)
{
  using Kind       = mesh::Idealization::Kind;
  const bool plane = scene.model == Kind::plane_strain || scene.model == Kind::plane_stress;
  top.require((scene.model == Kind::solid) == (scene.dimension == 3), "Model", to_text(scene.model),
              scene.dimension == 3 ? "must be solid for Dimension = 3"
                                   : "must be one of plane strain, plane stress, "
                                     "axisymmetric for Dimension = 2");
  top.require(plane || scene.thickness == 1., "Thickness", to_text(scene.thickness),
              "must be left out for Model = " + to_text(scene.model));
  const bool no_names = scene.units.empty();
  top.require(no_names || (scene.units.size() == 2 && !scene.units[0].empty() &&
                           !scene.units[1].empty() && scene.units[0] != scene.units[1]),
              "Units", to_text(scene.units), "must be two different names, 'length, force'");
  top.require(!scene.output_directory.empty(), "Output directory", "", "must not be empty");
}

/// Throw unless a body with a temperature has a material that expands.
void require_expansion(const Scene        &scene,
                       const SectionCheck &section,
                       const std::string  &value,
                       const Body         &body)
{
  bool expands = body.materials.empty() && body.material.expansion != 0.;
  for (const auto &[region, name] : body.materials)
    for (const auto &known : scene.materials)
      expands = expands || (known.name == name && known.material.expansion != 0.);
  section.require(expands, "Temperature", value,
                  "must be empty, because the material of '" + body.name + "' has no 'Expansion'");
}

/// Check the loads of bodies and load cases.
void check_all_loads(const Scene &scene, const Origins &origins)
{
  LoadParameters::Held held;
  for (const auto &body : scene.bodies)
    {
      const SectionCheck section(body.section(), origins, scene.dimension);
      check_loads(section, body, held);
      if (!body.temperature.empty())
        require_expansion(scene, section, body.temperature, body);
    }
  for (const auto &load_case : scene.load_cases)
    {
      const SectionCheck section(load_case.section(), origins, scene.dimension);
      const auto         loads = loads_on_faces(scene, load_case.loads);
      loads.check(section, [&](const auto &entry, const auto &value, const auto &face) {
        require_face(scene, section, entry, value, face);
      });
      auto names = names_of(scene.bodies);
      for (const auto &obstacle : scene.obstacles)
        names.push_back(obstacle.name);
      load_case.check_positions(section, names);
      for (const auto &[name, formula] : load_case.temperatures)
        {
          const std::string  value = to_text(load_case.temperatures);
          const unsigned int index = body_index(scene, name);
          section.require(index < scene.bodies.size(), "Temperature", value,
                          "there is no body '" + quotable(name) + "'");
          geometry::require_formula(section, "Temperature", value, formula);
          require_expansion(scene, section, value, scene.bodies[index]);
        }
      const auto *before = &load_case == &scene.load_cases.front() ? nullptr : &load_case - 1;
      section.require(!load_case.load_step || before == nullptr ||
                        before->positions == load_case.positions,
                      "Load step", "true",
                      "must be false, because 'Position' is not that of the load case before");
      section.require(load_case.positions.empty() ||
                        scene.model != mesh::Idealization::Kind::axisymmetric,
                      "Position", to_text(load_case.positions, ';'),
                      "must be empty for Model = axisymmetric");
      auto held_here = held;
      loads.check_displacements(section, "", held_here);
    }
  const bool no_weight = std::all_of(scene.load_cases.begin(), scene.load_cases.end(),
                                     [](const auto &of) { return of.weight == 0.; });
  if (!scene.load_cases.empty() && no_weight)
    throw origins.error(scene.load_cases.front().section() + "/Weight", "0",
                        "must be above 0 for at least one load case");
}

void check_gradient(const Scene &scene, const SectionCheck &section)
{
  // The responses of 2D and 3D are the same in this respect.
  const std::string &objective = scene.optimization.objective;
  const auto         measured  = response_called(scene, objective);
  section.require(scene.gradient.method != sensitivity::Method::energy ||
                    !sensitivity::needs_solve(*response::make_response<3>(*measured),
                                              has_potential(scene)),
                  "Method", to_text(scene.gradient.method),
                  "must be auto, adjoint, direct or finite differences for the objective '" +
                    objective + "'");
}

/// Check that the dual problem has no springs where it is exported.
void check_export(const Scene &scene, const Origins &origins)
{
  const bool has_springs =
    std::any_of(scene.bodies.begin(), scene.bodies.end(), [](const Body &body) {
      return !body.springs.empty() || !body.point_springs.empty();
    });
  SectionCheck("Output", origins, scene.dimension)
    .require(!scene.output.export_qp || !has_springs, "Export QP", "true",
             "must be false with springs, which the exported matrices do not contain");
}

/// Check what does not know clusters of subdomains. The proof of convergence of SMALSE-M needs the
/// eigenvalues of F, some of which clusters make zero.
void check_clusters(const Scene &scene, const Origins &origins)
{
  SectionCheck("Solver", origins, scene.dimension)
    .require(scene.tearing.cluster_edge <= 1 || scene.solver.method == "active set", "Method",
             scene.solver.method,
             "must be 'active set' with clusters of subdomains ('Decomposition/Subdomains per "
             "cluster edge')");
}

/// Check what does not know friction.
void check_friction(const Scene &scene, const Origins &origins)
{
  if (!has_friction(scene))
    return;
  SectionCheck("Solver", origins, scene.dimension)
    .require(scene.solver.method == "active set", "Method", scene.solver.method,
             "must be 'active set' with friction");
  SectionCheck("Output", origins, scene.dimension)
    .require(!scene.output.export_qp, "Export QP", "true",
             "must be false with friction, because the problem is no quadratic program");
}

/// Check the targets. A search needs the error of its objective, and variables that are the same
/// on all meshes.
void check_targets(const Scene &scene, const SectionCheck &section)
{
  const auto &targets = scene.accuracy.targets;
  if (targets.empty())
    return;
  const auto require = [&](const bool good, const std::string &allowed) {
    section.require(good, "Target", to_text(targets), allowed);
  };
  require(scene.task != Task::sensitivity, "must be empty for Task = sensitivity");
  for (const auto &target : targets)
    require(response::make_response<3>(*response_called(scene, target.first))->has_estimate(),
            "must not name '" + target.first + "', because its error is not estimated");
  if (scene.task != Task::optimize)
    return;
  const std::string &objective = scene.optimization.objective;
  require(!response::make_response<3>(*response_called(scene, objective))->needs_solution() ||
            std::any_of(targets.begin(), targets.end(),
                        [&](const auto &target) { return target.first == objective; }),
          "must name the objective, '" + objective + "'");
  for (const auto &shape : scene.shapes)
    require(!shape.reads("Filter radius"),
            "must be empty for node-wise shapes, whose variables depend on the mesh");
}

void check_entries(const Scene &scene, const Origins &origins)
{
  Scene   copy = scene;
  Entries entries;
  declare(entries, copy);
  entries.check(origins, scene.dimension);
}
} // namespace

void check_names(const Scene &scene, const Origins &origins)
{
  if (scene.bodies.empty())
    throw origins.error("Bodies", "", "must name at least one body");
  check_list_of_names("Bodies", names_of(scene.bodies), origins);
  check_list_of_names("Load cases", names_of(scene.load_cases), origins);
  check_list_of_names("Materials", names_of(scene.materials), origins);
  check_list_of_names("Obstacles", names_of(scene.obstacles), origins);
  check_list_of_names("Reference points", names_of(scene.points), origins);
  check_list_of_names("Bolts", names_of(scene.bolts), origins);
  check_list_of_names("Responses", names_of(scene.responses), origins);
  if (scene.shapes.size() > 1 || !scene.shapes.front().name.empty())
    check_list_of_names("Shapes", names_of(scene.shapes), origins);
}

namespace {
/// Return whether every rank makes its own cells only: all bodies are grids without refined cells.
bool are_cells_local(const Scene &scene)
{
  using geometry::Source;
  return scene.tearing.method != "METIS" && scene.accuracy.targets.empty() &&
         std::all_of(scene.bodies.begin(), scene.bodies.end(), [](const Body &body) {
           return (body.mesh.source == Source::box || body.mesh.source == Source::ring) &&
                  body.mesh.refinements == 0 && body.mesh.local_refinements == 0;
         });
}
} // namespace

void check(const Scene &scene, const Origins &origins, const unsigned int n_ranks)
{
  const auto section = [&](const std::string &name) {
    return SectionCheck(name, origins, scene.dimension);
  };
  check_names(scene, origins);
  check_entries(scene, origins);
  check_model(scene, section(""));
  for (const auto &material : scene.materials)
    material.material.check(section(material.section()));
  for (const auto &body : scene.bodies)
    check_body(scene, section(body.section()), body, are_cells_local(scene) ? n_ranks : 1);
  check_all_loads(scene, origins);
  check_export(scene, origins);
  check_contact(scene, origins);
  check_points(scene, origins);
  check_bolts(scene, origins);
  check_shapes(scene, origins);
  check_responses(scene, origins);
  check_friction(scene, origins);
  check_clusters(scene, origins);
  check_gradient(scene, section("Gradient"));
  scene.accuracy.check(section("Accuracy"));
  scene.output.check(section("Output"));
  check_targets(scene, section("Accuracy"));
}

void require_boundary(const SectionCheck &section,
                      const std::string  &entry,
                      const std::string  &value,
                      const Body         &body,
                      const std::string  &boundary)
{
  const auto known = boundary_names(body, section.dimension);
  section.require(std::find(known.begin(), known.end(), boundary) != known.end(), entry, value,
                  "'" + quotable(boundary) + "' is not a boundary of '" + body.name +
                    "'; the boundaries are " + to_text(known),
                  suggestion(boundary, known));
}

void require_face(const Scene        &scene,
                  const SectionCheck &section,
                  const std::string  &entry,
                  const std::string  &value,
                  const std::string  &face)
{
  const auto [name, boundary] = split_face(face);
  const unsigned int index    = body_index(scene, name);
  const auto         known    = names_of(scene.bodies);
  section.require(!boundary.empty(), entry, value,
                  "'" + quotable(face) + "' must read 'body.boundary'" +
                    (scene.obstacles.empty() ? "" : " or be an obstacle in 'Obstacles'"));
  section.require(index < scene.bodies.size(), entry, value,
                  "there is no body '" + quotable(name) + "'; the bodies are " + to_text(known),
                  suggestion(name, known));
  require_boundary(section, entry, value, scene.bodies[index], boundary);
}
} // namespace snug::scene
