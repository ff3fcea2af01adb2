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
/// A face between two cells of a body. The face is a whole face of the finer cell.
template <int dim>
struct InteriorFace
{
  unsigned int  cell;      ///< the finer cell, or one of two cells of equal size
  unsigned int  neighbour; ///< the other cell
  unsigned char face;      ///< face f of the cell: side f % 2 of axis f / 2
  /// number of the cell in its parent if the neighbour is as large as the parent; 2^dim if the
  /// neighbour is as large as the cell
  unsigned char child;
  unsigned char origin; ///< vertex of the neighbour at the first vertex of the face
  /// axes of the neighbour along the axes of the face in ascending order
  std::array<unsigned char, dim - 1> axes;

  /// Return the neighbour's coordinates of the face point with coordinates @p in_cell in the cell.
  dealii::Point<dim> in_neighbour(const dealii::Point<dim> &in_cell) const;
};

/**
 * Return the faces between cells of this rank, and between cells of this rank and cells of other
 * ranks, in the order of the active cells. Owned cells are numbered in the order of the active
 * cells. Cells of other ranks are numbered behind the owned cells in the order of @p ghosts,
 * which receives the active indices of the cells of other ranks.
 */
template <int dim>
std::vector<InteriorFace<dim>> interior_faces(const dealii::Triangulation<dim, dim> &triangulation,
                                              std::vector<unsigned int>             &ghosts);
} // namespace snug::mesh

#endif
