#include <snug/scene/check.h>

#include <algorithm>
#include <set>
#include <stdexcept>

namespace snug::scene {
void ReferencePoint::declare(Entries &entries)
{
  const std::string components = "x, y, z for translations, rx, ry, rz for rotations about the "
                                 "axes; x, y, rz in 2D, y in axisymmetric models";
  entries.add("Point", point, per_dimension(),
              "The reference point, which a design does not move. Units: length. An empty list "
              "means the origin.");
  entries.add("Faces", faces, allowed("a list 'body.boundary, ...' of different boundaries"),
              "The faces that follow the point as rigid faces.");
  entries.add("Obstacles", obstacles, allowed("names of obstacles separated by commas"),
              "The obstacles that follow the point. Contacts keep the normals at their initial "
              "position.");
  entries.add("Supports", supports, allowed("components separated by commas"),
              "The components of the motion of the point that are held in all load cases: " +
                components + ".");
  entries.add("Displacement", displacements, allowed("a list 'component = number, ...'"),
              "The components of the motion that are prescribed in all load cases: 'z = -0.1, rx = "
              "0.002'. Units: length, rad.");
  entries.add("Force", force, per_dimension(),
              "The force at the point. Units: force. An empty list means no force.");
  entries.add("Moment", moment, allowed("3 numbers separated by commas, in 2D one number"),
              "The moment. Units: force length. An empty list means no moment.");
}

std::vector<std::string> motion_names(const Scene &scene)
{
  if (scene.model == mesh::Idealization::Kind::axisymmetric)
    return {"y"};
  if (scene.dimension == 2)
    return {"x", "y", "rz"};
  return {"x", "y", "z", "rx", "ry", "rz"};
}

namespace {
bool is_point(const Scene &scene, const std::string &name)
{
  return std::any_of(scene.points.begin(), scene.points.end(),
                     [&](const auto &point) { return point.name == name; });
}

/// Return the items of a list or map whose keys are, or are not, names of reference points.
template <typename List>
List filtered(const Scene &scene, const List &list, const bool of_points)
{
  List result;
  std::copy_if(list.begin(), list.end(), std::inserter(result, result.end()),
               [&](const auto &item) { return is_point(scene, item.first) == of_points; });
  return result;
}

/// Return the place of a component in motion_names().
unsigned int place_of(const std::vector<std::string> &names, const std::string &component)
{
  return static_cast<unsigned int>(std::find(names.begin(), names.end(), component) -
                                   names.begin());
}

/// Add force and moment to the wrench. Sections of revolution have the force along the axis alone.
void add_wrench(const Scene               &scene,
                const std::vector<double> &force,
                const std::vector<double> &moment,
                std::vector<double>       &wrench)
{
  const bool is_section = wrench.size() == 1;
  for (unsigned int c = 0; c < force.size(); ++c)
    if (!is_section || c == 1)
      wrench[is_section ? 0 : c] += force[c];
  for (unsigned int c = 0; c < moment.size(); ++c)
    wrench[scene.dimension + c] += moment[c];
}

/// This class checks one reference point and its loads.
class PointCheck
{
public:
  PointCheck(const Scene &scene, const Origins &origins, const ReferencePoint &point)
    : scene(scene), origins(origins), point(point), names(motion_names(scene))
  {}

