#ifndef snug_mesh_file_mesh_file_h
#define snug_mesh_file_mesh_file_h

#include <deal.II/base/point.h>

#include <map>
#include <set>
#include <string>
#include <vector>

namespace snug::mesh_file {
/// Shapes of elements. Corners are numbered around the bottom, then around the top.
enum class ElementShape
{
  vertex,
  line,
  triangle,
  quadrilateral,
  tetrahedron,
  pyramid,
  prism,
  hexahedron
};

unsigned int dimension(ElementShape shape);

unsigned int n_corners(ElementShape shape);

/// The name of a group that has only a number in the file begins with this text and ends with the
/// number.
const std::string unnamed_group = "group-";

/// This struct stores the content of a mesh file.
struct MeshFile
{
  struct Element
  {
    ElementShape              shape;
    std::vector<unsigned int> corners; ///< indices into points
    /// names of the groups that contain the element, in the order of the file
    std::vector<std::string> groups;
    unsigned long            number; ///< number of the element in the file
    unsigned long            line;   ///< line of the file; 0 if the file is binary
  };

  std::vector<dealii::Point<3>> points;
  std::vector<Element>          elements;
  /// Middle nodes of quadratic elements: corners of an edge or a quadrilateral in ascending order
  /// -> the point in its middle
  std::map<std::vector<unsigned int>, unsigned int> middles;
  /// Boundaries that exist only if the entry 'Boundary sets' names them: the faces whose nodes are
  /// all among the nodes, and the faces
  struct OptionalBoundary
  {
    std::set<unsigned int> nodes; ///< indices into points
    std::vector<Element>   faces;

    /// Return whether the corners of a face, and the nodes in the middles of its edges that the
    /// mesh has, are among the nodes.
    bool has_face(const MeshFile &mesh, const std::vector<unsigned int> &corners) const;
  };
  std::map<std::string, OptionalBoundary> optional_boundaries;
};

/// A body of a mesh file: cells that are connected by common nodes.
struct ConnectedCells
{
  std::vector<unsigned int> elements; ///< indices into MeshFile::elements
  std::string               group;    ///< first group that consists of these cells, or ""
};

/// Return the connected bodies of the elements of the highest dimension, in the order of the file.
/// The nodes @p cut do not connect.
std::vector<ConnectedCells> connected_cells(const MeshFile               &file,
                                            const std::set<unsigned int> &cut = {});

/// Add the cells of each of several connected bodies that has no group of its own to the group
/// body-N, with N from 1 in the order of the file.
void name_connected_cells(MeshFile &file);

/// Return the numbers of elements of each shape but points, such as "4 lines, 2 triangles and 1
/// quadrilateral"; empty if all elements are points.
std::string count_shapes(const std::vector<MeshFile::Element> &elements);

/**
 * Read the contents of a mesh file: Gmsh .msh 2 and 4.1 (ASCII, binary) or Abaqus .inp. The first
 * word of the text determines the format.
 * @throws InputError "line 17: message".
 */
MeshFile read_mesh_file(const std::string &text);
} // namespace snug::mesh_file

#endif
