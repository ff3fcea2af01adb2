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
  is_cell_node.resize(mesh.points.size());
  const auto connected = mesh_file::connected_cells(mesh);
  for (const auto &cells : connected)
    add_body(cells, connected.size() == 1);
  for (const auto &element : mesh.elements)
    if (mesh_file::dimension(element.shape) + 1 == dim)
      for (const auto &group : element.groups)
        faces_of_set[group].push_back(sorted(element.corners));
}

void DeckBodies::add_body(const mesh_file::ConnectedCells &cells, const bool is_only_one)
{
  Body body;
  body.name     = body_name(cells.group);
  body.group    = is_only_one ? "" : cells.group;
  body.elements = cells.elements;
  for (const auto &other : bodies)
    if (other.name == body.name)
      body.name += "-" + std::to_string(bodies.size() + 1);
  std::vector<mesh_file::MeshFile::Element> elements;
  for (const unsigned int e : cells.elements)
    elements.push_back(mesh.elements[e]);
  body.outer = mesh_file::outer_faces(elements);
  for (unsigned int face = 0; face < body.outer.size(); ++face)
    {
      body.index_of.emplace(sorted(body.outer[face]), face);
      for (const unsigned int node : nodes_of(body.outer[face]))
        body.face_at.emplace(node, face);
    }
  // All edges of a cell join two of its corners.
  for (const auto &element : elements)
    for (const unsigned int node : nodes_of(element.corners))
      is_cell_node[node] = true;
  bodies.push_back(std::move(body));
}

std::vector<unsigned int> DeckBodies::nodes_of(const Corners &face) const
{
  std::vector<unsigned int> nodes = face;
  const auto                add   = [&](const Corners &corners) {
    const auto middle = mesh.middles.find(corners);
    if (middle != mesh.middles.end())
      nodes.push_back(middle->second);
  };
  for (std::size_t i = 0; i < face.size() && !mesh.middles.empty(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      add(sorted(Corners{face[i], face[j]}));
  if (face.size() == 4)
    add(sorted(face));
  return nodes;
}

std::set<unsigned int> DeckBodies::faces_on(const unsigned int b, const std::string &set) const
{
  const Body            &body = bodies[b];
  std::set<unsigned int> result;
  const auto             add = [&](const Corners &corners) {
    const auto found = body.index_of.find(corners);
    if (found != body.index_of.end())
      result.insert(found->second);
  };
  if (set.empty())
    for (unsigned int face = 0; face < body.outer.size(); ++face)
      result.insert(face);
  const auto faces = faces_of_set.find(set);
  if (faces != faces_of_set.end())
    for (const auto &corners : faces->second)
      add(corners);
  const auto optional = mesh.optional_boundaries.find(set);
  if (optional == mesh.optional_boundaries.end())
    return result;
  for (const auto &face : optional->second.faces)
    add(sorted(face.corners));
  for (unsigned int face = 0; face < body.outer.size(); ++face)
    if (optional->second.has_face(mesh, body.outer[face]))
      result.insert(face);
  return result;
}

std::vector<DeckBodies::Corners> DeckBodies::faces_of(const std::string &set) const
{
  std::vector<Corners> result;
  for (unsigned int b = 0; b < bodies.size(); ++b)
    for (const unsigned int face : faces_on(b, set))
      result.push_back(bodies[b].outer[face]);
  return result;
}

std::vector<DeckBodies::Corners> DeckBodies::other_faces_of(const std::string &set) const
{
  std::vector<Corners> result;
  const auto           found = faces_of_set.find(set);
  if (found != faces_of_set.end())
    for (const auto &corners : found->second)
      if (std::none_of(bodies.begin(), bodies.end(),
                       [&](const Body &body) { return body.index_of.count(corners) > 0; }))
        result.push_back(corners);
  return result;
}

bool DeckBodies::have_same_faces(const std::string &set, const std::string &other) const
{
  for (unsigned int b = 0; b < bodies.size(); ++b)
    if (faces_on(b, set) != faces_on(b, other))
      return false;
  return true;
}

bool DeckBodies::have_common_faces(const std::string &set, const std::string &other) const
{
  for (unsigned int b = 0; b < bodies.size(); ++b)
    {
      const auto faces = faces_on(b, set);
      for (const unsigned int face : faces_on(b, other))
        if (faces.count(face) > 0)
          return true;
    }
  return false;
}

bool DeckBodies::use(const std::string &set)
{
  if (!used.insert(set).second)
    return !bodies_of(set).empty();
  // A surface whose nodes are a node set of the same name comes first, because its name is shorter.
  const std::string suffix = " nodes";
  const std::size_t length = set.size() - std::min(set.size(), suffix.size());
  if (set.substr(length) == suffix && have_same_faces(set, set.substr(0, length)))
    use(set.substr(0, length));
  for (unsigned int b = 0; b < bodies.size(); ++b)
    {
      Body      &body  = bodies[b];
      const auto faces = faces_on(b, set);
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
  // Faces of a body without 'Boundary sets' have the names of their groups.
  if (body.sets.empty())
    for (const auto &[set, faces] : faces_of_set)
      if (std::count(faces.begin(), faces.end(), sorted(body.outer[face])) > 0)
        return set;
  for (unsigned int s = 0; s < body.sets.size(); ++s)
    if (body.faces[s].count(face) > 0)
      name += (name.empty() ? "" : " and ") + boundary_name(b, body.sets[s]);
  return name.empty() ? "free" : name;
}

std::vector<std::string> DeckBodies::boundaries(const unsigned int            b,
                                                const std::set<unsigned int> &faces) const
{
  std::set<std::string> names;
  for (const unsigned int face : faces)
    names.insert(face_name(b, face));
  return {names.begin(), names.end()};
}

std::optional<std::string> DeckBodies::boundary_at(const unsigned int b,
                                                   const unsigned int node) const
{
  const Body &body  = bodies[b];
  const auto  found = body.face_at.find(node);
  if (found == body.face_at.end())
    return {};
  return face_name(b, found->second);
}

std::optional<unsigned int> DeckBodies::body_at(const unsigned int node) const
{
  for (unsigned int b = 0; b < bodies.size(); ++b)
    if (bodies[b].face_at.count(node) > 0)
      return b;
  return {};
}

std::vector<double> DeckBodies::position(const unsigned int node) const
{
  std::vector<double> result;
  for (unsigned int d = 0; d < dim; ++d)
    result.push_back(mesh.points[node][d]);
  return result;
}

std::set<unsigned int> DeckBodies::nodes_without_face(const std::string &set) const
{
  const auto optional = mesh.optional_boundaries.find(set);
  if (optional == mesh.optional_boundaries.end())
    return {};
  std::set<unsigned int> left;
  for (const unsigned int node : optional->second.nodes)
    if (is_cell_node[node])
      left.insert(node);
  for (const auto &face : faces_of(set))
    for (const unsigned int node : nodes_of(face))
      left.erase(node);
  for (unsigned int b = 0; b < bodies.size(); ++b)
    if (faces_on(b, set).size() == bodies[b].outer.size())
      for (const unsigned int e : bodies[b].elements)
        for (const unsigned int node : nodes_of(corners_of(e)))
          left.erase(node);
  return left;
}
} // namespace snug::deck
