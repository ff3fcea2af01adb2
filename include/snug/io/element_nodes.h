#ifndef snug_io_element_nodes_h
#define snug_io_element_nodes_h

#include <vector>

namespace snug::io {
/// Formats of mesh files, which differ in the order of the nodes of an element.
enum class Format
{
  gmsh,
  abaqus ///< without the nodes in the middle of faces and cells: CPE8, C3D20
};

/// Return the tensor-product numbers of the nodes of a line, a quadrilateral or a hexahedron of
/// degree 1 or 2, in the order of a format.
std::vector<unsigned int> element_nodes(unsigned int dim, unsigned int degree, Format format);

/// Return @p nodes in the order of element_nodes().
std::vector<unsigned int> in_order(const std::vector<unsigned int> &nodes,
                                   const std::vector<unsigned int> &order);
} // namespace snug::io

#endif
