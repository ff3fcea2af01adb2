#ifndef snug_mesh_tetrahedron_h
#define snug_mesh_tetrahedron_h

#include <array>
#include <vector>

namespace snug::mesh {
template <int dim>
class BodyMesh;

/**
 * A tetrahedron with ten nodes. Its four cells are on this rank, of one region, and constrained to
 * the quadratic functions of the tetrahedron, see QuadraticElements. Nodes are the corners, which
 * are numbered right-handed, then the middles of the edges 01, 12, 02, 03, 13, 23, as in VTK. Cell
 * k is the cell at corner k.
 */
struct Tetrahedron
{
  std::array<unsigned int, 4>  cells; ///< indices into BodyMesh::cells()
  std::array<unsigned int, 10> nodes; ///< local nodes; none of them hangs

  /// Return the corners of a face and the middles of its edges 01, 12, 02. The corners are
  /// right-handed about the normal out of the tetrahedron. @p opposite is the other corner.
  std::array<unsigned int, 6> face(unsigned int opposite) const;

  /// Return the index in nodes of the middle of an edge.
  static unsigned int middle(unsigned int corner, unsigned int other);
};

/// Corners to which the axes of the cell at each corner lead.
constexpr std::array<std::array<unsigned char, 3>, 4> tetrahedron_axes = {
  {{{1, 2, 3}}, {{2, 0, 3}}, {{0, 1, 3}}, {{1, 0, 2}}}};

/// Return the tetrahedra of a mesh, in the order of their first cells; none in 2D.
template <int dim>
std::vector<Tetrahedron> find_tetrahedra(const BodyMesh<dim> &mesh);

/// Return the values of the ten functions at the 27 nodes of the cell at @p corner, row by row.
const std::vector<double> &tetrahedron_functions(unsigned int corner);
} // namespace snug::mesh

#endif
