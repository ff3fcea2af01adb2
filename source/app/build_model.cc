#include <snug/app/build_model.h>

namespace snug::app {
namespace {
template <int dim>
contact::Pair find_pair(const scene::Scene                      &scene,
                        const mesh::BodyMesh<dim>               &mesh,
                        const contact::ContactParameters::Entry &entry)
{
  contact::Pair pair;
  pair.slave       = find_face(scene, mesh, entry.slave);
  pair.slave_name  = entry.slave;
  pair.master_name = entry.master;
  pair.parameters  = entry.parameters;
  for (const auto &obstacle : scene.obstacles)
    if (obstacle.name == entry.master)
      pair.obstacle = obstacle;
  if (!pair.obstacle)
    pair.master = find_face(scene, mesh, entry.master);
  return pair;
}
} // namespace

std::vector<geometry::BodyMeshParameters> mesh_parameters(const scene::Scene &scene)
{
  std::vector<geometry::BodyMeshParameters> parameters;
  for (const auto &body : scene.bodies)
    parameters.push_back(body.mesh);
  return parameters;
}

template <int dim>
std::unique_ptr<mesh::BodyMesh<dim>> build_mesh(const scene::Scene &scene, MPI_Comm communicator)
{
  return made_of(scene, [&]() {
    return std::make_unique<mesh::BodyMesh<dim>>(communicator, mesh_parameters(scene), scene.degree,
                                                 idealization(scene), scene.tearing);
  });
}

template <int dim>
state::Model<dim> build_model(const scene::Scene &scene, const mesh::BodyMesh<dim> &mesh)
{
  state::Model<dim> model;
  model.least_scaled_jacobian = scene.least_scaled_jacobian;
  model.feti                  = scene.feti;
  model.solver                = scene.solver;
  for (unsigned int b = 0; b < scene.bodies.size(); ++b)
    {
      const auto &body = scene.bodies[b];
      model.body_names.push_back(body.name);
      model.bodies.emplace_back();
      model.bodies.back().materials   = materials_of(scene, body, mesh.geometry(b).region_names());
      model.bodies.back().formulation = body.formulation;
    }
  model.load_cases = build_load_cases(scene, mesh);
  model.supports   = build_supports(scene, mesh);
  for (const auto &entry : scene.contact.pairs)
    model.pairs.push_back(find_pair(scene, mesh, entry));
  return model;
}

template std::unique_ptr<mesh::BodyMesh<2>> build_mesh(const scene::Scene &, MPI_Comm);
template std::unique_ptr<mesh::BodyMesh<3>> build_mesh(const scene::Scene &, MPI_Comm);
template state::Model<2> build_model(const scene::Scene &, const mesh::BodyMesh<2> &);
template state::Model<3> build_model(const scene::Scene &, const mesh::BodyMesh<3> &);
} // namespace snug::app