  void check(std::set<std::string> &following)
  {
    const SectionCheck own(point.section(), origins, scene.dimension);
    const auto         bodies = names_of(scene.bodies), obstacles = names_of(scene.obstacles);
    if (std::count(bodies.begin(), bodies.end(), point.name) +
          std::count(obstacles.begin(), obstacles.end(), point.name) >
        0)
      throw origins.error("Reference points", to_text(names_of(scene.points)),
                          "'" + point.name + "' is the name of a body or an obstacle");
    own.require(!point.faces.empty() || !point.obstacles.empty(), "Faces", "",
                "must name at least one face unless 'Obstacles' names an obstacle");
    for (const auto &face : point.faces)
      {
        require_face(scene, own, "Faces", to_text(point.faces), face);
        require_free(own, face);
      }
    for (const auto &name : point.obstacles)
      {
        const auto known = names_of(scene.obstacles);
        const auto found = std::find(known.begin(), known.end(), name);
        own.require(found != known.end(), "Obstacles", to_text(point.obstacles),
                    "there is no obstacle '" + quotable(name) + "'", suggestion(name, known));
        const auto &moved = scene.obstacles[found - known.begin()].displacement;
        SectionCheck("Obstacle " + name, origins, scene.dimension)
          .require(std::all_of(moved.begin(), moved.end(), [](double u) { return u == 0.; }),
                   "Displacement", to_text(moved),
                   "must be left out, because the obstacle follows '" + point.name + "'");
      }
    for (const auto *list : {&point.faces, &point.obstacles})
      for (const auto &name : *list)
        own.require(following.insert(name).second, list == &point.faces ? "Faces" : "Obstacles",
                    to_text(*list), "'" + name + "' must follow one point only, and only once");
    std::set<std::string> held;
    for (const auto &component : point.supports)
      hold(own, "Supports", to_text(point.supports), component, held);
    for (const auto &text : point.displacements)
      prescribe(own, to_text(point.displacements), text, held);
    check_wrench(own, point.force, "Force", to_text(point.force));
    check_wrench(own, point.moment, "Moment", to_text(point.moment));
    for (const auto &load_case : scene.load_cases)
      check_case(load_case, held);
  }

private:
  /// Throw if supports or prescribed displacements hold a face that follows the point.
  void require_free(const SectionCheck &own, const std::string &face) const
  {
    const auto [name, boundary] = split_face(face);
    const auto &body            = scene.bodies[body_index(scene, name)];
    const auto  names_boundary  = [&b = boundary](const auto &item) { return item.first == b; };
    bool        is_held =
      body.supports.count(boundary) > 0 ||
      std::any_of(body.loads.displacements.begin(), body.loads.displacements.end(), names_boundary);
    for (const auto &load_case : scene.load_cases)
      for (const auto &item : load_case.loads.displacements)
        is_held = is_held || item.first == face;
    own.require(!is_held, "Faces", to_text(point.faces),
                "'" + face + "' is held by supports; the reference point must be held instead");
  }

  void hold(const SectionCheck    &section,
            const std::string     &entry,
            const std::string     &value,
            const std::string     &component,
            std::set<std::string> &held) const
  {
    section.require(place_of(names, component) < names.size(), entry, value,
                    "'" + quotable(component) + "' is not a component of the motion of '" +
                      point.name + "'; components are " + to_text(names));
    section.require(held.insert(component).second, entry, value,
                    "'" + component + "' of '" + point.name + "' is held twice");
  }

  void prescribe(const SectionCheck    &section,
                 const std::string     &value,
                 const std::string     &text,
                 std::set<std::string> &held) const
  {
    const auto [component, number] = split_displacement(text);
    hold(section, "Displacement", value, component, held);
    double u = 0.;
    try
      {
        from_text(number, u);
      }
    catch (const std::invalid_argument &)
      {
        section.require(false, "Displacement", value,
                        "'" + quotable(text) + "' must read 'component = number'");
      }
  }

  void check_wrench(const SectionCheck        &section,
                    const std::vector<double> &of,
                    const std::string         &entry,
                    const std::string         &value) const
  {
    if (of.empty())
      return;
    const bool is_moment = entry == "Moment";
    const auto n         = is_moment && scene.dimension == 2 ? 1 : scene.dimension;
    section.require(of.size() == n, entry, value,
                    "the vector of '" + point.name + "' must have " + to_text(n) +
                      (n == 1 ? " number" : " components"));
    section.require(names.size() > 1 || (!is_moment && of[0] == 0.), entry, value,
                    "must be a force along y, because the model is axisymmetric");
  }

