#ifndef snug_elasticity_local_error_h
#define snug_elasticity_local_error_h

#include <snug/elasticity/element.h>

namespace snug::elasticity {
/**
 * What polynomials of degree p + 1 on a cell have that those of degree p = 1 or 2 have not:
 * products of functions of one coordinate, b at least once and else the Lagrange functions of
 * degree p, b = s (1-s) for p = 1 and s (1-s) (1-2s) for p = 2. In 3D only those with b once.
 */
template <int dim>
class HigherFunctions
{
public:
  struct Value
  {
    double                 value;
    dealii::Tensor<1, dim> gradient; ///< by the reference coordinates
  };

  explicit HigherFunctions(unsigned int degree);

  /// 5 or 7 in 2D, 12 or 27 in 3D.
  unsigned int size() const { return factors.size(); }

  /// All at a point of the reference cell.
  std::vector<Value> at(const dealii::Point<dim> &point) const;

  /// Whether function i is other than zero on face 2d + s of the cell.
  bool is_on_face(unsigned int i, unsigned int face) const;

private:
  unsigned int                               degree;
  std::vector<std::array<unsigned int, dim>> factors; ///< per axis a node or b, degree + 1
};

/// Directions in which the functions on each face of a cell are held, orthonormal.
template <int dim>
using HeldFaces = std::array<std::vector<dealii::Tensor<1, dim>>, 2 * dim>;

/**
 * The local problems of Bank and Weiser: the error e of a displacement u_h
 * in a cell, in the space V of vectors of HigherFunctions that vanish along held
 * directions, is the solution of
 * @f[ a(e, v) = \int_K (b \cdot v - \sigma_h : \varepsilon(v))\,dV
 *     + \int_{\partial K} t \cdot v\,dA \quad\text{for all } v \in V, @f]
 * with the cell's own form a, B-bar included, and tractions t that balance
 * between cells. |e|^2 = a(e, e) summed over cells estimates the energy norm of
 * the error squared. V has no rigid motion, so the matrix is positive definite.
 * Source: Bank, Weiser, Math. Comp. 44 (1985) 283.
 */
template <int dim>
class LocalError
{
public:
  using Nodes = std::vector<dealii::Tensor<1, dim>>;
  /// A linear function of V, component by component of function by function.
  using Residual = std::vector<double>;

  LocalError(unsigned int degree, const mesh::Idealization &idealization, Formulation formulation);

  const HigherFunctions<dim> &functions() const { return higher; }
  unsigned int                size() const { return dim * higher.size(); }

  /// Points of a cell with nodes @p X at which body forces are given.
  Nodes quadrature_points(const Nodes &X) const;

  /// r += int (b . v - sigma_h : eps(v)) dV for the displacement @p u of a cell with nodes
  /// @p X and the body force @p b at the quadrature points; empty: none.
  void add_residual(const Nodes    &X,
                    const Material &material,
                    const Nodes    &u,
                    const Nodes    &b,
                    double         *r) const;

  /// r += @p force . v at @p point of the reference cell, a traction times its part of dA.
  void
  add_force(const dealii::Point<dim> &point, const dealii::Tensor<1, dim> &force, double *r) const;

  /// Solutions e of a(e, v) = r(v) in place of the columns of @p r.
  void solve(const Nodes           &X,
             const Material        &material,
             const HeldFaces<dim>  &held,
             std::vector<Residual> &r) const;

private:
  unsigned int                          degree;
  mesh::Idealization                    idealization;
  Formulation                           formulation;
  Element<dim>                          element;
  HigherFunctions<dim>                  higher;
  std::vector<mesh::LagrangePoint<dim>> quadrature; ///< functions of degree p

  std::vector<double> matrix(const Nodes &X, const Material &material) const;
};
} // namespace snug::elasticity

#endif
