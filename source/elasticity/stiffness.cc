#include <snug/base/assertions.h>
#include <snug/elasticity/element.h>
#include <snug/elasticity/pressure_space.h>
#include <snug/elasticity/stress.h>
#include <snug/mesh/tetrahedron.h>

#include <deal.II/base/utilities.h>

#include <cmath>

namespace snug::elasticity {
namespace {
/**
 * K of one element with all loop bounds known to the compiler.
 *
 * The material is constant in the cell, so that the quadrature reduces
 * to one symmetric product
 *   H_(ca)(db) = sum_q dV_q g_a,c g_b,d
 * after which
 *   K_(ac)(bd) = lambda H_(ca)(db) + mu H_(da)(cb)
 *                + mu delta_cd sum_e H_(ea)(eb).
 * Index (ca) = c * n_padded + a; n_padded is a multiple of the tile size,
 * so H is computed in square tiles that stay in registers.
 *
 * Axisymmetric: one more direction, g_a,2 = N_a / r, the hoop strain of
 * component 0.
 */
template <int dim, int n_nodes, int n_points, bool axisymmetric>
class StiffnessKernel
{
public:
  static constexpr int tile         = 4;
  static constexpr int n_directions = axisymmetric ? dim + 1 : dim;
  static constexpr int n            = n_nodes;
  static constexpr int n_gauss      = n_points;
  static constexpr int n_padded     = (n + tile - 1) / tile * tile;
  static constexpr int n_rows       = n_directions * n_padded;
  static constexpr int N            = n * dim; ///< unknowns

  /// Compute the gradients. @p reference: [point][d][a] as in Element.
  void compute_gradients(const std::vector<dealii::Tensor<1, dim>>   &X,
                         const std::vector<mesh::LagrangePoint<dim>> &gauss,
                         const double                                *reference,
                         const mesh::Idealization                    &idealization);

  /// Compute H on and above its diagonal tiles.
  void compute_products();

  /// Compute K from H.
  void combine(double lambda, double mu, double *K) const;

  /// Add the terms of the hoop strain to K.
  void add_hoop(double lambda, double mu, double *K) const;

  /// Compute K += kappa sum_i c_i c_i' of an Element of the degree.
  void add_projected(unsigned int                                 degree,
                     double                                       kappa,
                     const std::vector<mesh::LagrangePoint<dim>> &gauss,
                     double                                      *K) const;

private:
  double positions[dim][n_padded];
  double volumes[n_gauss]; ///< dV
  double gradients[n_gauss][n_rows];
  double weighted[n_gauss][n_rows]; ///< dV times gradients
  double products[n_rows][n_rows];  ///< H

