#include <snug/io/element_nodes.h>
#include <snug/mesh_file/mesh_formats.h>

namespace snug::io {
std::vector<unsigned int>
element_nodes(const unsigned int dim, const unsigned int degree, const Format format)
{
  // Corners around the bottom, then around the top; their bits are the coordinates.
  const unsigned int        corners[8] = {0, 1, 3, 2, 4, 5, 7, 6};
  const unsigned int        n          = degree + 1;
  std::vector<unsigned int> result;
  // Return the node at the mean of corners.
  const auto node_at = [&](const std::vector<unsigned int> &of) {
    unsigned int node = 0, stride = 1;
    for (unsigned int d = 0; d < dim; ++d, stride *= n)
      {
        unsigned int sum = 0;
        for (const unsigned int corner : of)
          sum += corners[corner] >> d & 1;
        node += stride * (sum * degree / of.size());
      }
    return node;
  };
  const unsigned int n_corners = 1u << dim;
  for (unsigned int corner = 0; corner < n_corners; ++corner)
    result.push_back(node_at({corner}));
  if (degree == 1)
    return result;
  using mesh_file::ElementShape;
  const auto shape = dim == 1   ? ElementShape::line
                     : dim == 2 ? ElementShape::quadrilateral
                                : ElementShape::hexahedron;
  const bool gmsh  = format == Format::gmsh;
  for (const auto &middle :
       gmsh ? mesh_file::gmsh_middles(shape) : mesh_file::abaqus_middles(shape))
    if (gmsh || middle.size() == 2)
      result.push_back(node_at(middle));
  if (gmsh && dim == 3)
    result.push_back(node_at({0, 1, 2, 3, 4, 5, 6, 7}));
  return result;
}

std::vector<unsigned int> in_order(const std::vector<unsigned int> &nodes,
                                   const std::vector<unsigned int> &order)
{
  std::vector<unsigned int> result;
  for (const unsigned int i : order)
    result.push_back(nodes[i]);
  return result;
}
} // namespace snug::io
