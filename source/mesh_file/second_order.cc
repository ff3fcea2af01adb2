#include <snug/mesh_file/mesh_formats.h>

#include <algorithm>

namespace snug::mesh_file {
// Source: Abaqus user's manual, element library. An element of C3D27 has its centre before its
// faces, which are in the order S1 to S6.
const MiddleOrder &abaqus_middles(const ElementShape shape)
{
  using S                                         = ElementShape;
  static const std::map<S, MiddleOrder> of_shapes = {
    {S::vertex, {}},
    {S::line, {{0, 1}}},
    {S::triangle, {{0, 1}, {1, 2}, {2, 0}}},
    {S::quadrilateral, {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 1, 2, 3}}},
    {S::tetrahedron, {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}},
    {S::pyramid, {}},
    {S::prism, {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}},
    {S::hexahedron,
     {{0, 1},
      {1, 2},
      {2, 3},
      {3, 0},
      {4, 5},
      {5, 6},
      {6, 7},
      {7, 4},
      {0, 4},
      {1, 5},
      {2, 6},
      {3, 7},
      {0, 1, 2, 3, 4, 5, 6, 7},
      {0, 1, 2, 3},
      {4, 7, 6, 5},
      {0, 4, 5, 1},
      {1, 5, 6, 2},
      {2, 6, 7, 3},
      {3, 7, 4, 0}}}};
  return of_shapes.at(shape);
}

// Source: Gmsh reference manual, node ordering.
const MiddleOrder &gmsh_middles(const ElementShape shape)
{
  using S                                         = ElementShape;
  static const std::map<S, MiddleOrder> of_shapes = {
    {S::tetrahedron, {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {2, 3}, {1, 3}}},
    {S::prism,
     {{0, 1},
      {0, 2},
      {0, 3},
      {1, 2},
      {1, 4},
      {2, 5},
      {3, 4},
      {3, 5},
      {4, 5},
      {0, 1, 4, 3},
      {0, 2, 5, 3},
      {1, 2, 5, 4}}},
    {S::hexahedron,
     {{0, 1},
      {0, 3},
      {0, 4},
      {1, 2},
      {1, 5},
      {2, 3},
      {2, 6},
      {3, 7},
      {4, 5},
      {4, 7},
      {5, 6},
      {6, 7},
      {0, 1, 2, 3},
      {0, 1, 5, 4},
      {0, 3, 7, 4},
      {1, 2, 6, 5},
      {2, 3, 7, 6},
      {4, 5, 6, 7}}}};
  const auto found = of_shapes.find(shape);
  return found == of_shapes.end() ? abaqus_middles(shape) : found->second;
}

void add_nodes(MeshFile                        &mesh,
               MeshFile::Element               &element,
               const std::vector<unsigned int> &nodes,
               const MiddleOrder               &order)
{
  const unsigned int n = n_corners(element.shape);
  element.corners.assign(nodes.begin(), nodes.begin() + n);
  for (unsigned int i = 0; i < order.size() && n + i < nodes.size(); ++i)
    {
      std::vector<unsigned int> corners;
      for (const unsigned int corner : order[i])
        corners.push_back(nodes[corner]);
      std::sort(corners.begin(), corners.end());
      mesh.middles.emplace(corners, nodes[n + i]);
    }
}
} // namespace snug::mesh_file
