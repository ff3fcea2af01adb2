#ifndef snug_io_surface_pieces_h
#define snug_io_surface_pieces_h

#include <snug/mesh/surface.h>

#include <vector>

namespace snug::io {
/// This struct is a connected piece of a boundary.
struct SurfacePiece
{
  unsigned int              body, boundary;
  std::vector<unsigned int> faces; ///< indices of faces of the surface
  /// indices of nodes of the surface. In 2D the nodes are in the order along the piece that has the
  /// body on its left, and the first node of a closed piece is repeated at the end. In 3D the
  /// indices are ascending.
  std::vector<unsigned int> nodes;
};

/// Return the connected pieces, sorted by body and boundary. Faces are connected by common nodes.
template <int dim>
std::vector<SurfacePiece> surface_pieces(const mesh::Surface<dim> &surface);
} // namespace snug::io

#endif
