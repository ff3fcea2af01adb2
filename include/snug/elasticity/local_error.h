#ifndef snug_elasticity_local_error_h
#define snug_elasticity_local_error_h

#include <snug/elasticity/element.h>

#include <deal.II/lac/lapack_full_matrix.h>

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

/// What the local problems of all cells of a body have in common: the space V of LocalError
/// but for what is held, and the points where integrals are taken.
template <int dim>
struct LocalSpace
{
  using Functions = std::vector<typename HigherFunctions<dim>::Value>;

  LocalSpace(unsigned int degree, const mesh::Idealization &idealization, Formulation formulation);

  /// Of vectors with these functions.
  unsigned int size() const { return dim * functions.size(); }

  unsigned int                          degree;
  mesh::Idealization                    idealization;
  Formulation                           formulation;
  HigherFunctions<dim>                  functions;
  std::vector<mesh::LagrangePoint<dim>> quadrature; ///< with functions of degree p
  std::vector<Functions>                at_quadrature;
};

/// A linear function of V, component by component of function by function.
using LocalResidual = std::vector<double>;

/// r += @p force . v where the functions are @p values, a traction times its part of dA.
template <int dim>
void add_force(const typename LocalSpace<dim>::Functions &values,
               const dealii::Tensor<1, dim>              &force,
               LocalResidual                             &r);

/**
 * The local problem of Bank and Weiser in a cell: the error e of a displacement u_h,
 * in the space V of vectors of HigherFunctions that vanish along held
 * directions, is the solution of
 * @f[ a(e, v) = \int_K (b \cdot v - \sigma_h : \varepsilon(v))\,dV
 *     + \int_{\partial K} t \cdot v\,dA \quad\text{for all } v \in V, @f]
 * with the cell's own form a and tractions t that balance between cells.
 * |e|^2 = a(e, e) summed over cells estimates the energy norm of the error
 * squared. V has no rigid motion, so the matrix is positive definite.
 *
 * B-bar is a mixed method, whose pressures p_h = kappa Pi div u_h have errors q of their
 * own. They are sought among the polynomials of one degree more (projection Pi_+):
 * @f[ q = \kappa(\Pi_+ \mathrm{div}\, e + d),\quad d = (\Pi_+ - \Pi)\,\mathrm{div}\, u_h,\quad
 *     a_+(e, v) = r(v) - \kappa\,(d, \mathrm{div}\, v), @f]
 * where a_+ projects dilatations with Pi_+ and r is the right-hand side above. The error of a
 * functional by two such problems is the product a_+(e_1, e_2) - kappa (d_1, d_2), and the
 * norm of the error of the stress a_+(e, e) + kappa (d, 2 div e + d), squared.
 * Source: Bank, Weiser, Math. Comp. 44 (1985) 283.
 */
template <int dim>
class LocalError
{
public:
  using Nodes    = std::vector<dealii::Tensor<1, dim>>;
  using Stresses = std::vector<dealii::SymmetricTensor<2, 3>>;

  /// Of a cell with nodes @p X. The space must outlive this.
  LocalError(const LocalSpace<dim> &space,
             const Nodes           &X,
             const Material        &material,
             const HeldFaces<dim>  &held);

  /// Whether another cell has the same problem but for rounding: it is this one moved to another
  /// place, at the same radius if there is one.
  bool fits(const LocalSpace<dim> &space,
            const Nodes           &X,
            const Material        &material,
            const HeldFaces<dim>  &held) const;

  /// r += int (b . v - sigma : eps(v)) dV for stresses and body forces at the quadrature points; no
  /// b: none.
  void add_residual(const Stresses &sigma, const Nodes &b, LocalResidual &r) const;

  /// The solution e of a(e, v) = r(v) in place of @p r.
  void solve(LocalResidual &r) const;

  /// d of the displacement @p u of the cell's nodes, times kappa^(1/2), in an orthonormal
  /// basis; empty but for B-bar.
  std::vector<double> missing_dilatation(const Nodes &u) const;

  /// (d, div e) kappa for one given so.
  double dilatation_work(const std::vector<double> &d, const LocalResidual &e) const;

  /// r(v) -= kappa (d, div v) for one given so.
  void subtract_dilatation(const std::vector<double> &d, LocalResidual &r) const;

private:
  /// A function of V at a point in space.
  struct Value
  {
    dealii::Tensor<1, dim> gradient;
    double                 hoop; ///< value / r, or 0

    /// of the function times the unit vector @p c
    double divergence(unsigned int c) const { return gradient[c] + (c == 0 ? hoop : 0.); }
  };

  const LocalSpace<dim>          &space;
  const Nodes                     X;
  const Material                  material;
  const HeldFaces<dim>            held;
  std::vector<std::vector<Value>> at; ///< [point][function]
  std::vector<double>             dV;
  /// basis of V: function and direction
  std::vector<std::pair<unsigned int, dealii::Tensor<1, dim>>> basis;
  dealii::LAPACKFullMatrix<double>                             factor;
  /// kappa^(1/2) times functions that Pi_+ has and Pi has not, times dV, at the points
  std::vector<std::vector<double>> missing;
  std::vector<LocalResidual>       missing_rows; ///< and their products with div v

  std::vector<double> matrix();
  std::vector<double> matrix(double lambda, double mu) const;
  void                add_projected(double factor, std::vector<double> &A);
  void                find_basis();
};
} // namespace snug::elasticity

#endif
