#ifndef snug_mesh_file_element_split_h
#define snug_mesh_file_element_split_h

#include <snug/geometry/cell_numbering.h>
#include <snug/mesh_file/mesh_file.h>

namespace snug::mesh_file {
/// Return the adjacent corners of each corner, in right-handed order. Return an empty list for
/// pyramids, because four edges meet at their tips.
const std::vector<std::vector<unsigned int>> &corner_neighbours(ElementShape shape);

/// Return the corners of each face of an element, or of each edge of a plane element, in the order
/// of Abaqus (S1, S2, ...). The normal of a face by the right-hand rule points into the element. A
/// plane element lies to the left of its edges. The list is empty for pyramids.
const std::vector<std::vector<unsigned int>> &faces_of(ElementShape shape);

/// Return whether the shape is a line, a quadrilateral or a hexahedron, the shapes of cells and of
/// their faces.
bool is_cell_shape(ElementShape shape);

/// Return the corners in the order of deal.II. The shape must be a cell shape.
std::vector<unsigned int> cell_vertices(const MeshFile::Element &element);

/**
 * This class splits elements into lines, quadrilaterals or hexahedra, one at each corner, between
 * the middles of edges, faces and the element. Parts of elements that share a face also share
 * faces.
 */
class ElementSplit
{
public:
  /// New points are added at the end of @p points, which must outlive this object.
  explicit ElementSplit(std::vector<dealii::Point<3>> &points) : points(points) {}

  /// Return the vertices of the parts in the order of deal.II.
  std::vector<std::vector<unsigned int>> parts(const MeshFile::Element &element);

  /// Return the index of the mean of the points with these indices.
  unsigned int middle(std::vector<unsigned int> corners);

private:
  std::vector<dealii::Point<3>> &points;
  geometry::NumberByVertices     middles;
};
/// Return the shape of a face with these corners: a line, a triangle or a quadrilateral.
ElementShape face_shape(const std::vector<unsigned int> &corners);

/// Return the faces that belong to one of the @p cells only, in the order of faces_of().
std::vector<std::vector<unsigned int>> outer_faces(const std::vector<MeshFile::Element> &cells);
} // namespace snug::mesh_file

#endif
