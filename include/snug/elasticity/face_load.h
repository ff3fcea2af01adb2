#ifndef snug_elasticity_face_load_h
#define snug_elasticity_face_load_h

#include <snug/elasticity/linear_traction.h>
#include <snug/mesh/idealization.h>
#include <snug/mesh/lagrange.h>

#include <optional>
#include <vector>

namespace snug::elasticity {
/// Dead force F at a point of a face, or a force per length q along a short piece of a line on the
/// face. The force F, or q times the length of the piece, acts at the point.
template <int dim>
struct ConcentratedForce
{
  mesh::LagrangePoint<dim - 1> shape; ///< shape functions of the face at the point
  dealii::Tensor<1, dim>       force; ///< F [force] or q [force / length]
  /// direction xi' of the line in the coordinates of the face times the piece of its parameter: the
  /// piece is the vector sum_a (xi' . grad N_a) X_a. Empty for a force at a point.
  std::optional<dealii::Tensor<1, dim - 1>> piece = {};

  /// Return the vector of the piece for node positions X, or its derivative for velocities X.
  dealii::Tensor<1, dim> vector(const std::vector<dealii::Tensor<1, dim>> &X) const;

  /// Return the force at the point for node positions X [force].
  dealii::Tensor<1, dim> total(const std::vector<dealii::Tensor<1, dim>> &X) const
  {
    return piece ? vector(X).norm() * force : force;
  }
};

/// Dead loads of one face: pressure and traction at its Gauss points [force / length^2]; an empty
/// list stands for zero.
template <int dim>
struct FaceLoadValues
{
  std::vector<double>                 pressure;
  std::vector<dealii::Tensor<1, dim>> traction;
  LinearTraction<dim>                 linear; ///< traction of a resultant
  std::vector<ConcentratedForce<dim>> concentrated = {};
};

/// Data that determine the work f . u of a resultant besides its traction: U = int u dA and
/// y = I^-1 int r x u dA over the whole loaded face.
template <int dim>
struct ResultantWork
{
  LinearTraction<dim>    traction;
  double                 area = 0.;
  dealii::Tensor<1, dim> displacement; ///< U
  dealii::Tensor<1, 3>   rotation;     ///< y
};

/**
 * Dead surface loads of one oriented boundary face (see BodyMesh::Face)
 * with n = (p+1)^(dim-1) nodes, degree p = 1 or 2:
 * f_a = int N_a (t dA - q n dA), traction t [force / length^2],
 * pressure q along the inner normal -n of the given positions.
 *
 * With tangents t_i = dx/d xi_i, n dA = w m d xi, m = t_1 x t_2 in 3D,
 * (t_y, -t_x) in 2D, and the weight w of the idealization. Derivatives
 * along node velocities V: m' = V_,1 x t_2 + t_1 x V_,2,
 * dA' = (w n.m' + w' |m|) d xi and w' = dw/dx . V. Pressures and tractions at Gauss points are
 * fixed to the material and do not change. A concentrated force adds N_a F, or N_a q |s| with the
 * vector s of a piece of a line, whose derivative is N_a q s.s' / |s|.
 *
 * X: positions, V: velocities of the positions, u: displacements, n
 * vectors each. (p+1)^(dim-1) Gauss points. |m| > 0 is assumed.
 */
template <int dim>
class FaceLoad
{
public:
  using Nodes = std::vector<dealii::Tensor<1, dim>>;

  explicit FaceLoad(unsigned int              degree,
                    const mesh::Idealization &idealization = mesh::Idealization::natural(dim));

  /// Return the Gauss points of a face with nodes X.
  Nodes quadrature_points(const Nodes &X) const;

  /// Compute f_a [force].
  void force(const Nodes &X, const FaceLoadValues<dim> &load, Nodes &f) const;

  /// Compute f = derivative of force() along V, exact. @p linear is the derivative of the linear
  /// traction.
  void force_derivative(const Nodes               &X,
                        const Nodes               &V,
                        const FaceLoadValues<dim> &load,
                        const LinearTraction<dim> &linear,
                        Nodes                     &f) const;

  /// Compute gradient_a += factor * d/dX_a (f(X) . u) for all loads but the linear traction.
  void add_force_gradient(const Nodes               &X,
                          const FaceLoadValues<dim> &load,
                          const Nodes               &u,
                          double                     factor,
                          Nodes                     &gradient) const;

  /**
   * Compute gradient_a += factor * d/dX_a (f . u) for a resultant, where f is that of the whole
   * loaded face. With r = x - c, this face contributes int kappa dA' + int k . V dA, where
   * kappa = u.t - (a.U + (U x w).r) / A - |r|^2 y.w + (y.r)(w.r),
   * k = u x w - (U x w) / A - 2 (y.w) r + (w.r) y + (y.r) w.
   */
  void add_resultant_gradient(const Nodes              &X,
                              const ResultantWork<dim> &work,
                              const Nodes              &u,
                              double                    factor,
                              Nodes                    &gradient) const;

  /// Return the moments of area about @p origin.
  AreaMoments<dim> moments(const Nodes &X, const dealii::Tensor<1, dim> &origin) const;

  /// Return the derivatives of the moments along V, exact.
  AreaMoments<dim>
  moment_derivatives(const Nodes &X, const Nodes &V, const dealii::Tensor<1, dim> &origin) const;

  /// Return int u dA and int (x - centre) x u dA, as a force and a moment.
  Resultant<dim>
  displacement_moments(const Nodes &X, const Nodes &u, const dealii::Tensor<1, dim> &centre) const;

  /// Return the tributary areas int N_a dA [length^2].
  std::vector<double> areas(const Nodes &X) const;

private:
  mesh::Idealization                        idealization;
  std::vector<mesh::LagrangePoint<dim - 1>> gauss;
};
} // namespace snug::elasticity

#endif
