#ifndef snug_mesh_file_mesh_formats_h
#define snug_mesh_file_mesh_formats_h

#include <snug/mesh_file/mesh_file.h>

namespace snug::mesh_file {
/// @name Readers of file formats @throws InputError: "line 17: ..."
/// @{

/// Gmsh .msh 2 and 4.1; groups are the physical ones. Source: Gmsh
/// reference manual, file formats.
MeshFile read_gmsh(const std::string &text);

/**
 * Abaqus .inp; groups are the element surfaces and the element sets but for
 * those Abaqus/CAE makes, whose names begin with _. One part, not moved;
 * keywords that generate or move nodes or elements are errors, others than
 * NODE, ELEMENT, ELSET and SURFACE are skipped. Source: Abaqus keywords
 * reference.
 */
MeshFile read_abaqus(const std::string &text);
/// @}

/// Of the nodes of a quadratic element that follow its corners: the corners of the edge, face or
/// element in whose middle each of them lies.
using MiddleOrder = std::vector<std::vector<unsigned int>>;

/// Return the order of Abaqus or of Gmsh.
const MiddleOrder &abaqus_middles(ElementShape shape);
const MiddleOrder &gmsh_middles(ElementShape shape);

/// Of the @p nodes of an element, corners first, add the corners to @p element and the others to
/// the middles of the mesh.
void add_nodes(MeshFile                        &mesh,
               MeshFile::Element               &element,
               const std::vector<unsigned int> &nodes,
               const MiddleOrder               &order);

/// What the elements of a type of a format are; quadratic ones have more nodes than corners.
struct ElementType
{
  ElementShape shape;
  unsigned int n_nodes;
};

/// Points by the numbers a file gives them.
class PointNumbers
{
public:
  /// @throws InputError if the number occurred before.
  void add(unsigned long number, unsigned long line);

  /// Index of the point; @p element is for the message.
  /// @throws InputError if there is none.
  unsigned int index(unsigned long number, const std::string &element, unsigned long line) const;

private:
  std::map<unsigned long, unsigned int> indices;
};
} // namespace snug::mesh_file

#endif
