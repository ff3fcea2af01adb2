#ifndef snug_tests_elasticity_textbook_element_h
#define snug_tests_elasticity_textbook_element_h

#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe_q.h>

#include "cells.h"

namespace elasticity_cells {
template <typename Number>
using Matrix = std::vector<std::vector<Number>>;

template <typename Number>
Matrix<Number> zeros(const unsigned int n_rows, const unsigned int n_columns)
{
  return Matrix<Number>(n_rows, std::vector<Number>(n_columns, Number(0.)));
}

/// A^-1 B by Gauss-Jordan elimination without pivots (A is SPD).
template <typename Number>
Matrix<Number> solve(Matrix<Number> A, Matrix<Number> B)
{
  for (unsigned int k = 0; k < A.size(); ++k)
    {
      const Number pivot = A[k][k];
      for (auto &entry : A[k])
        entry = entry / pivot;
      for (auto &entry : B[k])
        entry = entry / pivot;
      for (unsigned int i = 0; i < A.size(); ++i)
        if (i != k)
          {
            const Number factor = A[i][k];
            for (unsigned int j = 0; j < A.size(); ++j)
              A[i][j] = A[i][j] - factor * A[k][j];
            for (unsigned int j = 0; j < B[i].size(); ++j)
              B[i][j] = B[i][j] - factor * B[k][j];
          }
    }
  return B;
}

/// The inverse (by cofactors) and determinant of a 2x2 or 3x3 matrix.
template <typename Number>
Matrix<Number> invert(const Matrix<Number> &J, Number &determinant)
{
  const unsigned int n = J.size();
  auto               C = zeros<Number>(n, n);
  if (n == 2)
    C = {{J[1][1], -J[0][1]}, {-J[1][0], J[0][0]}};
  else
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        C[j][i] = J[(i + 1) % 3][(j + 1) % 3] * J[(i + 2) % 3][(j + 2) % 3] -
                  J[(i + 1) % 3][(j + 2) % 3] * J[(i + 2) % 3][(j + 1) % 3];
  determinant = Number(0.);
  for (unsigned int j = 0; j < n; ++j)
    determinant = determinant + J[0][j] * C[j][0];
  for (auto &row : C)
    for (auto &entry : row)
      entry = entry / determinant;
  return C;
}

/**
 * An element as textbooks have it, for any type of number: strain matrices
 * B in Voigt notation (xx, yy, zz, xy, yz, zx), K = int B' D B, shape
 * functions and quadrature of deal.II, B-bar by strain matrices
 * B + m (b-bar - b)/3 with the mass matrix of the pressures.
 */
template <typename Number>
struct TextbookElement
{
  Matrix<Number>      K;
  std::vector<Number> body_force; ///< of a unit density in all directions
  Number              volume = Number(0.);

  /// @p dimension tells dim.
  template <int dim>
  TextbookElement(const dealii::Tensor<1, dim> & /*dimension*/,
                  const Idealization   &idealization,
                  const Formulation     formulation,
                  const unsigned int    degree,
                  const Material       &material,
                  const Matrix<Number> &X)
    : body_force(dim * X.size(), Number(0.))
  {
    integrate<dim>(idealization, degree, X);
    if (formulation == Formulation::B_bar)
      project_dilatation();
    const auto         D = elasticity_matrix(idealization, material);
    const unsigned int N = dim * X.size();
    K                    = zeros<Number>(N, N);
    for (unsigned int q = 0; q < dV.size(); ++q)
      {
        auto DB = zeros<Number>(6, N);
        for (unsigned int i = 0; i < 6; ++i)
          for (unsigned int k = 0; k < 6; ++k)
            if (D[i][k] != 0.)
              for (unsigned int j = 0; j < N; ++j)
                DB[i][j] = DB[i][j] + dV[q] * D[i][k] * B[q][k][j];
        for (unsigned int i = 0; i < N; ++i)
          for (unsigned int k = 0; k < 6; ++k)
            for (unsigned int j = 0; j < N; ++j)
              K[i][j] = K[i][j] + B[q][k][i] * DB[k][j];
      }
  }

private:
  std::vector<Number>              dV;
  std::vector<Matrix<Number>>      B;         ///< per point
  std::vector<std::vector<double>> pressures; ///< functions, per point

