#include <snug/app/build_loads.h>
#include <snug/base/values.h>
#include <snug/geometry/face_list.h>
#include <snug/geometry/formula.h>
#include <snug/geometry/rigid_motion.h>
#include <snug/scene/placed_force.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace snug::app {
namespace {
template <int dim>
using ScalarFunction = std::function<double(const dealii::Point<dim> &)>;
template <int dim>
using VectorFunction = std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &)>;

template <int dim>
dealii::Tensor<1, dim> to_tensor(const std::vector<double> &values)
{
  dealii::Tensor<1, dim> tensor;
  for (unsigned int c = 0; c < dim && c < values.size(); ++c)
    tensor[c] = values[c];
  return tensor;
}

/// Return a formula of the reference position as a function.
template <int dim>
ScalarFunction<dim> function_of(const std::string &entry, const std::string &text)
{
  const auto formula = std::make_shared<geometry::Formula<dim>>(entry, text);
  return [formula](const dealii::Point<dim> &x) { return formula->value(x); };
}

template <int dim>
VectorFunction<dim> function_of(const std::string              &entry,
                                const std::vector<std::string> &components)
{
  std::vector<ScalarFunction<dim>> of_component;
  for (const auto &text : components)
    of_component.push_back(function_of<dim>(entry, text));
  return [of_component](const dealii::Point<dim> &x) {
    dealii::Tensor<1, dim> value;
    for (unsigned int c = 0; c < dim; ++c)
      value[c] = of_component[c](x);
    return value;
  };
}

/// Return a + b, where an empty @p a is zero.
template <typename Function>
Function sum(const Function &a, const Function &b)
{
  if (!a)
    return b;
  return [a, b](const auto &x) { return a(x) + b(x); };
}

/// Return a moment as a resultant. In the plane, a moment has one number: that about the normal
/// axis.
template <int dim>
elasticity::Resultant<dim> resultant_moment(const std::vector<double> &numbers)
{
  elasticity::Resultant<dim> resultant;
  for (unsigned int c = 0; c < numbers.size(); ++c)
    resultant.moment[dim == 2 ? 2 : c] = numbers[c];
  return resultant;
}

/// Throw InputError if a body of revolution has a @p resultant other than a force along its axis.
template <int dim>
void require_axial(const mesh::BodyMesh<dim>        &mesh,
                   const std::string                &entry,
                   const std::string                &face,
                   const elasticity::Resultant<dim> &resultant)
{
  if (mesh.idealization().is_axisymmetric() &&
      (resultant.force[0] != 0. || resultant.moment.norm() > 0.))
    throw bad_entry(entry, face,
                    "a body of revolution can carry a total force along "
                    "its axis y only, and no moment");
}

/// Throw InputError if a boundary lies on the axis of revolution, where no total force can act on
/// it. Collective.
template <int dim>
void require_area(const mesh::BodyMesh<dim>                   &mesh,
                  const std::string                           &entry,
                  const std::string                           &face,
                  const std::pair<unsigned int, unsigned int> &boundary)
{
  if (!mesh.idealization().is_axisymmetric())
    return;
  double radius = 0.;
  for (const auto &of : mesh.boundary_faces())
    if (of.body == boundary.first && of.boundary == boundary.second)
      for (const unsigned int node : of.nodes)
        radius = std::max(radius, mesh.reference_positions()[node][0]);
  if (!(dealii::Utilities::MPI::max(radius, mesh.communicator()) > 0.))
    throw bad_entry(entry, face, "lies on the axis of revolution and has no area");
}

/// This class adds the loads of one section of the scene to a load case.
template <int dim>
class LoadBuilder
{
public:
  /// Set the section for messages, and the @p prefix that completes the keys of loads to
  /// "body.boundary".
  LoadBuilder(const scene::Scene        &scene,
              const mesh::BodyMesh<dim> &mesh,
              const std::string         &section,
              const std::string         &prefix)
    : scene(scene), mesh(mesh), section(section + "/"), prefix(prefix)
  {}

  void add(const scene::LoadParameters &loads, state::LoadCase<dim> &to) const
  {
    for (const auto &item : loads.pressure)
      {
        auto &load    = boundary(item.first, to);
        load.pressure = sum(load.pressure, function_of<dim>(section + "Pressure", item.second));
      }
    for (const auto &item : loads.traction)
      {
        auto &load = boundary(item.first, to);
        load.traction =
          sum(load.traction, function_of<dim>(section + "Traction", components(item.second)));
      }
    for (const auto &item : loads.force)
      add_resultant("Force", item.first, {to_tensor<dim>(item.second), {}}, to);
    for (const auto &item : loads.moment)
      add_resultant("Moment", item.first, resultant_moment<dim>(item.second), to);
    for (const auto &item : loads.point_forces)
      add_placed("Point force", item.first, item.second, to);
    for (const auto &item : loads.line_forces)
      add_placed("Line force", item.first, item.second, to);
  }

private:
  state::BoundaryLoad<dim> &boundary(const std::string &key, state::LoadCase<dim> &to) const
  {
    const auto face = find_face(scene, mesh, prefix + key);
    return to.bodies[face.first].boundaries[face.second];
  }

