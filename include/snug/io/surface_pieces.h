#ifndef snug_io_surface_pieces_h
#define snug_io_surface_pieces_h

#include <snug/mesh/surface.h>

#include <vector>

namespace snug::io {
/// A connected piece of a boundary.
struct SurfacePiece
{
  unsigned int              body, boundary;
  std::vector<unsigned int> faces; ///< indices of the surface
  /// indices of the surface: in 2D along the piece, with the body on its left; a closed piece ends
  /// with its first node. In 3D ascending.
  std::vector<unsigned int> nodes;
};

/// Return the connected pieces, sorted by body and boundary. Faces are connected by common nodes.
template <int dim>
std::vector<SurfacePiece> surface_pieces(const mesh::Surface<dim> &surface);
} // namespace snug::io

#endif
