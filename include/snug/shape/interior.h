#ifndef snug_shape_interior_h
#define snug_shape_interior_h

#include <snug/shape/shaped_face.h>

#include <memory>

namespace snug::shape {
/**
 * How a body's nodes follow its shaped face: a linear operator from the
 * displacements of the face's nodes to those of all nodes, which keeps the
 * former. Hanging nodes of the mesh are left to the caller.
 */
template <int dim>
class Interior
{
public:
  using Field     = typename mesh::BodyMesh<dim>::Field;
  using FaceField = typename ShapedFace<dim>::Field;

  virtual ~Interior() = default;

  /// Displacement of the local nodes; @p moves is the same on all ranks.
  /// Collective.
  virtual Field extend(const FaceField &moves) const = 0;

  /// Transpose of extend(); @p gradient, which has nothing at hanging nodes,
  /// and the result add up to the whole over ranks. Collective.
  virtual FaceField transpose(const Field &gradient) const = 0;
};

/**
 * Nodes of a box follow the point of the shaped face below or above them,
 *   u(x) = b(x) u(face point),  b = max(0, 1 - depth / reach),
 * where depth is measured in the box before its faces are curved and reach
 * is the box's height unless given. The face point is found in logical
 * coordinates, its displacement interpolated as the elements do. The frame
 * of a box, which it needs, is checked with the scene. Collective.
 * @throws InputError. The face must outlive the interior, here and below.
 */
template <int dim>
std::unique_ptr<Interior<dim>> linear_blending(const ShapedFace<dim> &face,
                                               const ShapeParameters &parameters);

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
 * Both throw a SolveError where that fails. Collective.
 */
template <int dim>
std::unique_ptr<Interior<dim>> solved_interior(const ShapedFace<dim> &face,
                                               const ShapeParameters &parameters);
} // namespace snug::shape

#endif