  void add_resultant(const std::string                &entry,
                     const std::string                &key,
                     const elasticity::Resultant<dim> &resultant,
                     state::LoadCase<dim>             &to) const
  {
    require_axial(mesh, section + entry, key, resultant);
    require_area(mesh, section + entry, key, find_face(scene, mesh, prefix + key));
    auto &load = boundary(key, to);
    load.resultant.force += resultant.force;
    load.resultant.moment += resultant.moment;
  }

  void add_placed(const std::string    &entry,
                  const std::string    &key,
                  const std::string    &text,
                  state::LoadCase<dim> &to) const
  {
    const auto              force = scene::placed_force(text, dim);
    state::PlacedForce<dim> placed;
    placed.force = to_tensor<dim>(force.force);
    placed.entry = {section + entry, key + ": " + text};
    require_axial(mesh, section + entry, key, {placed.force, {}});
    placed.from = dealii::Point<dim>(to_tensor<dim>(force.at.empty() ? force.from : force.at));
    if (!force.to.empty())
      placed.to = dealii::Point<dim>(to_tensor<dim>(force.to));
    if (!force.along.empty())
      {
        const unsigned int body = find_face(scene, mesh, prefix + key).first;
        placed.along            = geometry::boundary_index(mesh.geometry(body), force.along);
      }
    boundary(key, to).concentrated.push_back(placed);
  }

  const scene::Scene        &scene;
  const mesh::BodyMesh<dim> &mesh;
  const std::string          section, prefix;
};

/// Return the loads of bodies and scene that all load cases share.
template <int dim>
state::LoadCase<dim> common_loads(const scene::Scene &scene, const mesh::BodyMesh<dim> &mesh)
{
  state::LoadCase<dim> common;
  common.bodies.resize(scene.bodies.size());
  for (unsigned int b = 0; b < scene.bodies.size(); ++b)
    {
      const auto       &body    = scene.bodies[b];
      const std::string section = "Body " + body.name;
      if (!body.body_force.empty())
        common.bodies[b].body_force = function_of<dim>(section + "/Body force", body.body_force);
      if (!body.temperature.empty())
        common.bodies[b].temperature = function_of<dim>(section + "/Temperature", body.temperature);
      common.bodies[b].gravity = to_tensor<dim>(scene.gravity);
      LoadBuilder<dim>(scene, mesh, section, body.name + ".").add(body.loads, common);
    }
  return common;
}

/// Return the position of bodies and obstacles in a load case.
template <int dim>
contact::Position<dim> position_of(const scene::Scene              &scene,
                                   const scene::LoadCaseParameters &parameters)
{
  contact::Position<dim> position;
  for (const auto &[name, text] : parameters.positions)
    {
      const auto motion = geometry::rigid_motion<dim>(text);
      // Positions are compared, so a body that does not move is not in the list.
      if (motion.is_identity())
        continue;
      if (const unsigned int body = scene::body_index(scene, name); body < scene.bodies.size())
        position.bodies[body] = motion;
      else
        position.obstacles[name] = motion;
    }
  return position;
}

/// Return v with components in the frame of a body that @p motion moves, for @p v in space.
template <int dim>
dealii::Tensor<1, 3> moment_back(const geometry::RigidMotion<dim> &motion,
                                 const dealii::Tensor<1, 3>       &v)
{
  if constexpr (dim == 3)
    return motion.vector_back(v);
  return v; // about z
}

/// Turn the loads of a load case, whose directions are given in space, to the frames of the bodies.
template <int dim>
void turn_loads_back(state::LoadCase<dim> &load_case)
{
  for (const auto &[b, motion] : load_case.position.bodies)
    {
      const auto turn = [motion = motion](VectorFunction<dim> &function) {
        if (function)
          function = [motion, function](const dealii::Point<dim> &x) {
            return motion.vector_back(function(x));
          };
      };
      auto &body = load_case.bodies[b];
      turn(body.body_force);
      body.gravity = motion.vector_back(body.gravity);
      for (auto &[boundary, load] : body.boundaries)
        {
          turn(load.traction);
          load.resultant.force  = motion.vector_back(load.resultant.force);
          load.resultant.moment = moment_back(motion, load.resultant.moment);
          for (auto &placed : load.concentrated)
            placed.force = motion.vector_back(placed.force);
        }
    }
}

/// Return the index of a held component among @p supports. The component is added if it is new.
template <int dim>
unsigned int index_of(const supports::Support<dim>        &wanted,
                      std::vector<supports::Support<dim>> &supports)
{
  for (unsigned int i = 0; i < supports.size(); ++i)
    if (supports[i].body == wanted.body && supports[i].boundary == wanted.boundary &&
        supports[i].component.number == wanted.component.number)
      return i;
  supports.push_back(wanted);
  return supports.size() - 1;
}
} // namespace

