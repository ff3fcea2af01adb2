#ifndef snug_elasticity_element_h
#define snug_elasticity_element_h

#include <snug/elasticity/cell_point.h>
#include <snug/elasticity/formulation.h>
#include <snug/elasticity/material.h>
#include <snug/elasticity/thermal_strain.h>

#include <deal.II/base/point.h>
#include <deal.II/base/symmetric_tensor.h>

#include <vector>

namespace snug::elasticity {
/**
 * Isoparametric Lagrange element of degree p = 1 or 2 on a quadrilateral
 * or hexahedron: stiffness, loads and volume with exact derivatives with
 * respect to node positions, for all idealizations.
 *
 * n = (p+1)^dim nodes in tensor-product order, first coordinate fastest;
 * unknown dim*a + c is component c of node a. X: positions, V: velocities
 * of the positions, u: displacements, n vectors each. (p+1)^dim Gauss
 * points: exact for volumes; the same rule is used for all terms. Outputs
 * are resized and must not alias inputs.
 *
 * Derivatives along V at each Gauss point, with grad V = sum_a V_a (x) g_a
 * and g_a = grad N_a:
 * g_a' = -(grad V)^T g_a, (det J)' = det J div V,
 * (grad u)' = -(grad u) (grad V).
 * With the gradients of CellPoint these formulas hold in sections too: r' = V_r
 * makes (u_r/r)' = -(u_r/r) (V_r/r) and (r det J)' = r det J div V.
 *
 * Formulation B-bar replaces div u by its projection p_u / kappa,
 * kappa = lambda + 2/3 mu, on polynomials of degree p-1 in the cell
 * (PressureSpace): for p = 1 its mean (Hughes, Int. J. Numer. Meth. Engng
 * 15, 1980; for p = 2 the pair Q2/P1 of mixed methods). K is that of
 * lambda = -2/3 mu plus kappa sum_i c_i c_i', c_i' u = int psi_i div u dV
 * with orthonormal psi_i. As the stationary value over p_u, p_w of
 *   int (2 mu dev e_u : dev e_w + p_u div w + p_w div u
 *        - p_u p_w / kappa) dV
 * w'Ku has the derivative of this integral at fixed p_u and p_w.
 *
 * A thermal strain e I with e = alpha dT, fixed to the material, causes the stress -beta e I of the
 * undeformed cell, beta = 3 kappa, and the load f_a = int beta e g_a dV. In a sheet beta = E / (1 -
 * nu) without a stress across it. B-bar projects e like div u.
 *
 * Nothing is checked here: a cell with quality() <= 0 gives meaningless or,
 * where det J = 0, infinite numbers.
 */
template <int dim>
class Element
{
public:
  using Nodes    = std::vector<dealii::Tensor<1, dim>>;
  using Stresses = std::vector<dealii::SymmetricTensor<2, 3>>;

  /// A displacement with the thermal strain that acts; null: none.
  struct Strained
  {
    Nodes              u;
    ThermalStrain<dim> thermal;
  };

  /// @p degree is 1 or 2. B-bar is not available for plane stress, which does not lock.
  explicit Element(unsigned int              degree,
                   const mesh::Idealization &idealization = mesh::Idealization::natural(dim),
                   Formulation               formulation  = Formulation::standard);

  /// Return n.
  unsigned int n_nodes() const { return nodes.size(); }

  /// Compute K (n*dim x n*dim, row by row), exactly symmetric [force / length].
  void stiffness(const Nodes &X, const Material &material, std::vector<double> &K) const;

  /**
   * Compute K (30 x 30) of a tetrahedron with the ten nodes @p X of mesh::Tetrahedron, the sum of
   * T'K T over its four cells. Four points are exact if the edges are straight; otherwise the
   * points are those of the cells, such that all terms of curved elements use the same rule. Only
   * for dim = 3, degree = 2 and the standard formulation.
   */
  void
  stiffness_of_tetrahedron(const Nodes &X, const Material &material, std::vector<double> &K) const;

  /// Return the Gauss points of a cell, or of the four cells of a tetrahedron with the functions of
  /// its ten nodes.
  const std::vector<mesh::LagrangePoint<dim>> &points() const { return gauss; }
  const std::vector<mesh::LagrangePoint<dim>> &points_of_tetrahedron() const
  {
    return of_tetrahedra.points;
  }

