#include <snug/app/build_loads.h>
#include <snug/app/build_points.h>
#include <snug/contact/obstacle.h>

namespace snug::app {
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
}

template void build_points(const scene::Scene &, const mesh::BodyMesh<2> &, state::Model<2> &);
template void build_points(const scene::Scene &, const mesh::BodyMesh<3> &, state::Model<3> &);
} // namespace snug::app
