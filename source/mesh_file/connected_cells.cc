#include <snug/mesh_file/mesh_file.h>

#include <algorithm>
#include <numeric>

namespace snug::mesh_file {
namespace {
/// Return the indices of the elements of the highest dimension.
std::vector<unsigned int> cells_of(const MeshFile &file)
{
  unsigned int dim = 0;
  for (const auto &element : file.elements)
    dim = std::max(dim, dimension(element.shape));
  std::vector<unsigned int> cells;
  for (unsigned int e = 0; e < file.elements.size(); ++e)
    if (dimension(file.elements[e].shape) == dim)
      cells.push_back(e);
  return cells;
}

/// Return the representative of the set of @p point, and shorten the path to it (union-find).
unsigned int root_of(std::vector<unsigned int> &parent, unsigned int point)
{
  while (parent[point] != point)
    point = parent[point] = parent[parent[point]];
  return point;
}
} // namespace

std::vector<ConnectedCells> connected_cells(const MeshFile &file, const std::set<unsigned int> &cut)
{
  std::vector<unsigned int> parent(file.points.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto cells    = cells_of(file);
  const auto first_of = [&](const unsigned int cell) {
    const auto &corners = file.elements[cell].corners;
    const auto  first   = std::find_if(corners.begin(), corners.end(),
                                       [&](const auto corner) { return cut.count(corner) == 0; });
    return first == corners.end() ? corners.front() : *first;
  };
  std::map<std::string, unsigned int> size_of_group;
  for (const unsigned int cell : cells)
    {
      const auto &element = file.elements[cell];
      for (const unsigned int corner : element.corners)
        if (cut.count(corner) == 0)
          parent[root_of(parent, corner)] = root_of(parent, first_of(cell));
      for (const auto &group : element.groups)
        ++size_of_group[group];
    }
  std::vector<ConnectedCells>          bodies;
  std::map<unsigned int, unsigned int> body_of_root;
  for (const unsigned int cell : cells)
    {
      const unsigned int root  = root_of(parent, first_of(cell));
      const auto         entry = body_of_root.emplace(root, bodies.size());
      if (entry.second)
        bodies.emplace_back();
      bodies[entry.first->second].elements.push_back(cell);
    }
  for (auto &body : bodies)
    for (const auto &group : file.elements[body.elements.front()].groups)
      if (body.group.empty() && size_of_group[group] == body.elements.size() &&
          std::all_of(body.elements.begin(), body.elements.end(), [&](const unsigned int e) {
            const auto &groups = file.elements[e].groups;
            return std::find(groups.begin(), groups.end(), group) != groups.end();
          }))
        body.group = group;
  return bodies;
}

void name_connected_cells(MeshFile &file)
{
  const auto bodies = connected_cells(file);
  for (unsigned int b = 0; b < bodies.size() && bodies.size() > 1; ++b)
    if (bodies[b].group.empty())
      for (const unsigned int element : bodies[b].elements)
        {
          auto &groups = file.elements[element].groups;
          groups.insert(groups.begin(), "body-" + std::to_string(b + 1));
        }
}
} // namespace snug::mesh_file
