#ifndef snug_faces_closest_point_h
#define snug_faces_closest_point_h

#include <snug/faces/face_shape.h>

namespace snug::faces {
/// Closest point projection of a given point onto a face.
template <int dim>
struct ClosestPoint
{
  dealii::Point<dim - 1> xi;
  dealii::Tensor<1, dim> position;
  double                 squared_distance;
};

/**
 * Return the closest point to @p p of the face with node positions @p nodes:
 *   min 1/2 |x(xi) - p|^2,  xi in [0,1]^(dim-1).
 * The minimum is found by Newton's method projected onto the bounds, with the Gauss-Newton matrix
 * where the Hessian is not positive definite (Bertsekas, SIAM J. Control Optim. 20, 1982). The
 * method starts from each local minimum of a grid of 2 degree + 1 samples per direction. The result
 * is accurate to round-off. A quadratic face whose radius of curvature is below its distance to
 * @p p may have minima that the grid misses.
 */
template <int dim>
ClosestPoint<dim> closest_point(const FaceShape<dim>                      &shape,
                                const std::vector<dealii::Tensor<1, dim>> &nodes,
                                const dealii::Tensor<1, dim>              &p);
} // namespace snug::faces

#endif
