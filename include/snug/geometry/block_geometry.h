#ifndef snug_geometry_block_geometry_h
#define snug_geometry_block_geometry_h

#include <snug/base/assertions.h>
#include <snug/geometry/block_mesh.h>
#include <snug/geometry/body_geometry.h>
#include <snug/geometry/cell_numbering.h>

#include <algorithm>

namespace snug::geometry {
/**
 * A body of blocks. A point with coordinates u in a block lies at the
 * transfinite interpolation of the block faces (Gordon, Hall, Numer. Math. 21,
 * 1973), in 3D
 * @f[ x(u) = \sum_{f} w_f S_f - \sum_{e} w_e C_e + \sum_v w_v x_v, @f]
 * where the weights w are products of u_d or 1 - u_d over the axes normal to face f, edge e and
 * vertex v. Faces S and edges C of a curved boundary lie on the surface of the boundary. An edge C
 * between two curved boundaries lies on one of the two surfaces, and the face S of the other
 * boundary blends to this edge. Pieces of the mesh define their own positions.
 */
template <int dim>
class BlockGeometry : public BodyGeometry<dim>
{
public:
  explicit BlockGeometry(std::shared_ptr<const BlockMesh<dim>> mesh);

  typename BodyGeometry<dim>::CoarseMesh coarse_mesh() const override;

  double n_coarse_cells() const override
  {
    return double(mesh->is_excerpt() ? mesh->place.n_blocks : mesh->blocks.size()) *
           cells_per_block();
  }

  bool has_all_cells() const override { return !mesh->is_excerpt(); }

  const std::vector<std::string> &boundary_names() const override { return mesh->boundary_names; }

  std::vector<std::string> region_names() const override { return mesh->region_names; }

  /// Coarse cells are numbered block after block.
  unsigned int region(unsigned int coarse_cell) const override
  {
    return mesh->regions[block_of(coarse_cell)];
  }

  /// Blocks that are parts of elements have one coarse cell.
  ElementPart<dim> element_part(unsigned int coarse_cell) const override
  {
    return mesh->parts.empty() ? ElementPart<dim>() : mesh->parts[block_of(coarse_cell)];
  }

  std::vector<KnownSurface<dim>> known_surfaces() const override { return mesh->known_surfaces; }

  unsigned int known_surface(unsigned int coarse_cell, unsigned int face) const override;

  BoundaryShape boundary_shape(unsigned int boundary) const override
  {
    const auto found = mesh->shapes.find(boundary);
    return found == mesh->shapes.end() ? BoundaryShape() : found->second;
  }

  dealii::Point<dim> position(const MeshPoint<dim> &point) const override;

  dealii::Point<dim> logical(const MeshPoint<dim> &point) const override
  {
    // Blocks have no common axes, so the logical coordinates are positions in units of the
    // diagonal of the body.
    return Point((position(point) - bounds[0]) / bounds[0].distance(bounds[1]));
  }

  dealii::Tensor<1, dim> extent() const override { return bounds[1] - bounds[0]; }

private:
  using Manifold = const dealii::Manifold<dim, dim>;
  using Point    = dealii::Point<dim>;

  std::shared_ptr<const BlockMesh<dim>> mesh;
  /// curved edges and faces, by the vertices in ascending order
  std::map<std::vector<unsigned int>, Manifold *> curved;
  std::vector<bool>                               is_curved; ///< per block
  std::vector<bool>                               on_curve;  ///< per vertex
  std::array<Point, 2>                            bounds;    ///< of the vertices

  /// Return whether an edge or a face may be curved: all vertices are on curved ones. This check
  /// saves most searches.
  bool may_curve(const std::vector<unsigned int> &vertices) const
  {
    return std::all_of(vertices.begin(), vertices.end(),
                       [&](const unsigned int vertex) { return on_curve[vertex]; });
  }

  unsigned int cells_per_block() const { return product(mesh->cells); }

  /// Return the index of the block of a coarse cell, which must be on this rank.
  unsigned int block_of(const unsigned int coarse_cell) const
  {
    const unsigned int block = coarse_cell / cells_per_block();
    if (!mesh->is_excerpt())
      return block;
    const auto &numbers = mesh->place.numbers;
    const auto  found   = std::lower_bound(numbers.begin(), numbers.end(), block);
    SNUG_ASSERT(found != numbers.end() && *found == block, "the cell is on another rank");
    return found - numbers.begin();
  }

  Point block_position(unsigned int block, const Point &u) const;
  /// Return the position on the piece with these vertices, or null if there is no such piece.
  std::unique_ptr<Point> piece_position(const std::vector<unsigned int> &vertices,
                                        const std::vector<double>       &weights) const;
  Point                  edge_position(const std::vector<unsigned int> &vertices, double t) const;
  Point face_position(const std::vector<unsigned int> &vertices, const dealii::Point<2> &u) const;
  Point interpolated(const std::vector<unsigned int> &vertices,
                     const std::vector<double>       &weights,
                     Manifold                        *manifold) const;
};
} // namespace snug::geometry

#endif