  /// Return whether the formulation acts in each cell.
  bool is_mixed() const { return formulation != Formulation::standard; }

  /// Compute r = K(X) u.
  void internal_force(const Nodes &X, const Material &material, const Nodes &u, Nodes &r) const;

  /// Return K'(X; V) u of every velocity V, exact.
  std::vector<Nodes> internal_force_derivatives(const Nodes              &X,
                                                const std::vector<Nodes> &velocities,
                                                const Material           &material,
                                                const Nodes              &u) const;

  /// Compute gradient_a += factor * d/dX_a (w' K(X) u). At each Gauss point the gradient is dV E
  /// g_a with E = (sigma_u:grad w - theta_u p_w) I - (grad w)^T sigma_u - (grad u)^T sigma_w and
  /// theta_u of PointState.
  void add_energy_gradient(const Nodes    &X,
                           const Material &material,
                           const Nodes    &u,
                           const Nodes    &w,
                           double          factor,
                           Nodes          &gradient) const;

  /// Return the n Gauss points of a cell with nodes X.
  Nodes quadrature_points(const Nodes &X) const;

  /// Compute f_a = int N_a b dV for a body force @p b [force / length^3] given at the Gauss points.
  /// The body force is fixed to the material.
  void body_force(const Nodes &X, const Nodes &b, Nodes &f) const;

  /// Compute f = derivative of body_force() along V, exact.
  void body_force_derivative(const Nodes &X, const Nodes &V, const Nodes &b, Nodes &f) const;

  /// Compute gradient_a += factor * d/dX_a (f(X) . u).
  void add_body_force_gradient(const Nodes &X,
                               const Nodes &b,
                               const Nodes &u,
                               double       factor,
                               Nodes       &gradient) const;

  /// Compute the load f of a thermal strain, f . w = int beta e div w dV.
  void thermal_force(const Nodes              &X,
                     const Material           &material,
                     const ThermalStrain<dim> &thermal,
                     Nodes                    &f) const;

  /// Compute f = derivative of thermal_force() along V, exact.
  void thermal_force_derivative(const Nodes              &X,
                                const Nodes              &V,
                                const Material           &material,
                                const ThermalStrain<dim> &thermal,
                                Nodes                    &f) const;

  /// Compute gradient_a += factor * d/dX_a (f(X) . w) of the load of a thermal strain.
  void add_thermal_force_gradient(const Nodes              &X,
                                  const Material           &material,
                                  const ThermalStrain<dim> &thermal,
                                  const Nodes              &w,
                                  double                    factor,
                                  Nodes                    &gradient) const;

  /// Return the energy of the undeformed cell, 1/2 int e I : C e I dV, which the elastic energy
  /// contains besides 1/2 u'Ku - f . u.
  double
  thermal_energy(const Nodes &X, const Material &material, const ThermalStrain<dim> &thermal) const;

  /// Compute gradient_a += factor * d thermal_energy() / dX_a.
  void add_thermal_energy_gradient(const Nodes              &X,
                                   const Material           &material,
                                   const ThermalStrain<dim> &thermal,
                                   double                    factor,
                                   Nodes                    &gradient) const;

  /// Return int dV [length^3], signed.
  double volume(const Nodes &X) const;

  /// Compute gradient_a += factor * d volume / dX_a.
  void add_volume_gradient(const Nodes &X, double factor, Nodes &gradient) const;

  /// Return the Cauchy stress at points of the reference cube [0,1]^dim. @p shapes are the
  /// functions of degree p at the points. In the standard formulation, X, u and the functions may
  /// also be those of a tetrahedron.
  Stresses stresses(const Nodes                                 &X,
                    const Material                              &material,
                    const Nodes                                 &u,
                    const std::vector<mesh::LagrangePoint<dim>> &shapes,
                    const ThermalStrain<dim>                    &thermal = {}) const;

  /// Return the Cauchy stresses of several displacements, which share the geometry of the points.
  std::vector<Stresses> stresses(const Nodes                                 &X,
                                 const Material                              &material,
                                 const std::vector<Strained>                 &fields,
                                 const std::vector<mesh::LagrangePoint<dim>> &shapes) const;

