#ifndef snug_app_build_points_h
#define snug_app_build_points_h

#include <snug/scene/scene.h>
#include <snug/state/model.h>

namespace snug::app {
/// Add the reference points of the scene, with their loads in all load cases of @p model.
template <int dim>
void build_points(const scene::Scene        &scene,
                  const mesh::BodyMesh<dim> &mesh,
                  state::Model<dim>         &model);
} // namespace snug::app

#endif
