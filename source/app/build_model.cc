#include <snug/app/build_model.h>
#include <snug/app/build_points.h>
#include <snug/geometry/face_list.h>
#include <snug/sensitivity/methods.h>

#include <algorithm>
#include <limits>

namespace snug::app {
namespace {
template <int dim>
contact::Pair find_pair(const scene::Scene                      &scene,
                        const mesh::BodyMesh<dim>               &mesh,
                        const contact::ContactParameters::Entry &entry)
{
  contact::Pair pair;
  pair.slave       = find_side(scene, mesh, entry.slave);
  pair.slave_name  = entry.slave;
  pair.master_name = entry.master;
  pair.parameters  = entry.parameters;
  for (const auto &obstacle : scene.obstacles)
    if (obstacle.name == entry.master)
      pair.obstacle = obstacle;
  if (!pair.obstacle)
    pair.master = find_side(scene, mesh, entry.master);
  return pair;
}

/// Return the relative tolerance of states.
template <int dim>
double state_tolerance(const scene::Scene &scene)
{
  if (scene.state_tolerance || scene.task != scene::Task::optimize)
    return scene.state_tolerance.value_or(qp::SolverParameters().relative_tolerance);
  std::vector<std::string> responses = {scene.optimization.objective};
  for (const auto &constraint : scene.optimization.constraints)
    responses.push_back(scene::constraint_name(scene, constraint.first).response);
  return search_tolerance<dim>(scene, responses);
}

/// Return "body.boundary" of the faces that are held along their normals.
std::vector<std::string> held_along_normals(const scene::Scene &scene)
{
  const unsigned int       dim = scene.dimension; // the component of the normal
  std::vector<std::string> faces;
  const auto add = [&](const std::string &prefix, const scene::LoadParameters &loads) {
    for (const auto &[face, motion] : loads.displacements)
      if (scene::component_number(scene::split_displacement(motion).first, dim) == dim)
        faces.push_back(prefix + face);
  };
  for (const auto &body : scene.bodies)
    {
      for (const auto &[face, components] : body.supports)
        for (const unsigned int component : scene::component_list(components, dim))
          if (component == dim)
            faces.push_back(body.name + "." + face);
      add(body.name + ".", body.loads);
    }
  for (const auto &load_case : scene.load_cases)
    add("", loads_on_faces(scene, load_case.loads));
  return faces;
}
} // namespace

template <int dim>
double search_tolerance(const scene::Scene &scene, const std::vector<std::string> &responses)
{
  const double usual = qp::SolverParameters().relative_tolerance, least = 1e-10;
  const bool   sharp = std::any_of(responses.begin(), responses.end(), [&](const auto &name) {
    return sensitivity::needs_solve(*response::make_response<dim>(
                                      *scene::response_called(scene, name)),
                                      scene::has_potential(scene));
  });
  return sharp ? std::clamp(scene.optimization.objective_tolerance, least, usual) : usual;
}

std::vector<geometry::BodyMeshParameters> mesh_parameters(const scene::Scene &scene)
{
  // True surfaces are needed where contact, normal supports and shaped faces are. Estimates of
  // responses need the true surfaces of all curved faces.
  auto faces = held_along_normals(scene);
  for (const auto &pair : scene.contact.pairs)
    for (const auto &side : {pair.slave, pair.master})
      for (const auto &face : geometry::face_list(side))
        faces.push_back(face);
  bool is_designed = false;
  for (const auto &shape : scene.shapes)
    {
      for (const auto &face : geometry::face_list(shape.face))
        faces.push_back(face);
      is_designed = is_designed || shape.moves();
    }
  std::vector<geometry::BodyMeshParameters> parameters;
  for (const auto &body : scene.bodies)
    {
      parameters.push_back(body.mesh);
      parameters.back().is_designed = is_designed;
      parameters.back().samples_all_curved =
        scene.accuracy.estimate == accuracy::Estimate::responses || !scene.accuracy.targets.empty();
      for (const auto &face : faces)
        if (face.rfind(body.name + ".", 0) == 0)
          parameters.back().sampled_boundaries.push_back(face.substr(body.name.size() + 1));
    }
  return parameters;
}

template <int dim>
std::unique_ptr<mesh::Forest<dim>> build_forest(const scene::Scene &scene, MPI_Comm communicator)
{
  return with_file_context(scene, [&]() {
    return std::make_unique<mesh::Forest<dim>>(communicator, mesh_parameters(scene));
  });
}

template <int dim>
std::unique_ptr<mesh::BodyMesh<dim>>
build_mesh(const scene::Scene &scene, const mesh::Forest<dim> &forest, const bool is_torn)
{
  std::optional<mesh::TearingParameters> tearing;
  if (is_torn)
    {
      tearing = scene.tearing;
      // The same subdomains on any number of ranks give the same adaptive meshes.
      tearing->at_least_ranks = scene.accuracy.targets.empty();
      for (const auto &body : scene.bodies)
        tearing->nearly_incompressible.push_back(scene::is_nearly_incompressible(scene, body));
    }
  return with_file_context(scene, [&]() {
    return std::make_unique<mesh::BodyMesh<dim>>(forest, scene.degree, idealization(scene),
                                                 tearing);
  });
}

template <int dim>
std::unique_ptr<mesh::BodyMesh<dim>> build_mesh(const scene::Scene &scene, MPI_Comm communicator)
{
  return build_mesh(scene, *build_forest<dim>(scene, communicator));
}

template <int dim>
std::vector<contact::Pair> build_pairs(const scene::Scene &scene, const mesh::BodyMesh<dim> &mesh)
{
  std::vector<contact::Pair> pairs;
  const auto                 modulus = [&](const contact::Side &side) {
    const auto &body = scene.bodies[side.body()];
    const auto  materials = materials_of(scene, body, mesh.geometry(side.body()).region_names());
    double      least = std::numeric_limits<double>::max();
    for (const auto &material : materials)
      least = std::min(least, material.youngs_modulus);
    for (const auto &point : scene.points)
      for (const auto &face : point.faces)
        if (side.has(find_face(scene, mesh, face)))
          return std::numeric_limits<double>::infinity();
    return least;
  };
  for (const auto &entry : scene.contact.pairs)
    {
      auto pair = find_pair(scene, mesh, entry);
      if (!pair.obstacle)
        pair.modulus_ratio = modulus(pair.slave) / modulus(pair.master);
      pairs.push_back(std::move(pair));
    }
  return pairs;
}

template <int dim>
state::Model<dim> build_model(const scene::Scene &scene, const mesh::BodyMesh<dim> &mesh)
{
  state::Model<dim> model;
  model.least_scaled_jacobian     = scene.least_scaled_jacobian;
  model.feti                      = scene.feti;
  model.solver                    = scene.solver;
  model.solver.relative_tolerance = state_tolerance<dim>(scene);
  for (unsigned int b = 0; b < scene.bodies.size(); ++b)
    {
      const auto &body = scene.bodies[b];
      model.body_names.push_back(body.name);
      model.bodies.emplace_back();
      model.bodies.back().materials   = materials_of(scene, body, mesh.geometry(b).region_names());
      model.bodies.back().formulation = body.formulation;
      model.bodies.back().axis        = build_component<dim>(scene, b, 0).axis;
    }
  model.load_cases     = build_load_cases(scene, mesh);
  model.supports       = build_supports(scene, mesh);
  model.point_supports = build_point_supports(scene, mesh);
  model.springs        = build_springs(scene, mesh);
  build_points(scene, mesh, model);
  for (const auto &pair : build_pairs(scene, mesh))
    (pair.parameters.law == contact::Law::tied ? model.ties : model.pairs).push_back(pair);
  return model;
}

template <int dim>
std::unique_ptr<mesh::BodyMesh<dim>> timed_mesh(RunContext &context, const scene::Scene &scene)
{
  const RunContext::Timer timer(context, "setup");
  return build_mesh<dim>(scene, context.communicator());
}

#define SNUG_INSTANTIATE(dim)                                                                    \
  template double search_tolerance<dim>(const scene::Scene &, const std::vector<std::string> &); \
  template std::unique_ptr<mesh::Forest<dim>>   build_forest(const scene::Scene &, MPI_Comm);    \
  template std::unique_ptr<mesh::BodyMesh<dim>> build_mesh(const scene::Scene &,                 \
                                                           const mesh::Forest<dim> &, bool);     \
  template std::unique_ptr<mesh::BodyMesh<dim>> build_mesh(const scene::Scene &, MPI_Comm);      \
  template std::unique_ptr<mesh::BodyMesh<dim>> timed_mesh(RunContext &, const scene::Scene &);  \
  template std::vector<contact::Pair>           build_pairs(const scene::Scene &,                \
                                                            const mesh::BodyMesh<dim> &);        \
  template state::Model<dim> build_model(const scene::Scene &, const mesh::BodyMesh<dim> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::app