  /**
   * Return the quality of the cell: the minimum det J over Gauss points and nodes, divided by the
   * mean of |det J| over the cell. It is 1 for a parallelepiped, <= 0 for a tangled cell, and 0
   * for a cell without volume, with NaN positions, or, if axisymmetric, at negative radius.
   */
  double quality(const Nodes &X) const { return qualities(X).first; }

  /**
   * Return the minimum of det J / prod_d |J e_d| over Gauss points and nodes. It is 1 where the
   * coordinate lines of the cell meet at right angles, whatever its lengths. It is <= 0 for a
   * tangled cell, and 0 for a cell without volume or with NaN positions.
   *
   * Source: Knupp, SIAM J. Sci. Comput. 23 (2001).
   */
  double scaled_jacobian(const Nodes &X) const { return qualities(X).second; }

  /// Return quality() and scaled_jacobian(), in half of the time of both.
  std::pair<double, double> qualities(const Nodes &X) const;

  /// Return the aspect ratio: the maximum ratio, over the Gauss points, of the lengths of the
  /// cell along two of its axes; 1 for squares and cubes.
  double aspect(const Nodes &X) const;

  /// Return sum ((1 - q) / scale)^p over Gauss points and nodes with q = det J / prod_d |J e_d|,
  /// p >= 1. It is 0 where the coordinate lines meet at right angles.
  double distortion(const Nodes &X, double p, double scale) const;

  /// Compute gradient_a += factor * d distortion / dX_a.
  void add_distortion_gradient(const Nodes &X,
                               double       p,
                               double       scale,
                               double       factor,
                               Nodes       &gradient) const;

private:
  /// Values of a displacement at a point.
  struct PointState
  {
    dealii::Tensor<2, 3>          gradient;
    double                        theta; ///< p_u / kappa - div u
    dealii::SymmetricTensor<2, 3> stress;
  };

  std::vector<CellPoint<dim>> gauss_points(const Nodes &X) const;

  /// Replace the values of div u at the points of a cell by their values in the formulation.
  void take_dilatation(const std::vector<CellPoint<dim>> &points,
                       std::vector<double>               &values) const;

  /// Return the thermal strains at the points of a cell in the formulation.
  std::vector<double> thermal_strains(const std::vector<CellPoint<dim>> &points,
                                      const ThermalStrain<dim>          &thermal) const;

  /// Subtract the thermal stresses from the @p stresses at the last ones of the points of a cell.
  void subtract_thermal(const std::vector<CellPoint<dim>>          &points,
                        const Material                             &material,
                        const ThermalStrain<dim>                   &thermal,
                        std::vector<dealii::SymmetricTensor<2, 3>> &stresses) const;

  Stresses projected_stresses(const Nodes                                 &X,
                              const Material                              &material,
                              const Strained                              &field,
                              const std::vector<mesh::LagrangePoint<dim>> &shapes) const;

  std::vector<PointState> point_states(const std::vector<CellPoint<dim>> &points,
                                       const Material                    &material,
                                       const Nodes                       &u) const;

  /// Points with the functions of n nodes.
  struct Rule
  {
    std::vector<mesh::LagrangePoint<dim>> points;
    /// dN_a / d xi_d at the points, [point][d][a], with a padded with zeros to a multiple of 4.
    /// stiffness() vectorizes over this layout.
    std::vector<double> gradients;

    Rule() = default;
    explicit Rule(std::vector<mesh::LagrangePoint<dim>> points);
  };

  static Rule rule_of_straight_tetrahedra();
  /// Return the Gauss points of the four cells.
  static Rule rule_of_tetrahedra();

  template <int n_nodes, int n_points, bool axisymmetric>
  void compute_stiffness(const Rule          &rule,
                         const Nodes         &X,
                         const Material      &material,
                         std::vector<double> &K) const;

  unsigned int                          degree;
  mesh::Idealization                    idealization;
  Formulation                           formulation;
  std::vector<mesh::LagrangePoint<dim>> gauss;
  std::vector<mesh::LagrangePoint<dim>> nodes;
  Rule                                  of_cells;
  Rule                                  of_straight, of_tetrahedra; ///< in 3D, degree 2
};
} // namespace snug::elasticity

#endif
