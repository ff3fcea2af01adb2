#ifndef snug_shape_interior_h
#define snug_shape_interior_h

#include <snug/shape/shaped_face.h>

#include <memory>

namespace snug::shape {
/**
 * This class moves the nodes of a body with the shaped face of the body. It is a linear operator
 * from the displacements of the face nodes to the displacements of all nodes. The operator keeps
 * the displacements of the face nodes. The caller sets the hanging nodes of the mesh.
 */
template <int dim>
class Interior
{
public:
  using Field     = mesh::Field<dim>;
  using FaceField = typename ShapedFace<dim>::Field;

  virtual ~Interior() = default;

  /// Return the displacements of the local nodes. @p moves begins with the displacements of the
  /// face nodes, which are the same on all ranks. Collective.
  virtual Field extend(const FaceField &moves) const = 0;
};

/**
 * Return an interior in which each node of a box follows the face point below or above the node,
 *   u(x) = b(x) u(face point),  b = max(0, 1 - depth / reach).
 * The depth is measured in the box before the faces are curved. The reach is the height of the
 * box unless the entry Reach is given. The face point is found in logical coordinates, and its
 * displacement is interpolated with the shape functions of the elements. Linear blending needs
 * a body with the frame of a box, which check_shapes() of the scene requires. Collective.
 * @throws InputError. The mesh must outlive the interior, here and in solved_interior().
 */
template <int dim>
std::unique_ptr<Interior<dim>> linear_blending(const ShapedFace<dim> &face,
                                               const ShapeParameters &parameters);

/**
 * Return an interior that solves an elliptic problem on the reference mesh,
 *   A_ff u_f = -A_fd u_d,
 * with the face nodes d and the free nodes f. A is the Laplacian of each component, or the
 * stiffness matrix of an elastic body. Young's modulus of this body in each cell is the inverse
 * of the volume of the cell, so that small cells deform less than large cells (Stein, Tezduyar,
 * Benney, J. Appl. Mech. 70, 2003). With the projectors P of NodeRoles, A_ff stands for
 * P A_ff P, completed by a multiple of I - P.
 *
 * extend() solves one linear system by conjugate gradients with algebraic multigrid, to round-off.
 * It throws a SolveError if conjugate gradients fail. Collective.
 */
template <int dim>
std::unique_ptr<Interior<dim>> solved_interior(const ShapedFace<dim> &face,
                                               const ShapeParameters &parameters);
} // namespace snug::shape

#endif
