#ifndef snug_elasticity_local_error_h
#define snug_elasticity_local_error_h

#include <snug/elasticity/element.h>

#include <deal.II/lac/lapack_full_matrix.h>

namespace snug::elasticity {
/**
 * The functions that extend the polynomials of degree p = 1 or 2 on a cell to degree p + 1. They
 * are products of functions of one coordinate: b at least once and otherwise the Lagrange
 * functions of degree p, with b = s (1-s) for p = 1 and s (1-s) (1-2s) for p = 2. In 3D only
 * products with b once are used.
 */
template <int dim>
class HigherFunctions
{
public:
  struct Value
  {
    double                 value;
    dealii::Tensor<1, dim> gradient; ///< gradient with respect to the reference coordinates
  };

  explicit HigherFunctions(unsigned int degree);

  /// Return the number of functions: 5 or 7 in 2D, 12 or 27 in 3D.
  unsigned int size() const { return factors.size(); }

  /// Return all functions at a point of the reference cell.
  std::vector<Value> at(const dealii::Point<dim> &point) const;

  /// Return whether function i differs from zero on face 2d + s of the cell.
  bool is_on_face(unsigned int i, unsigned int face) const;

private:
  unsigned int                               degree;
  std::vector<std::array<unsigned int, dim>> factors; ///< per axis: node, or degree + 1 for b
};

/// Orthonormal directions in which the functions on each face of a cell are held.
template <int dim>
using HeldFaces = std::array<std::vector<dealii::Tensor<1, dim>>, 2 * dim>;

/// Data shared by the local problems of all cells of a body: the space V of LocalError without
/// held directions, and the integration points.
template <int dim>
struct LocalSpace
{
  using Functions = std::vector<typename HigherFunctions<dim>::Value>;

  LocalSpace(unsigned int degree, const mesh::Idealization &idealization, Formulation formulation);

  /// Return the number of vector functions.
  unsigned int size() const { return dim * functions.size(); }

  unsigned int                          degree;
  mesh::Idealization                    idealization;
  Formulation                           formulation;
  HigherFunctions<dim>                  functions;
  std::vector<mesh::LagrangePoint<dim>> quadrature; ///< points with functions of degree p
  std::vector<Functions>                at_quadrature;
};

/// A linear functional on V, function by function and component by component within a function.
using LocalResidual = std::vector<double>;

/// Compute r += @p force . v, where the functions have the @p values. @p force is a traction
/// times its share of dA.
template <int dim>
void add_force(const typename LocalSpace<dim>::Functions &values,
               const dealii::Tensor<1, dim>              &force,
               LocalResidual                             &r);

/**
 * The local problem of Bank and Weiser in a cell. The error e of a displacement u_h lies in the
 * space V of vectors of HigherFunctions that vanish along held directions. It is the solution of
 * @f[ a(e, v) = \int_K (b \cdot v - \sigma_h : \varepsilon(v))\,dV
 *     + \int_{\partial K} t \cdot v\,dA \quad\text{for all } v \in V, @f]
 * with the bilinear form a of the cell and tractions t that balance between cells. |e|^2 = a(e,
 * e) summed over cells estimates the square of the error in the energy norm. V contains no rigid
 * motion, so the matrix is positive definite.
 *
 * B-bar is a mixed method. Its pressures p_h = kappa Pi div u_h have errors q. They are sought
 * among the polynomials of one degree more (projection Pi_+):
 * @f[ q = \kappa(\Pi_+ \mathrm{div}\, e + d),\quad d = (\Pi_+ - \Pi)\,\mathrm{div}\, u_h,\quad
 *     a_+(e, v) = r(v) - \kappa\,(d, \mathrm{div}\, v), @f]
 * where a_+ projects dilatations with Pi_+ and r is the right-hand side above. The error of a
 * functional by two such problems is the product a_+(e_1, e_2) - kappa (d_1, d_2). The square of
 * the norm of the error of the stress is a_+(e, e) + kappa (d, 2 div e + d).
 *
 * Source: Bank, Weiser, Math. Comp. 44 (1985) 283.
 */
template <int dim>
class LocalError
{
public:
  using Nodes    = std::vector<dealii::Tensor<1, dim>>;
  using Stresses = std::vector<dealii::SymmetricTensor<2, 3>>;

  /// Construct the problem of a cell with nodes @p X. The space must outlive this object.
  LocalError(const LocalSpace<dim> &space,
             const Nodes           &X,
             const Material        &material,
             const HeldFaces<dim>  &held);

  /// Return whether another cell has the same problem up to rounding. It does if the cell is a
  /// translated copy, at the same radius if there is one.
  bool fits(const LocalSpace<dim> &space,
            const Nodes           &X,
            const Material        &material,
            const HeldFaces<dim>  &held) const;

  /// Compute r += int (b . v - sigma : eps(v)) dV for stresses and body forces at the quadrature
  /// points. An empty b stands for zero.
  void add_residual(const Stresses &sigma, const Nodes &b, LocalResidual &r) const;

  /// Replace @p r by the solution e of a(e, v) = r(v).
  void solve(LocalResidual &r) const;

  /// Return d of the displacement @p u of the cell's nodes, times kappa^(1/2), in an orthonormal
  /// basis. The result is empty except for B-bar.
  std::vector<double> missing_dilatation(const Nodes &u) const;

  /// Return (d, div e) kappa for d of missing_dilatation().
  double dilatation_work(const std::vector<double> &d, const LocalResidual &e) const;

  /// Compute r(v) -= kappa (d, div v) for d of missing_dilatation().
  void subtract_dilatation(const std::vector<double> &d, LocalResidual &r) const;

private:
  /// Value of a function of V at a point in space.
  struct Value
  {
    dealii::Tensor<1, dim> gradient;
    double                 hoop; ///< value / r, or 0

    /// Return the divergence of the function times the unit vector @p c.
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
  /// kappa^(1/2) times the functions in the range of Pi_+ but not of Pi, times dV, at the points
  std::vector<std::vector<double>> missing;
  std::vector<LocalResidual> missing_rows; ///< products of the functions in `missing` with div v

  std::vector<double>              matrix();
  std::vector<double>              matrix(double lambda, double mu) const;
  dealii::LAPACKFullMatrix<double> gradient_products() const;
  void                             add_projected(double factor, std::vector<double> &A);
  void                             find_basis();
};
} // namespace snug::elasticity

#endif
