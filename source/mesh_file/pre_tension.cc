#include <snug/geometry/cell_numbering.h>
#include <snug/mesh_file/deck_sets.h>
#include <snug/mesh_file/element_split.h>

#include <algorithm>

namespace snug::mesh_file {
namespace {
using geometry::sorted;
using Corners = std::vector<unsigned int>;
using Nodes   = std::set<unsigned int>;
using Copies  = std::map<unsigned int, unsigned int>; ///< node -> node of its copy

/// Return the cells of the side of a section to which its faces belong, which are given with the
/// numbers of their cells, or nothing if they do not cut one body in two. @p nodes are those of the
/// section.
Corners
side_of(const MeshFile &mesh, const std::map<Corners, unsigned long> &section, const Nodes &nodes)
{
  Corners side;
  bool    is_cut = false;
  for (const auto &body : connected_cells(mesh, nodes))
    {
      std::size_t own = 0, opposite = 0;
      for (const unsigned int e : body.elements)
        for (auto face : faces_of(mesh.elements[e].shape))
          {
            for (auto &corner : face)
              corner = mesh.elements[e].corners[corner];
            if (const auto found = section.find(sorted(face)); found != section.end())
              ++(found->second == mesh.elements[e].number ? own : opposite);
          }
      if (own == section.size() && opposite == 0)
        side = body.elements;
      is_cut = is_cut || (own == 0 && opposite == section.size());
    }
  return is_cut ? side : Corners();
}

/// Return the corners with copies instead of the nodes on a section.
Corners renamed(Corners corners, const Copies &copies)
{
  for (auto &corner : corners)
    if (const auto found = copies.find(corner); found != copies.end())
      corner = found->second;
  return corners;
}

/// Return copies of the nodes of a section, and of those in the middles of its edges and faces.
Copies copy_nodes(MeshFile &mesh, const Nodes &nodes)
{
  Copies     copies;
  const auto copy = [&](const unsigned int node) {
    if (copies.emplace(node, mesh.points.size()).second)
      mesh.points.push_back(dealii::Point<3>(mesh.points[node]));
  };
  std::for_each(nodes.begin(), nodes.end(), copy);
  std::map<Corners, unsigned int> middles;
  for (const auto &[corners, node] : mesh.middles)
    if (renamed(corners, copies) != corners)
      middles[corners] = node;
  for (const auto &[corners, node] : middles)
    {
      if (std::all_of(corners.begin(), corners.end(),
                      [&](const auto corner) { return nodes.count(corner) > 0; }))
        copy(node);
      mesh.middles[sorted(renamed(corners, copies))] = renamed({node}, copies)[0];
    }
  return copies;
}

/// Cut the mesh at the faces of the surface @p name.
void cut(const Keyword &keyword, const std::string &name, DeckSets &sets, MeshFile &mesh)
{
  std::map<Corners, unsigned long> section;
  Nodes                            nodes, of_side;
  for (const auto &face : mesh.elements)
    if (std::count(face.groups.begin(), face.groups.end(), name) > 0)
      {
        section[sorted(face.corners)] = face.number;
        nodes.insert(face.corners.begin(), face.corners.end());
      }
  const auto side = side_of(mesh, section, nodes);
  if (side.empty())
    throw keyword_error(keyword, "surface '" + name + "' of " + keyword.title +
                                   " does not cut one body in two pieces; without the keyword the "
                                   "body stays whole");
  const auto copies = copy_nodes(mesh, nodes);
  for (const unsigned int cell : side)
    for (auto &corner : mesh.elements[cell].corners)
      {
        of_side.insert(corner);
        corner = renamed({corner}, copies)[0];
      }
  const auto rename = [&](MeshFile::Element &face) {
    const bool is_cut = section.count(sorted(face.corners)) > 0;
    if (is_cut && face.groups != std::vector<std::string>{name})
      face.groups.clear();
    else if (is_cut || std::any_of(face.corners.begin(), face.corners.end(), [&](const auto node) {
               return of_side.count(node) > nodes.count(node);
             }))
      face.corners = renamed(face.corners, copies);
  };
  for (auto &element : mesh.elements)
    if (n_corners(element.shape) > 1)
      rename(element);
  for (auto &boundary : mesh.optional_boundaries)
    std::for_each(boundary.second.faces.begin(), boundary.second.faces.end(), rename);
  for (const auto &[face, number] : section)
    {
      mesh.optional_boundaries[name + " opposite"].faces.push_back(
        {face_shape(face), face, {}, number, keyword.line});
      sets.cut_faces.insert({face, sorted(renamed(face, copies))});
    }
  for (const auto &[node, copy] : copies)
    {
      sets.copies.insert(copy);
      for (auto &set : sets.of_nodes)
        if (set.second.count(node) > 0)
          set.second.insert(copy);
      for (auto &boundary : mesh.optional_boundaries)
        if (boundary.second.nodes.count(node) > 0)
          boundary.second.nodes.insert(copy);
    }
}
} // namespace

void cut_at_sections(const DeckText &deck, DeckSets &sets, MeshFile &mesh)
{
  for (const auto &keyword : deck.keywords())
    if (keyword.name == "PRE-TENSIONSECTION" && !keyword.has("ELEMENT"))
      {
        const auto word  = keyword.option("SURFACE");
        const auto found = sets.spelling.find(upper_case(word));
        if (found == sets.spelling.end() || sets.surfaces.count(found->second) == 0)
          throw keyword_error(keyword, "there is no surface '" + word + "' of faces");
        cut(keyword, found->second, sets, mesh);
      }
}
} // namespace snug::mesh_file
