#ifndef snug_app_build_loads_h
#define snug_app_build_loads_h

#include <snug/scene/scene.h>
#include <snug/state/model.h>

namespace snug::app {
/// Return the load cases of a scene. Each load case has the loads of the bodies and of the scene,
/// to which its own loads are added. A scene without load cases has one load case without a name.
/// @throws InputError for names that do not exist, and for resultants that a body of revolution
///   cannot have.
template <int dim>
std::vector<state::LoadCase<dim>> build_load_cases(const scene::Scene        &scene,
                                                   const mesh::BodyMesh<dim> &mesh);

/// Return component @p number of a body.
/// @throws InputError for components about an axis in axisymmetric models.
template <int dim>
supports::Component<dim>
build_component(const scene::Scene &scene, unsigned int body, unsigned int number);

/// Return the conditions that hold the bodies: supports, and the displacements that bodies and
/// load cases prescribe.
template <int dim>
std::vector<supports::Support<dim>> build_supports(const scene::Scene        &scene,
                                                   const mesh::BodyMesh<dim> &mesh);

/// Return the supports of single nodes.
template <int dim>
std::vector<supports::PointSupport<dim>> build_point_supports(const scene::Scene        &scene,
                                                              const mesh::BodyMesh<dim> &mesh);

/// Return the springs between the bodies and the ground.
template <int dim>
std::vector<supports::Spring<dim>> build_springs(const scene::Scene        &scene,
                                                 const mesh::BodyMesh<dim> &mesh);

/// Return the indices (body, boundary) of "body.boundary". @throws InputError for names that do not
/// exist.
template <int dim>
std::pair<unsigned int, unsigned int>
find_face(const scene::Scene &scene, const mesh::BodyMesh<dim> &mesh, const std::string &face);

/// Return the boundaries of "body.boundary + body.boundary + ...". @throws InputError for names
/// that do not exist.
template <int dim>
contact::Side
find_side(const scene::Scene &scene, const mesh::BodyMesh<dim> &mesh, const std::string &side);
} // namespace snug::app

#endif
