#include <snug/app/build_loads.h>
#include <snug/base/values.h>
#include <snug/geometry/formula.h>
#include <snug/scene/placed_force.h>

#include <memory>

namespace snug::app {
template <int dim>
supports::Component<dim>
build_component(const scene::Scene &scene, const unsigned int body, const unsigned int number)
{
  const auto &of_body = scene.bodies[body];
  if (number > dim && scene::idealization(scene).is_axisymmetric())
    throw bad_entry("Model", "axisymmetric",
                    "does not allow the radial and tangential components of '" + of_body.name +
                      "'");
  supports::Axis<dim> axis{{}, dealii::Point<dim>::unit_vector(dim - 1)};
  if (!of_body.axis_point.empty())
    axis.point = contact::to_point<dim>(of_body.axis_point);
  if (!of_body.axis.empty())
    axis.direction = contact::to_point<dim>(of_body.axis);
  axis.direction /= axis.direction.norm();
  return {number, axis};
}

template <int dim>
std::vector<supports::Spring<dim>> build_springs(const scene::Scene        &scene,
                                                 const mesh::BodyMesh<dim> &mesh)
{
  using supports::Spring;
  std::vector<Spring<dim>> springs;
  const auto               spring = [&](const std::string &entry, const std::string &body,
                          const std::string &boundary, const std::string &text) {
    const std::string face  = body + "." + boundary;
    const auto        where = find_face(scene, mesh, face);
    return Spring<dim>{where.first, where.second, 0, {}, {}, {entry, boundary + ": " + text}, face};
  };
  for (const auto &body : scene.bodies)
    {
      for (const auto &[boundary, text] : body.springs)
        {
          const std::string entry    = body.section() + "/Springs";
          const auto [name, formula] = scene::split_displacement(text);
          const auto of_position     = std::make_shared<geometry::Formula<dim>>(entry, formula);
          for (const unsigned int c : scene::component_list(name, dim))
            {
              auto next      = spring(entry, body.name, boundary, text);
              next.component = build_component<dim>(scene, next.body, c);
              next.stiffness = [of_position](const dealii::Point<dim> &x) {
                return of_position->value(x);
              };
              springs.push_back(next);
            }
        }
      for (const auto &[boundary, text] : body.point_springs)
        {
          const auto given = scene::placed_force(text, dim);
          for (unsigned int c = 0; c < dim; ++c)
            {
              auto next      = spring(body.section() + "/Point springs", body.name, boundary, text);
              next.component = c;
              next.place     = contact::to_point<dim>(given.at);
              next.stiffness = [k = given.force[c]](const dealii::Point<dim> &) { return k; };
              springs.push_back(next);
            }
        }
    }
  return springs;
}

template <int dim>
std::vector<supports::PointSupport<dim>> build_point_supports(const scene::Scene        &scene,
                                                              const mesh::BodyMesh<dim> &mesh)
{
  std::vector<supports::PointSupport<dim>> supports;
  for (const auto &body : scene.bodies)
    for (const auto &[boundary, text] : body.point_supports)
      {
        const auto        hold  = scene::point_hold(text, dim);
        const std::string face  = body.name + "." + boundary;
        const auto        where = find_face(scene, mesh, face);
        const std::string name =
          "entry '" + body.section() + "/Point supports' = '" + boundary + ": " + text + "'";
        const auto place = contact::to_point<dim>(hold.at);
        for (const unsigned int c : hold.components)
          supports.push_back({where.first, where.second,
                              build_component<dim>(scene, where.first, c), hold.value, place, name,
                              face});
      }
  return supports;
}

template supports::Component<2> build_component(const scene::Scene &, unsigned int, unsigned int);
template supports::Component<3> build_component(const scene::Scene &, unsigned int, unsigned int);
template std::vector<supports::PointSupport<2>> build_point_supports(const scene::Scene &,
                                                                     const mesh::BodyMesh<2> &);
template std::vector<supports::PointSupport<3>> build_point_supports(const scene::Scene &,
                                                                     const mesh::BodyMesh<3> &);
template std::vector<supports::Spring<2>>       build_springs(const scene::Scene &,
                                                              const mesh::BodyMesh<2> &);
template std::vector<supports::Spring<3>>       build_springs(const scene::Scene &,
                                                              const mesh::BodyMesh<3> &);
} // namespace snug::app
