#ifndef snug_shape_solved_interior_h
#define snug_shape_solved_interior_h

#include <snug/base/petsc_handle.h>
#include <snug/shape/interior.h>
#include <snug/shape/interior_matrix.h>
#include <snug/shape/node_roles.h>

namespace snug::shape {
/**
 * A body's nodes follow the shaped face by an elliptic problem on the
 * reference mesh,
 *   A_ff u_f = -A_fd u_d,
 * with d the nodes of the face and f those that are free. A is the
 * Laplacian of each component, or the stiffness of an elastic body whose
 * Young's modulus in each cell is the inverse of the cell's volume, which
 * spares small cells (Stein, Tezduyar, Benney, J. Appl. Mech. 70, 2003).
 * With P the projectors of NodeRoles, A_ff stands for P A_ff P, completed
 * by a multiple of I - P.
 *
 * One solve per extend() and transpose(): conjugate gradients with
 * algebraic multigrid, down to round-off, so that the two are adjoint.
 */
template <int dim>
class SolvedInterior : public Interior<dim>
{
public:
  using Field     = typename Interior<dim>::Field;
  using FaceField = typename Interior<dim>::FaceField;

  /// @p reach as for NodeRoles. Collective. The face must outlive this.
  SolvedInterior(const ShapedFace<dim> &face, double reach, InteriorKind kind);

  /// @throws SolveError
  Field extend(const FaceField &moves) const override;

  /// @throws SolveError
  FaceField transpose(const Field &gradient) const override;

private:
  using Block = dealii::Tensor<2, dim>;
  /// Columns and blocks of one row.
  using Row = std::vector<std::pair<unsigned int, Block>>;

  void             number_unknowns();
  std::vector<Row> assemble(InteriorKind kind);
  void             send_to_owners(std::vector<Row> &rows) const;
  void             build_matrix(const std::vector<Row> &rows);
  void             build_solver(InteriorKind kind);
  /// solution = A_ff^-1 right hand side, both with ghosts: contributions
  /// of all ranks to the latter are added up, the former is known on all.
  std::vector<dealii::Tensor<1, dim>>
  solve(const std::vector<dealii::Tensor<1, dim>> &right_hand_side) const;

  const ShapedFace<dim> &face;
  NodeRoles<dim>         roles;

  std::vector<unsigned int> nodes; ///< of unknowns: own ones, then ghosts
  unsigned int              n_own = 0;
  std::vector<unsigned int> numbers;   ///< of unknowns, unique over ranks
  std::vector<unsigned int> unknowns;  ///< of local nodes, or none
  std::vector<Row>          couplings; ///< of unknowns: A_fd

  petsc::Matrix matrix; ///< A_ff; none if nothing is free
  petsc::Solver solver;
  petsc::Vector b, x, residual, correction;
};
} // namespace snug::shape

#endif