template <int dim>
std::pair<unsigned int, unsigned int>
find_face(const scene::Scene &scene, const mesh::BodyMesh<dim> &mesh, const std::string &face)
{
  const auto         names = scene::split_face(face);
  const unsigned int body  = scene::body_index(scene, names.first);
  if (body == scene.bodies.size())
    throw InputError("there is no body '" + names.first + "'");
  return {body, geometry::boundary_index(mesh.geometry(body), names.second)};
}

template <int dim>
contact::Side
find_side(const scene::Scene &scene, const mesh::BodyMesh<dim> &mesh, const std::string &side)
{
  contact::Side result;
  for (const auto &face : geometry::face_list(side))
    result.add(find_face(scene, mesh, face));
  return result;
}

template <int dim>
std::vector<state::LoadCase<dim>> build_load_cases(const scene::Scene        &scene,
                                                   const mesh::BodyMesh<dim> &mesh)
{
  const auto common = common_loads(scene, mesh);
  if (scene.load_cases.empty())
    return {common};
  std::vector<state::LoadCase<dim>> cases;
  for (const auto &of : scene.load_cases)
    {
      cases.push_back(common);
      cases.back().name = of.name;
      for (auto &body : cases.back().bodies)
        body.gravity += to_tensor<dim>(of.gravity);
      for (const auto &[name, formula] : of.temperatures)
        {
          auto &body = cases.back().bodies[scene::body_index(scene, name)];
          body.temperature =
            sum(body.temperature,
                function_of<dim>("Load case " + of.name + "/Temperature", formula));
        }
      LoadBuilder<dim>(scene, mesh, "Load case " + of.name, "")
        .add(scene::loads_on_faces(scene, of.loads), cases.back());
      cases.back().position = position_of<dim>(scene, of);
      if (of.load_step && cases.size() > 1)
        cases.back().after = static_cast<unsigned int>(cases.size()) - 2;
      if (of.loads_in_space)
        turn_loads_back(cases.back());
    }
  return cases;
}

template <int dim>
std::vector<supports::Support<dim>> build_supports(const scene::Scene        &scene,
                                                   const mesh::BodyMesh<dim> &mesh)
{
  const unsigned int                  n_cases = std::max<std::size_t>(1, scene.load_cases.size());
  std::vector<supports::Support<dim>> supports;
  const auto support = [&](const std::string &entry, const std::string &face,
                           unsigned int component) {
    const auto where = find_face(scene, mesh, face);
    return supports::Support<dim>{where.first,
                                  where.second,
                                  build_component<dim>(scene, where.first, component),
                                  std::vector<ScalarFunction<dim>>(n_cases),
                                  "'" + entry + "' of '" + face + "'",
                                  face};
  };
  const auto prescribe = [&](const std::string &section, const std::string &prefix,
                             const scene::LoadParameters &loads, const auto &is_in_case) {
    const std::string entry = section + "/Displacement";
    for (const auto &item : loads.displacements)
      {
        const auto parts = scene::split_displacement(item.second);
        const auto c     = scene::component_number(parts.first, dim);
        auto      &held  = supports[index_of(support(entry, prefix + item.first, c), supports)];
        for (unsigned int load_case = 0; load_case < n_cases; ++load_case)
          if (is_in_case(load_case))
            held.values[load_case] = function_of<dim>(entry, parts.second);
      }
  };
  for (const auto &body : scene.bodies)
    {
      const std::string section = "Body " + body.name;
      for (const auto &item : body.supports)
        for (const unsigned int c : scene::component_list(item.second, dim))
          supports.push_back(support(section + "/Supports", body.name + "." + item.first, c));
      prescribe(section, body.name + ".", body.loads, [](unsigned int) { return true; });
    }
  for (unsigned int i = 0; i < scene.load_cases.size(); ++i)
    prescribe("Load case " + scene.load_cases[i].name, "",
              scene::loads_on_faces(scene, scene.load_cases[i].loads),
              [i](unsigned int load_case) { return load_case == i; });
  return supports;
}

#define SNUG_INSTANTIATE(dim)                                                                 \
  template std::pair<unsigned int, unsigned int> find_face(const scene::Scene &,              \
                                                           const mesh::BodyMesh<dim> &,       \
                                                           const std::string &);              \
  template contact::Side find_side(const scene::Scene &, const mesh::BodyMesh<dim> &,         \
                                   const std::string &);                                      \
  template std::vector<state::LoadCase<dim>>   build_load_cases(const scene::Scene &,         \
                                                                const mesh::BodyMesh<dim> &); \
  template std::vector<supports::Support<dim>> build_supports(const scene::Scene &,           \
                                                              const mesh::BodyMesh<dim> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::app
