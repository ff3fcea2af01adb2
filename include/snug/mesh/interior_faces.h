#ifndef snug_mesh_interior_faces_h
#define snug_mesh_interior_faces_h

#include <deal.II/base/point.h>

#include <array>
#include <vector>

namespace dealii {
template <int dim, int spacedim>
class Triangulation;
}

namespace snug::mesh {
/// A face in which two cells of a body meet, as the finer of them sees it.
template <int dim>
struct InteriorFace
{
  unsigned int  cell;      ///< the finer, or one of two of equal size
  unsigned int  neighbour; ///< the other
  unsigned char face;      ///< of the cell: side f % 2 of its axis f / 2
  /// number of the cell in its parent, which is as large as the neighbour;
  /// 2^dim where the cell itself is
  unsigned char child;
  unsigned char origin; ///< vertex of the neighbour at the first vertex of the face
  /// of the neighbour, along the axes of the face in ascending order
  std::array<unsigned char, dim - 1> axes;

  /// Coordinates in the neighbour of a point of the face, given in the cell.
  dealii::Point<dim> in_neighbour(const dealii::Point<dim> &in_cell) const;
};

/**
 * Faces between cells of this rank and from them to cells of others, in the
 * order of the active cells. Owned cells are numbered in that order, the
 * cells of other ranks behind them in the order of @p ghosts, which are
 * their active indices.
 */
template <int dim>
std::vector<InteriorFace<dim>> interior_faces(const dealii::Triangulation<dim, dim> &triangulation,
                                              std::vector<unsigned int>             &ghosts);
} // namespace snug::mesh

#endif
