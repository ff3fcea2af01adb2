#ifndef snug_shape_interior_matrix_h
#define snug_shape_interior_matrix_h

#include <snug/elasticity/element.h>
#include <snug/mesh/body_mesh.h>
#include <snug/shape/shape_parameters.h>

namespace snug::shape {
/**
 * Cell matrices of the operator of solved_interior(), which extends the displacements of a face
 * into the body. Hanging nodes are condensed to their masters.
 */
template <int dim>
class InteriorMatrix
{
public:
  using Block = dealii::Tensor<2, dim>;

  /// Matrix of a cell between the unconstrained @p nodes that the cell depends on. The blocks are
  /// stored row by row.
  struct CellMatrix
  {
    std::vector<unsigned int> nodes; ///< local
    std::vector<Block>        blocks;
  };

  InteriorMatrix(const mesh::BodyMesh<dim> &mesh, InteriorKind kind);

  CellMatrix of_cell(const typename mesh::BodyMesh<dim>::Cell &cell) const;

private:
  using Nodes = std::vector<dealii::Tensor<1, dim>>;

  /// Return the matrix of the Laplacian of each component, stored row by row.
  std::vector<double> laplacian(const Nodes &X) const;

  const mesh::BodyMesh<dim>            &mesh;
  InteriorKind                          kind;
  elasticity::Element<dim>              element;
  std::vector<mesh::LagrangePoint<dim>> gauss;
};
} // namespace snug::shape

#endif
