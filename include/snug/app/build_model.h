#ifndef snug_app_build_model_h
#define snug_app_build_model_h

#include <snug/app/build_loads.h>
#include <snug/base/errors.h>
#include <snug/state/state_solver.h>

namespace snug::app {
/// Return the result of @p make. An InputError of @p make is thrown again with the file of the
/// scene in front, as in all errors of the input.
template <typename Make>
auto made_of(const scene::Scene &scene, const Make &make)
{
  try
    {
      return make();
    }
  catch (const InputError &error)
    {
      throw InputError(scene.file + ": " + error.what());
    }
}

/// The meshes of all bodies. Collective. @throws InputError naming the
/// file.
template <int dim>
std::unique_ptr<mesh::BodyMesh<dim>> build_mesh(const scene::Scene &scene, MPI_Comm communicator);

/// The same, on the books of the run's setup.
template <int dim>
std::unique_ptr<mesh::BodyMesh<dim>> timed_mesh(RunContext &context, const scene::Scene &scene);

/// Mesh entries of all bodies, in their order.
std::vector<geometry::BodyMeshParameters> mesh_parameters(const scene::Scene &scene);

/// The state problem of a scene: names of bodies and boundaries become
/// indices. @throws InputError for names that do not exist.
template <int dim>
state::Model<dim> build_model(const scene::Scene &scene, const mesh::BodyMesh<dim> &mesh);
} // namespace snug::app

#endif
