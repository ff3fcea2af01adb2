#ifndef snug_app_build_model_h
#define snug_app_build_model_h

#include <snug/app/build_loads.h>
#include <snug/base/errors.h>
#include <snug/state/state_solver.h>

namespace snug::app {
/// Return the result of @p make. An InputError of @p make is thrown again with the file of the
/// scene in front, as in all errors of the input.
template <typename Make>
auto with_file_context(const scene::Scene &scene, const Make &make)
{
  try
    {
      return make();
    }
  catch (const InputError &error)
    {
      throw InputError(error.what(), {scene.file}, error.wrong());
    }
}

/// Return the relative tolerance of the states of a search that evaluates @p responses. An error e
/// of the state changes the potential energy, which the state minimizes, by e^2, and other
/// responses by e. Errors of such responses above the tolerance of the optimizer would keep the
/// optimizer from meeting its tolerance.
template <int dim>
double search_tolerance(const scene::Scene &scene, const std::vector<std::string> &responses);

/// Make the coarse cells of all bodies, refined as the scene says. Collective. @throws InputError
/// naming the file.
template <int dim>
std::unique_ptr<mesh::Forest<dim>> build_forest(const scene::Scene &scene, MPI_Comm communicator);

/// Make the mesh of a forest of the scene, which is torn if @p is_torn, see BodyMesh. Collective.
/// @throws InputError naming the file.
template <int dim>
std::unique_ptr<mesh::BodyMesh<dim>>
build_mesh(const scene::Scene &scene, const mesh::Forest<dim> &forest, bool is_torn = true);

/// Make the mesh of the scene. Collective. @throws InputError naming the file.
template <int dim>
std::unique_ptr<mesh::BodyMesh<dim>> build_mesh(const scene::Scene &scene, MPI_Comm communicator);

/// Make the mesh of the scene. The time counts as setup. Collective. @throws InputError naming the
/// file.
template <int dim>
std::unique_ptr<mesh::BodyMesh<dim>> timed_mesh(RunContext &context, const scene::Scene &scene);

/// Return the mesh parameters of all bodies in their order, with the boundaries of which the true
/// surfaces are needed.
std::vector<geometry::BodyMeshParameters> mesh_parameters(const scene::Scene &scene);

/// Return the contact pairs of a scene. @throws InputError for names that do not exist.
template <int dim>
std::vector<contact::Pair> build_pairs(const scene::Scene &scene, const mesh::BodyMesh<dim> &mesh);

/// Return the model of a scene, in which names of bodies and boundaries are replaced by indices.
/// @throws InputError for names that do not exist.
template <int dim>
state::Model<dim> build_model(const scene::Scene &scene, const mesh::BodyMesh<dim> &mesh);
} // namespace snug::app

#endif
