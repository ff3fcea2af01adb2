#ifndef snug_app_build_model_h
#define snug_app_build_model_h

#include <snug/app/build_loads.h>
#include <snug/state/state_solver.h>

namespace snug
{
  namespace app
  {
    /// Mesh entries of all bodies, in their order.
    std::vector<mesh::BodyMeshParameters>
    mesh_parameters(const scene::Scene &scene);

    /// The state problem of a scene: names of bodies and boundaries become
    /// indices. @throws InputError for names that do not exist.
    template <int dim>
    state::Model<dim>
    build_model(const scene::Scene &scene, const mesh::BodyMesh<dim> &mesh);
  } // namespace app
} // namespace snug

#endif
