#ifndef snug_mesh_file_mesh_file_h
#define snug_mesh_file_mesh_file_h

#include <deal.II/base/point.h>

#include <map>
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

/// "triangles" and so on.
std::string plural(ElementShape shape);

/// What a mesh file holds.
struct MeshFile
{
  struct Element
  {
    ElementShape              shape;
    std::vector<unsigned int> corners; ///< indices into points
    /// names or numbers of the groups it is in; the last one counts
    std::vector<std::string> groups;
    unsigned long            number; ///< as the file counts
    unsigned long            line;   ///< of the file; 0 if it is binary
  };

  std::vector<dealii::Point<3>> points;
  std::vector<Element>          elements;
  /// Groups the file tells only by number, for lack of a name.
  std::map<std::string, bool> unnamed;
  /// Points in the middle of edges and quadrilaterals of quadratic elements, by the corners of
  /// these in ascending order.
  std::map<std::vector<unsigned int>, unsigned int> middles;
};

/**
 * Read the contents of a mesh file: Gmsh .msh 2 and 4.1 (ASCII, binary) or Abaqus .inp. The first
 * word of the text determines the format.
 * @throws InputError: "line 17: what is wrong".
 */
MeshFile read_mesh_file(const std::string &text);
} // namespace snug::mesh_file

#endif
