#include <snug/app/build_loads.h>
#include <snug/app/build_points.h>
#include <snug/contact/obstacle.h>
#include <snug/geometry/face_list.h>

namespace snug::app {
namespace {
/// Return the load of a bolt in load case @p c: its tension, or the shortening at which it is held
/// or that it keeps from the load case before.
state::PointLoad bolt_load(const scene::Scene       &scene,
                           const scene::Bolt        &bolt,
                           const unsigned int        c,
                           const mesh::Idealization &idealization)
{
  const unsigned int n     = idealization.n_rigid_motions();
  const auto         state = tightening(scene, bolt, c);
  state::PointLoad   load;
  load.wrench.assign(n, 0.);
  load.held.assign(n, 0.);
  load.locked.assign(n, false);
  if (state.preload)
    {
      load.wrench[0] = *state.preload;
      load.held[0].reset();
    }
  else if (state.shortening)
    load.held[0] = *state.shortening;
  else
    load.locked[0] = true;
  return load;
}
} // namespace

template <int dim>
void build_points(const scene::Scene        &scene,
                  const mesh::BodyMesh<dim> &mesh,
                  state::Model<dim>         &model)
{
  for (const auto &of : scene.points)
    {
      state::ReferencePoint<dim> point;
      point.name = of.name;
      if (!of.point.empty())
        point.place = contact::to_point<dim>(of.point);
      for (const auto &face : of.faces)
        point.faces.push_back(find_face(scene, mesh, face));
      point.obstacles = of.obstacles;
      model.points.push_back(point);
      for (unsigned int c = 0; c < model.load_cases.size(); ++c)
        {
          const auto loads = loads_on_point(
            scene, of, scene.load_cases.empty() ? std::nullopt : std::optional<unsigned int>(c));
          model.load_cases[c].points.push_back({loads.wrench, loads.held});
        }
    }
  for (const auto &of : scene.bolts)
    {
      state::ReferencePoint<dim> bolt;
      bolt.name         = of.name;
      const auto [a, b] = of.sides();
      for (const auto &side : {a, b})
        for (const auto &face : geometry::face_list(side))
          bolt.cut.push_back(find_face(scene, mesh, face));
      model.points.push_back(bolt);
      for (unsigned int c = 0; c < model.load_cases.size(); ++c)
        model.load_cases[c].points.push_back(bolt_load(scene, of, c, mesh.idealization()));
    }
}

template void build_points(const scene::Scene &, const mesh::BodyMesh<2> &, state::Model<2> &);
template void build_points(const scene::Scene &, const mesh::BodyMesh<3> &, state::Model<3> &);
} // namespace snug::app