  /// D of isotropic elasticity; in plane stress zz is condensed.
  static Matrix<double> elasticity_matrix(const Idealization &idealization,
                                          const Material     &material)
  {
    const double E = material.youngs_modulus, nu = material.poissons_ratio;
    const double c = E / ((1. + nu) * (1. - 2. * nu));
    auto         D = zeros<double>(6, 6);
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        D[i][j] = c * (i == j ? 1. - nu : nu);
    for (unsigned int i = 3; i < 6; ++i)
      D[i][i] = E / (2. * (1. + nu));
    if (idealization.kind == Idealization::Kind::plane_stress)
      {
        const auto full = D;
        for (unsigned int i = 0; i < 6; ++i)
          for (unsigned int j = 0; j < 6; ++j)
            D[i][j] = full[i][j] - full[i][2] * full[2][j] / full[2][2];
      }
    return D;
  }

  template <int dim>
  void
  integrate(const Idealization &idealization, const unsigned int degree, const Matrix<Number> &X)
  {
    const dealii::FE_Q<dim>   fe(degree);
    const dealii::QGauss<dim> quadrature(degree + 1);
    const unsigned int        n = fe.n_dofs_per_cell();
    std::vector<unsigned int> node(n); // of each function
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int d = 0, stride = 1; d < dim; ++d, stride *= degree + 1)
        node[i] += stride * std::lround(fe.unit_support_point(i)[d] * degree);
    for (unsigned int q = 0; q < quadrature.size(); ++q)
      {
        const auto xi = quadrature.point(q);
        pressures.push_back({1.});
        for (unsigned int d = 0; d < dim && degree == 2; ++d)
          pressures.back().push_back(xi[d]);

        auto   J      = zeros<Number>(dim, dim);
        Number radius = Number(0.), determinant;
        for (unsigned int i = 0; i < n; ++i)
          {
            radius = radius + fe.shape_value(i, xi) * X[node[i]][0];
            for (unsigned int c = 0; c < dim; ++c)
              for (unsigned int d = 0; d < dim; ++d)
                J[c][d] = J[c][d] + fe.shape_grad(i, xi)[d] * X[node[i]][c];
          }
        const auto inverse = invert(J, determinant);
        const bool round   = idealization.is_axisymmetric();
        dV.push_back(quadrature.weight(q) * determinant *
                     (round ? 2. * M_PI * radius : Number(idealization.thickness)));
        volume = volume + dV.back();

        B.push_back(zeros<Number>(6, dim * n));
        auto &at = B.back();
        for (unsigned int i = 0; i < n; ++i)
          {
            const unsigned int  first = dim * node[i];
            std::vector<Number> g(3, Number(0.));
            for (unsigned int c = 0; c < dim; ++c)
              {
                for (unsigned int d = 0; d < dim; ++d)
                  g[c] = g[c] + fe.shape_grad(i, xi)[d] * inverse[d][c];
                body_force[first + c] = body_force[first + c] + dV.back() * fe.shape_value(i, xi);
                at[c][first + c]      = g[c];
              }
            at[3][first]     = g[1];
            at[3][first + 1] = g[0];
            if (dim == 3)
              {
                at[4][first + 1]       = g[2];
                at[4][first + dim - 1] = g[1];
                at[5][first]           = g[2];
                at[5][first + dim - 1] = g[0];
              }
            if (round)
              at[2][first] = fe.shape_value(i, xi) / radius;
          }
      }
  }

  /// B <- B + m (b-bar - b)/3, m = (1, 1, 1, 0, 0, 0)', b = m'B.
  void project_dilatation()
  {
    const unsigned int m = pressures[0].size(), N = B[0][0].size();
    auto               mass = zeros<Number>(m, m), right = zeros<Number>(m, N);
    for (unsigned int q = 0; q < dV.size(); ++q)
      for (unsigned int i = 0; i < m; ++i)
        {
          for (unsigned int j = 0; j < m; ++j)
            mass[i][j] = mass[i][j] + pressures[q][i] * pressures[q][j] * dV[q];
          for (unsigned int j = 0; j < N; ++j)
            right[i][j] =
              right[i][j] + pressures[q][i] * dV[q] * (B[q][0][j] + B[q][1][j] + B[q][2][j]);
        }
    const auto coefficients = solve(mass, right);
    for (unsigned int q = 0; q < dV.size(); ++q)
      for (unsigned int j = 0; j < N; ++j)
        {
          Number change = -1. * (B[q][0][j] + B[q][1][j] + B[q][2][j]);
          for (unsigned int i = 0; i < m; ++i)
            change = change + pressures[q][i] * coefficients[i][j];
          for (unsigned int k = 0; k < 3; ++k)
            B[q][k][j] = B[q][k][j] + change / 3.;
        }
  }
};
} // namespace elasticity_cells

#endif