  void check_case(const LoadCaseParameters &load_case, std::set<std::string> held) const
  {
    const SectionCheck section(load_case.section(), origins, scene.dimension);
    const auto        &loads = load_case.loads;
    for (const auto &[name, text] : loads.displacements)
      if (name == point.name)
        prescribe(section, to_text(loads.displacements), text, held);
    if (const auto found = loads.force.find(point.name); found != loads.force.end())
      check_wrench(section, found->second, "Force", to_text(loads.force));
    if (const auto found = loads.moment.find(point.name); found != loads.moment.end())
      check_wrench(section, found->second, "Moment", to_text(loads.moment));
    for (const auto &[name, motion] : load_case.positions)
      {
        bool follows =
          std::find(point.obstacles.begin(), point.obstacles.end(), name) != point.obstacles.end();
        for (const auto &face : point.faces)
          follows = follows || split_face(face).first == name;
        for (const auto &pair : scene.contact.pairs)
          if (std::find(point.obstacles.begin(), point.obstacles.end(), pair.master) !=
              point.obstacles.end())
            follows = follows || split_face(pair.slave).first == name;
        section.require(!follows, "Position", to_text(load_case.positions, ';'),
                        "must not move '" + name +
                          "', which follows or touches the reference point '" + point.name + "'");
      }
  }

  const Scene                   &scene;
  const Origins                 &origins;
  const ReferencePoint          &point;
  const std::vector<std::string> names;
};

/// Throw if both sides of a pair follow reference points.
void check_pairs(const Scene &scene, const Origins &origins, const std::set<std::string> &following)
{
  const auto follows = [&](const std::string &side) {
    const auto faces = geometry::face_list(side);
    return std::any_of(faces.begin(), faces.end(),
                       [&](const auto &face) { return following.count(face) > 0; });
  };
  const auto is_fixed = [&](const std::string &side) {
    const auto known = names_of(scene.obstacles);
    return std::find(known.begin(), known.end(), side) != known.end();
  };
  TextPairs pairs;
  for (const auto &pair : scene.contact.pairs)
    {
      pairs.emplace_back(pair.slave, pair.master);
      SectionCheck(pair.section(), origins, scene.dimension)
        .require(pair.parameters.slave != contact::Slave::first || !follows(pair.slave), "Slave",
                 to_text(pair.parameters.slave),
                 "must be finer, because '" + pair.slave + "' follows a reference point");
    }
  for (const auto &[slave, master] : pairs)
    SectionCheck("Contact", origins, scene.dimension)
      .require(!follows(slave) || !(follows(master) || is_fixed(master)), "Pairs", to_text(pairs),
               "both sides of '" + slave + ": " + master +
                 "' are rigid, because the faces follow reference points");
}
} // namespace

LoadParameters loads_on_faces(const Scene &scene, const LoadParameters &loads)
{
  LoadParameters result = loads;
  result.force          = filtered(scene, loads.force, false);
  result.moment         = filtered(scene, loads.moment, false);
  result.displacements  = filtered(scene, loads.displacements, false);
  return result;
}

PointLoads loads_on_point(const Scene                      &scene,
                          const ReferencePoint             &point,
                          const std::optional<unsigned int> load_case)
{
  const auto names = motion_names(scene);
  PointLoads result{std::vector<double>(names.size(), 0.),
                    std::vector<std::optional<double>>(names.size())};
  const auto prescribe = [&](const std::string &text) {
    const auto [component, number] = split_displacement(text);
    double u                       = 0.;
    from_text(number, u);
    result.held[place_of(names, component)] = u;
  };
  for (const auto &component : point.supports)
    result.held[place_of(names, component)] = 0.;
  for (const auto &text : point.displacements)
    prescribe(text);
  add_wrench(scene, point.force, point.moment, result.wrench);
  if (!load_case)
    return result;
  const auto &loads = scene.load_cases[*load_case].loads;
  for (const auto &[name, text] : loads.displacements)
    if (name == point.name)
      prescribe(text);
  const auto numbers = [&](const auto &map) {
    const auto found = map.find(point.name);
    return found == map.end() ? std::vector<double>() : found->second;
  };
  add_wrench(scene, numbers(loads.force), numbers(loads.moment), result.wrench);
  return result;
}

void check_points(const Scene &scene, const Origins &origins)
{
  std::set<std::string> following;
  for (const auto &point : scene.points)
    PointCheck(scene, origins, point).check(following);
  if (!scene.points.empty())
    check_pairs(scene, origins, following);
}
} // namespace snug::scene
