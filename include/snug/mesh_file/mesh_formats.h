#ifndef snug_mesh_file_mesh_formats_h
#define snug_mesh_file_mesh_formats_h

#include <snug/mesh_file/mesh_file.h>

namespace snug::mesh_file {
/// @name Readers of file formats @throws InputError "line 17: message"
/// @{

/// Read Gmsh .msh 2 and 4.1. The groups are the physical groups. Source: Gmsh reference manual,
/// file formats.
MeshFile read_gmsh(const std::string &text);

/**
 * Read a deck of Abaqus or CalculiX (.inp): the parts at the places of their instances. The groups
 * are the element surfaces, the instances, and the element sets except the sets of Abaqus/CAE,
 * whose names begin with _. A set of a part is called INSTANCE.SET if the assembly or another
 * instance has a set of the same name, otherwise SET. Cells that are connected, but in no common
 * group of their own, are the group body-N. Node sets, the faces of *DLOAD as Dload-LINE and the
 * nodes of *BOUNDARY as Boundary-LINE are optional boundaries. Keywords that generate or move nodes
 * or elements are errors. The mesh is cut at pre-tension sections. Other keywords are skipped.
 * Source: Abaqus keywords reference.
 */
MeshFile read_abaqus(const std::string &text);
/// @}

/// For each node of a quadratic element that follows the corners: the corners of the edge, face or
/// element in whose middle the node lies.
using MiddleOrder = std::vector<std::vector<unsigned int>>;

/// Return the order of the nodes in Abaqus or in Gmsh.
const MiddleOrder &abaqus_middles(ElementShape shape);
const MiddleOrder &gmsh_middles(ElementShape shape);

/// Store the @p nodes of an element. The corners, which come first, are stored in @p element, and
/// the other nodes in the middles of @p mesh.
void add_nodes(MeshFile                        &mesh,
               MeshFile::Element               &element,
               const std::vector<unsigned int> &nodes,
               const MiddleOrder               &order);

/// An element type of a format. Quadratic elements have more nodes than corners.
struct ElementType
{
  ElementShape shape;
  unsigned int n_nodes;
};

/// Return the element type @p name of Abaqus, which is in upper case. A name consists of a family,
/// a number of nodes and letters for variants of the formulation (R, H, I, M, T), which are
/// ignored. The shape depends on the family: C3D6 is a prism, CPS6 a triangle.
/// @throws InputError if the type is not supported.
ElementType abaqus_type(const std::string &name, unsigned long line);

/// Return whether an element type of Abaqus is a spring, mass, beam, pipe, connector, gap or
/// dashpot, which is no cell and no face. @p name is in upper case.
bool is_point_element(const std::string &name);

/// This class maps the numbers of nodes in a file to indices of points.
class PointNumbers
{
public:
  /// Map a number to the point @p index. @throws InputError if the number occurred before.
  void add(unsigned long number, unsigned int index, unsigned long line);

  /// Return the index of the point with this number. The error message contains the name @p element
  /// of the element that needs the point. @throws InputError if there is no such point.
  unsigned int index(unsigned long number, const std::string &element, unsigned long line) const;

private:
  std::map<unsigned long, unsigned int> indices;
};
} // namespace snug::mesh_file

#endif