  dealii::Tensor<2, dim> jacobian(const double *reference) const;
};

template <int dim, int n_nodes, int n_points, bool axisymmetric>
dealii::Tensor<2, dim>
StiffnessKernel<dim, n_nodes, n_points, axisymmetric>::jacobian(const double *reference) const
{
  dealii::Tensor<2, dim> J;
  for (int c = 0; c < dim; ++c)
    for (int d = 0; d < dim; ++d)
      {
        // Use independent sums, which the compiler keeps in one vector register. One running sum
        // could not be vectorized, because that would change the order of the additions.
        double sums[tile] = {};
        for (int a = 0; a < n_padded; a += tile)
          for (int i = 0; i < tile; ++i)
            sums[i] += positions[c][a + i] * reference[d * n_padded + a + i];
        J[c][d] = (sums[0] + sums[1]) + (sums[2] + sums[3]);
      }
  return J;
}

template <int dim, int n_nodes, int n_points, bool axisymmetric>
void StiffnessKernel<dim, n_nodes, n_points, axisymmetric>::compute_gradients(
  const std::vector<dealii::Tensor<1, dim>>   &X,
  const std::vector<mesh::LagrangePoint<dim>> &gauss,
  const double                                *reference,
  const mesh::Idealization                    &idealization)
{
  // Use positions relative to the first node, so that congruent cells with bitwise equal
  // differences have the same K.
  for (int c = 0; c < dim; ++c)
    for (int a = 0; a < n_padded; ++a)
      positions[c][a] = a < n ? X[a][c] - X[0][c] : 0.;

  for (int q = 0; q < n_gauss; ++q, reference += dim * n_padded)
    {
      const dealii::Tensor<2, dim> J       = jacobian(reference);
      const dealii::Tensor<2, dim> inverse = invert(J);
      volumes[q]                           = gauss[q].weight * determinant(J);
      for (int c = 0; c < dim; ++c)
        for (int a = 0; a < n_padded; ++a)
          {
            double g = 0.;
            for (int d = 0; d < dim; ++d)
              g += inverse[d][c] * reference[d * n_padded + a];
            // Padded entries are zero, because the reference gradients are zero there.
            gradients[q][c * n_padded + a] = g;
          }
      if (dim == 2)
        {
          const auto x = value(gauss[q], X);
          // The computation is that of CellPoint, with the same results up to rounding.
          volumes[q] *= idealization.weight(x);
          if (axisymmetric)
            for (int a = 0; a < n_padded; ++a)
              gradients[q][n_rows - n_padded + a] = a < n ? gauss[q].value[a] / x[0] : 0.;
        }
      // One factor of each product contains dV, so that H is a plain product of two arrays.
      for (int row = 0; row < n_rows; ++row)
        weighted[q][row] = volumes[q] * gradients[q][row];
    }
}

/// Compute the products H. This takes nearly all of the time: n_rows^2/2 products of n_gauss terms.
template <int dim, int n_nodes, int n_points, bool axisymmetric>
void StiffnessKernel<dim, n_nodes, n_points, axisymmetric>::compute_products()
{
  // Process one tile at a time over all Gauss points: its 16 sums fit in registers.
  for (int I = 0; I < n_rows; I += tile)
    // H is symmetric, so tiles below the diagonal are never read.
    for (int J = I; J < n_rows; J += tile)
      {
        double H[tile][tile] = {};
        for (int q = 0; q < n_gauss; ++q)
          for (int i = 0; i < tile; ++i)
            for (int j = 0; j < tile; ++j)
              H[i][j] += weighted[q][I + i] * gradients[q][J + j];
        for (int i = 0; i < tile; ++i)
          for (int j = 0; j < tile; ++j)
            products[I + i][J + j] = H[i][j];
      }
}

template <int dim, int n_nodes, int n_points, bool axisymmetric>
void StiffnessKernel<dim, n_nodes, n_points, axisymmetric>::combine(const double lambda,
                                                                    const double mu,
                                                                    double      *K) const
{
  const auto set = [K](const int row, const int column, double value) {
    // Both entries receive the same number, so K is symmetric to the last bit.
    K[row * N + column] = value;
    K[column * N + row] = value;
  };
  for (int a = 0; a < n; ++a)
    for (int b = a; b < n; ++b)
      {
        double trace = 0.;
        for (int c = 0; c < dim; ++c)
          trace += products[c * n_padded + a][c * n_padded + b];
        for (int c = 0; c < dim; ++c)
          {
            set(a * dim + c, b * dim + c,
                (lambda + mu) * products[c * n_padded + a][c * n_padded + b] + mu * trace);
            for (int d = c + 1; d < dim; ++d)
              {
                const double H_cd = products[c * n_padded + a][d * n_padded + b];
                const double H_dc = products[c * n_padded + b][d * n_padded + a];
                set(a * dim + c, b * dim + d, lambda * H_cd + mu * H_dc);
                set(a * dim + d, b * dim + c, lambda * H_dc + mu * H_cd);
              }
          }
      }
}

template <int dim, int n_nodes, int n_points, bool axisymmetric>
void StiffnessKernel<dim, n_nodes, n_points, axisymmetric>::add_hoop(const double lambda,
                                                                     const double mu,
                                                                     double      *K) const
{
  constexpr int hoop = n_rows - n_padded; // its first row in H
  const auto    add  = [K](const int row, const int column, double value) {
    K[row * N + column] += value;
    K[column * N + row] = K[row * N + column];
  };
  for (int a = 0; a < n; ++a)
    for (int b = a; b < n; ++b)
      {
        // The hoop strain u_r/r contributes to div u and to the strains: lambda (div w)(div u)
        // + 2 mu e:e.
        const double radial = products[a][hoop + b] + products[b][hoop + a];
        add(a * dim, b * dim, lambda * radial + (lambda + 2. * mu) * products[hoop + a][hoop + b]);
        add(a * dim, b * dim + 1, lambda * products[n_padded + b][hoop + a]);
        // Skip a = b, because otherwise the same entry would be added twice.
        if (a != b)
          add(a * dim + 1, b * dim, lambda * products[n_padded + a][hoop + b]);
      }
}

template <int dim, int n_nodes, int n_points, bool axisymmetric>
void StiffnessKernel<dim, n_nodes, n_points, axisymmetric>::add_projected(
  const unsigned int                           degree,
  const double                                 kappa,
  const std::vector<mesh::LagrangePoint<dim>> &gauss,
  double                                      *K) const
{
  // c_i' u = int psi_i div u dV. The factor sqrt(kappa) in both factors keeps K symmetric to the
  // last bit.
  std::vector<dealii::Point<dim>> xi;
  for (const auto &shape : gauss)
    xi.push_back(shape.point);
  const PressureSpace<dim> space(degree, xi, std::vector<double>(volumes, volumes + n_gauss));
  for (const auto &psi : space.functions())
    {
      double c[N] = {};
      for (int q = 0; q < n_gauss; ++q)
        {
          const double factor = std::sqrt(kappa) * psi[q];
          for (int a = 0; a < n; ++a)
            {
              for (int d = 0; d < dim; ++d)
                c[a * dim + d] += factor * weighted[q][d * n_padded + a];
              if (axisymmetric)
                c[a * dim] += factor * weighted[q][n_rows - n_padded + a];
            }
        }
      for (int row = 0; row < N; ++row)
        for (int column = 0; column < N; ++column)
          K[row * N + column] += c[row] * c[column];
    }
}

/// Return whether the middles of all edges lie in the middle up to round-off.
bool is_straight(const std::vector<dealii::Tensor<1, 3>> &X)
{
  const double round_off = 1e-13;
  for (unsigned int a = 0; a < 4; ++a)
    for (unsigned int b = 0; b < a; ++b)
      if ((X[mesh::Tetrahedron::middle(a, b)] - 0.5 * (X[a] + X[b])).norm() >
          round_off * (X[a] - X[b]).norm())
        return false;
  return true;
}
} // namespace

template <int dim>
Element<dim>::Rule::Rule(std::vector<mesh::LagrangePoint<dim>> of_points)
  : points(std::move(of_points))
{
  // Use a multiple of the tile size of StiffnessKernel. The zeros add nothing.
  const std::size_t n = points.front().gradient.size(), n_padded = (n + 3) / 4 * 4;
  for (const auto &shape : points)
    for (unsigned int d = 0; d < dim; ++d)
      for (std::size_t a = 0; a < n_padded; ++a)
        gradients.push_back(a < n ? shape.gradient[a][d] : 0.);
}

/// The coordinates are the barycentric coordinates of corners 1, 2 and 3. The rule is exact for
/// degree 2, that of the products of gradients.
template <int dim>
typename Element<dim>::Rule Element<dim>::rule_of_straight_tetrahedra()
{
  std::vector<mesh::LagrangePoint<dim>> points(4);
  for (unsigned int q = 0; q < 4; ++q)
    {
      double lambda[4];
      for (unsigned int a = 0; a < 4; ++a)
        lambda[a] = (5. + (a == q ? 3. : -1.) * std::sqrt(5.)) / 20.;
      const auto add = [&](const unsigned int node, const unsigned int a, const double slope) {
        for (unsigned int d = 0; d < dim; ++d)
          points[q].gradient[node][d] += slope * ((a == d + 1 ? 1. : 0.) - (a == 0 ? 1. : 0.));
      };
      points[q].weight = 1. / 24.;
      points[q].gradient.resize(10);
      for (unsigned int a = 0; a < 4; ++a)
        {
          add(a, a, 4. * lambda[a] - 1.);
          for (unsigned int b = 0; b < 4; ++b)
            if (a != b)
              add(mesh::Tetrahedron::middle(a, b), a, 4. * lambda[b]);
        }
    }
  return Rule(points);
}

template <int dim>
typename Element<dim>::Rule Element<dim>::rule_of_tetrahedra()
{
  std::vector<mesh::LagrangePoint<dim>> points;
  for (unsigned int corner = 0; corner < 4; ++corner)
    for (const auto &at : mesh::lagrange_gauss_points<dim>(2))
      {
        const auto &T = mesh::tetrahedron_functions(corner);
        points.emplace_back();
        points.back().weight = at.weight;
        points.back().value.resize(10);
        points.back().gradient.resize(10);
        for (unsigned int i = 0; i < at.gradient.size(); ++i)
          for (unsigned int a = 0; a < 10; ++a)
            {
              points.back().value[a] += T[i * 10 + a] * at.value[i];
              points.back().gradient[a] += T[i * 10 + a] * at.gradient[i];
            }
      }
  return Rule(points);
}

template <int dim>
template <int n_nodes, int n_points, bool axisymmetric>
void Element<dim>::compute_stiffness(const Rule          &rule,
                                     const Nodes         &X,
                                     const Material      &material,
                                     std::vector<double> &K) const
{
  // The kernel is on the stack, with sizes known to the compiler: about 0.1 MB for 27 nodes in 3D.
  using Kernel = StiffnessKernel<dim, n_nodes, n_points, axisymmetric>;
  SNUG_ASSERT_EQUAL(X.size(), Kernel::n);
  SNUG_ASSERT_EQUAL(rule.gradients.size(), Kernel::n_gauss * dim * Kernel::n_padded);
  K.resize(Kernel::N * Kernel::N);
  const double mu = material.lame_mu();
  const double lambda =
    // lambda = -2/3 mu leaves 2 mu dev e : dev e, and the projection adds the dilatation.
    formulation == Formulation::B_bar ? -2. / 3. * mu : lame_lambda(idealization, material);

  Kernel kernel;
  kernel.compute_gradients(X, rule.points, rule.gradients.data(), idealization);
  kernel.compute_products();
  kernel.combine(lambda, mu, K.data());
  if (axisymmetric)
    kernel.add_hoop(lambda, mu, K.data());
  if (formulation == Formulation::B_bar)
    kernel.add_projected(degree, material.bulk_modulus(), rule.points, K.data());
}

template <int dim>
void Element<dim>::stiffness(const Nodes &X, const Material &material, std::vector<double> &K) const
{
  constexpr int n_linear = 1 << dim, n_quadratic = dim == 2 ? 9 : 27;
  if constexpr (dim == 2) // solids are never axisymmetric
    if (idealization.is_axisymmetric())
      {
        degree == 1 ? compute_stiffness<n_linear, n_linear, true>(of_cells, X, material, K)
                    : compute_stiffness<n_quadratic, n_quadratic, true>(of_cells, X, material, K);
        return;
      }
  degree == 1 ? compute_stiffness<n_linear, n_linear, false>(of_cells, X, material, K)
              : compute_stiffness<n_quadratic, n_quadratic, false>(of_cells, X, material, K);
}

template <int dim>
void Element<dim>::stiffness_of_tetrahedron(const Nodes         &X,
                                            const Material      &material,
                                            std::vector<double> &K) const
{
  SNUG_ASSERT(formulation == Formulation::standard, "cells of tetrahedra have projections");
  if constexpr (dim == 3)
    is_straight(X) ? compute_stiffness<10, 4, false>(of_straight, X, material, K)
                   : compute_stiffness<10, 108, false>(of_tetrahedra, X, material, K);
}

template void Element<2>::stiffness(const Nodes &, const Material &, std::vector<double> &) const;
template void Element<3>::stiffness(const Nodes &, const Material &, std::vector<double> &) const;
#define SNUG_INSTANTIATE(dim)                                                           \
  template Element<dim>::Rule::Rule(std::vector<mesh::LagrangePoint<dim>>);             \
  template Element<dim>::Rule Element<dim>::rule_of_straight_tetrahedra();              \
  template Element<dim>::Rule Element<dim>::rule_of_tetrahedra();                       \
  template void Element<dim>::stiffness_of_tetrahedron(const Nodes &, const Material &, \
                                                       std::vector<double> &) const;
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::elasticity
