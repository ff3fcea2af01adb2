#include <snug/geometry/cell_numbering.h>
#include <snug/mesh_file/deck_sets.h>
#include <snug/mesh_file/element_split.h>

#include <algorithm>

namespace snug::mesh_file {
namespace {
using geometry::sorted;
using Corners = std::vector<unsigned int>;
using Cells   = std::set<unsigned int>;

/// This class cuts a mesh at sections.
class Cutter
{
public:
  Cutter(DeckSets &sets, MeshFile &mesh) : sets(sets), mesh(mesh)
  {
    for (const auto &element : mesh.elements)
      dim = std::max(dim, dimension(element.shape));
    for (unsigned int e = 0; e < mesh.elements.size(); ++e)
      if (dimension(mesh.elements[e].shape) == dim)
        for (const auto &face : faces(e))
          cells_at[face].insert(e);
  }

  /// Cut the mesh at the faces of the surface @p name.
  void cut(const Keyword &keyword, const std::string &name)
  {
    std::set<Corners> faces_there;
    Cells             side; // the cells that are connected with those of the surface
    for (const auto &face : mesh.elements)
      if (std::count(face.groups.begin(), face.groups.end(), name) > 0)
        for (const unsigned int cell : cells_at[*faces_there.insert(sorted(face.corners)).first])
          if (mesh.elements[cell].number == face.number)
            side.insert(cell);
    std::vector<unsigned int> next(side.begin(), side.end());
    while (!next.empty())
      {
        const unsigned int cell = next.back();
        next.pop_back();
        for (const auto &face : faces(cell))
          for (const unsigned int other : cells_at[face])
            if (faces_there.count(face) == 0 && side.insert(other).second)
              next.push_back(other);
      }
    const auto is_cut = [&](const Corners &face) {
      const auto &cells = cells_at[face];
      return cells.size() == 2 && side.count(*cells.begin()) + side.count(*cells.rbegin()) == 1;
    };
    if (faces_there.empty() || !std::all_of(faces_there.begin(), faces_there.end(), is_cut))
      throw keyword_error(keyword, "surface '" + name + "' of " + keyword.title +
                                     " does not cut a body in two pieces; without the keyword the "
                                     "body stays whole");
    for (const auto &face : faces_there)
      mesh.optional_boundaries[name + " opposite"].faces.push_back(
        {face_shape(face), face, {}, 0, 0});
    copy_nodes(faces_there);
    separate(name, side, faces_there);
  }

private:
  DeckSets                &sets;
  MeshFile                &mesh;
  unsigned int             dim = 0;
  std::map<Corners, Cells> cells_at; ///< sorted corners of a face -> its cells
  /// node of the present section -> the node of its copy
  std::map<unsigned int, unsigned int> copies;

  /// Return the sorted corners of the faces of a cell.
  std::vector<Corners> faces(const unsigned int cell) const
  {
    std::vector<Corners> result;
    for (auto face : faces_of(mesh.elements[cell].shape))
      {
        for (auto &corner : face)
          corner = mesh.elements[cell].corners[corner];
        result.push_back(sorted(face));
      }
    return result;
  }

  void copy(const unsigned int node)
  {
    if (copies.emplace(node, mesh.points.size()).second)
      mesh.points.push_back(dealii::Point<3>(mesh.points[node]));
  }

  /// Return the corners with copies instead of the nodes on the section.
  Corners renamed(Corners corners) const
  {
    for (auto &corner : corners)
      if (const auto found = copies.find(corner); found != copies.end())
        corner = found->second;
    return corners;
  }

  void copy_nodes(const std::set<Corners> &section)
  {
    copies.clear();
    for (const auto &face : section)
      for (const unsigned int corner : face)
        copy(corner);
    std::map<Corners, unsigned int> middles;
    for (const auto &[corners, node] : mesh.middles)
      if (renamed(corners) != corners)
        middles[corners] = node;
    for (const auto &[corners, node] : middles)
      {
        if (std::all_of(corners.begin(), corners.end(),
                        [&](const auto c) { return copies.count(c) > 0; }))
          copy(node);
        mesh.middles[sorted(renamed(corners))] = renamed({node})[0];
      }
    for (const auto &face : section)
      sets.cut_faces.insert({face, sorted(renamed(face))});
    for (const auto &[node, other] : copies)
      {
        sets.copies.insert(other);
        for (auto &set : sets.of_nodes)
          if (set.second.count(node) > 0)
            set.second.insert(other);
        for (auto &boundary : mesh.optional_boundaries)
          if (boundary.second.nodes.count(node) > 0)
            boundary.second.nodes.insert(other);
      }
  }

  /// Give the cells of a side, and their faces in sets, the copies of the nodes. Surfaces but
  /// @p name end at the section.
  void separate(const std::string &name, const Cells &side, const std::set<Corners> &section)
  {
    const auto rename = [&](MeshFile::Element &face) {
      const auto key   = sorted(face.corners);
      const auto cells = cells_at.find(key);
      if (section.count(key) > 0 && face.groups != std::vector<std::string>{name})
        face.groups.clear();
      else if (cells != cells_at.end() &&
               std::any_of(cells->second.begin(), cells->second.end(),
                           [&](const auto cell) { return side.count(cell) > 0; }))
        face.corners = renamed(face.corners);
    };
    for (auto &element : mesh.elements)
      if (dimension(element.shape) + 1 == dim)
        rename(element);
    for (const auto &line : sets.of_lines)
      for (const auto &boundary : line.second)
        for (auto &face : mesh.optional_boundaries[boundary].faces)
          rename(face);
    for (const unsigned int cell : side)
      if (auto &corners = mesh.elements[cell].corners; renamed(corners) != corners)
        {
          for (const auto &face : faces(cell))
            cells_at[face].erase(cell);
          corners = renamed(corners);
          for (const auto &face : faces(cell))
            cells_at[face].insert(cell);
        }
  }
};
} // namespace

void cut_at_sections(const DeckText &deck, DeckSets &sets, MeshFile &mesh)
{
  std::optional<Cutter> cutter;
  for (const auto &keyword : deck.keywords())
    if (keyword.name == "PRE-TENSIONSECTION" && !keyword.has("ELEMENT"))
      {
        const auto word  = keyword.option("SURFACE");
        const auto found = sets.spelling.find(upper_case(word));
        if (found == sets.spelling.end() || sets.surfaces.count(found->second) == 0)
          throw keyword_error(keyword, "there is no surface '" + word + "' of faces");
        if (!cutter)
          cutter.emplace(sets, mesh);
        cutter->cut(keyword, found->second);
      }
}
} // namespace snug::mesh_file
