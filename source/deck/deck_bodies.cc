#include <snug/deck/deck_bodies.h>
#include <snug/geometry/cell_numbering.h>
#include <snug/mesh_file/element_split.h>

#include <algorithm>
#include <cctype>

namespace snug::deck {
using geometry::sorted;

namespace {
/// Return @p group as a name of a body: letters, digits, - and _.
std::string body_name(const std::string &group)
{
  std::string name = group.empty() ? "body" : group;
  for (char &c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_')
      c = '-';
  return name;
}
} // namespace

DeckBodies::DeckBodies(const mesh_file::DeckMesh &deck) : mesh(deck.mesh)
{
  for (const auto &element : mesh.elements)
    dim = std::max(dim, mesh_file::dimension(element.shape));
  const auto connected = mesh_file::connected_cells(mesh);
  for (const auto &cells : connected)
    {
      Body body;
      body.name     = body_name(cells.group);
      body.group    = connected.size() == 1 ? "" : cells.group;
      body.elements = cells.elements;
      for (const auto &other : bodies)
        if (other.name == body.name)
          body.name += "-" + std::to_string(bodies.size() + 1);
      std::vector<mesh_file::MeshFile::Element> elements;
      for (const unsigned int e : cells.elements)
        elements.push_back(mesh.elements[e]);
      for (const auto &face : mesh_file::outer_faces(elements))
        body.outer.emplace(sorted(face), body.outer.size());
      bodies.push_back(std::move(body));
    }
  for (const auto &element : mesh.elements)
    if (mesh_file::dimension(element.shape) + 1 == dim)
      for (const auto &group : element.groups)
        faces_of_set[group].push_back(sorted(element.corners));
}

/// Return the outer faces of a body that belong to the set.
std::set<unsigned int> DeckBodies::faces_on(const Body &body, const std::string &set) const
{
  std::set<unsigned int> result;
  const auto             add = [&](const std::vector<unsigned int> &corners) {
    const auto found = body.outer.find(corners);
    if (found != body.outer.end())
      result.insert(found->second);
  };
  const auto faces = faces_of_set.find(set);
  if (faces != faces_of_set.end())
    for (const auto &corners : faces->second)
      add(corners);
  const auto optional = mesh.optional_boundaries.find(set);
  if (optional == mesh.optional_boundaries.end())
    return result;
  for (const auto &face : optional->second.faces)
    add(sorted(face.corners));
  for (const auto &[corners, face] : body.outer)
    if (optional->second.has_corners(corners))
      result.insert(face);
  return result;
}

bool DeckBodies::use(const std::string &set)
{
  // A surface whose nodes are a node set of the same name comes first, because its name is shorter.
  const std::string suffix = " nodes";
  const std::size_t length = set.size() - std::min(set.size(), suffix.size());
  if (set.substr(length) == suffix && std::all_of(bodies.begin(), bodies.end(), [&](auto &body) {
        return faces_on(body, set) == faces_on(body, set.substr(0, length));
      }))
    use(set.substr(0, length));
  if (used.insert(set).second)
    for (auto &body : bodies)
      {
        const auto faces = faces_on(body, set);
        if (faces.empty())
          continue;
        const auto same = std::find(body.faces.begin(), body.faces.end(), faces);
        if (same != body.faces.end())
          body.alias[set] = body.sets[same - body.faces.begin()];
        else
          {
            body.alias[set] = set;
            body.sets.push_back(set);
            body.faces.push_back(faces);
          }
      }
  return !bodies_of(set).empty();
}

std::vector<unsigned int> DeckBodies::bodies_of(const std::string &set) const
{
  std::vector<unsigned int> result;
  for (unsigned int b = 0; b < bodies.size(); ++b)
    if (bodies[b].alias.count(set) > 0)
      result.push_back(b);
  return result;
}

std::string DeckBodies::boundary_name(const unsigned int b, const std::string &set) const
{
  const auto       &sets   = bodies[b].sets;
  const std::string prefix = bodies[b].name + ".";
  if (set.rfind(prefix, 0) != 0)
    return set;
  const std::string name = set.substr(prefix.size());
  return std::find(sets.begin(), sets.end(), name) == sets.end() ? name : set;
}

/// Return the name of the boundary that an outer face of a body belongs to.
std::string DeckBodies::face_name(const unsigned int b, const unsigned int face) const
{
  const Body &body = bodies[b];
  std::string name;
  for (unsigned int s = 0; s < body.sets.size(); ++s)
    if (body.faces[s].count(face) > 0)
      name += (name.empty() ? "" : " and ") + boundary_name(b, body.sets[s]);
  return name.empty() ? "free" : name;
}

std::vector<std::string> DeckBodies::boundaries(const unsigned int b, const std::string &set) const
{
  const Body &body  = bodies[b];
  const auto  alias = body.alias.find(set);
  if (alias == body.alias.end())
    return {};
  const auto own = std::find(body.sets.begin(), body.sets.end(), alias->second) - body.sets.begin();
  std::vector<std::string> result;
  for (const unsigned int face : body.faces[own])
    {
      const auto name = face_name(b, face);
      if (std::find(result.begin(), result.end(), name) == result.end())
        result.push_back(name);
    }
  std::sort(result.begin(), result.end());
  return result;
}

std::optional<std::string> DeckBodies::boundary_at(const unsigned int b,
                                                   const unsigned int node) const
{
  std::vector<unsigned int> around = {node}; // or the corners in whose middle the node lies
  for (const auto &[corners, middle] : mesh.middles)
    if (middle == node)
      around = corners;
  for (const auto &[corners, face] : bodies[b].outer)
    if (std::includes(corners.begin(), corners.end(), around.begin(), around.end()))
      {
        // Faces of a body without 'Boundary sets' have the names of their groups.
        for (const auto &[set, faces] : faces_of_set)
          if (bodies[b].sets.empty() && std::count(faces.begin(), faces.end(), corners) > 0)
            return set;
        return face_name(b, face);
      }
  return {};
}

std::vector<double> DeckBodies::position(const unsigned int node) const
{
  std::vector<double> result;
  for (unsigned int d = 0; d < dim; ++d)
    result.push_back(mesh.points[node][d]);
  return result;
}

bool DeckBodies::is_second_order() const
{
  return std::all_of(mesh.elements.begin(), mesh.elements.end(), [&](const auto &element) {
    return mesh_file::dimension(element.shape) < dim ||
           mesh.middles.count(sorted({element.corners[0], element.corners[1]})) > 0;
  });
}

unsigned int DeckBodies::nodes_without_face(const std::string &set) const
{
  const auto optional = mesh.optional_boundaries.find(set);
  if (optional == mesh.optional_boundaries.end())
    return 0;
  std::set<unsigned int> left = optional->second.nodes, cell_nodes;
  for (const auto &body : bodies)
    {
      const auto faces = faces_on(body, set);
      for (const auto &[corners, face] : body.outer)
        if (faces.count(face) > 0)
          for (const unsigned int corner : corners)
            left.erase(corner);
      for (const unsigned int e : body.elements)
        cell_nodes.insert(mesh.elements[e].corners.begin(), mesh.elements[e].corners.end());
    }
  // Middle nodes of quadratic elements follow their corners.
  return std::count_if(left.begin(), left.end(),
                       [&](const unsigned int node) { return cell_nodes.count(node) > 0; });
}
} // namespace snug::deck
