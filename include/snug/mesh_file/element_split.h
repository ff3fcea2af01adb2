#ifndef snug_mesh_file_element_split_h
#define snug_mesh_file_element_split_h

#include <snug/mesh_file/mesh_file.h>

namespace snug::mesh_file {
/// For each corner of an element that has as many edges as the element
/// has dimensions: their other ends, right-handed. Empty for pyramids.
const std::vector<std::vector<unsigned int>> &corner_neighbours(ElementShape shape);

/// Corners of the faces of an element, of flat ones its edges, in Abaqus' order (S1, S2, ...). They
/// go round such that the normal by the right-hand rule points into the element, which lies to the
/// left of the edges of a flat one. None for pyramids.
const std::vector<std::vector<unsigned int>> &faces_of(ElementShape shape);

/// Whether all elements of the shape are lines, quadrilaterals or
/// hexahedra, the shapes of cells and their faces.
bool is_cell_shape(ElementShape shape);

/// Corners in deal.II's order. Only for cell shapes.
std::vector<unsigned int> cell_vertices(const MeshFile::Element &element);

/**
 * Splits elements into lines, quadrilaterals or hexahedra, one at each
 * corner, between the middles of edges, faces and the element. Elements
 * that share faces still do.
 */
class ElementSplit
{
public:
  /// New points go to the end of @p points, which must outlive this object.
  explicit ElementSplit(std::vector<dealii::Point<3>> &points) : points(points) {}

  /// Vertices of the parts in deal.II's order.
  std::vector<std::vector<unsigned int>> parts(const MeshFile::Element &element);

  /// Index of the middle of the points with these indices.
  unsigned int middle(std::vector<unsigned int> corners);

private:
  std::vector<dealii::Point<3>>                    &points;
  std::map<std::vector<unsigned int>, unsigned int> middles;
};
} // namespace snug::mesh_file

#endif
