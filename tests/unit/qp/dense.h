#ifndef snug_tests_qp_dense_h
#define snug_tests_qp_dense_h

#include <snug/qp/multi_vector.h>

#include <petscsys.h>

#include <gtest/gtest.h>
#include <petscblaslapack.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

/// Dense linear algebra of the tests, on one rank.
namespace dense {
using Matrix = snug::qp::MultiVector;

inline Matrix product(const Matrix &A, const Matrix &B)
{
  Matrix C(A.n_rows(), B.n_columns());
  C.add_product(1., A, B);
  return C;
}

inline Matrix transpose(const Matrix &A)
{
  Matrix T(A.n_columns(), A.n_rows());
  for (unsigned int i = 0; i < A.n_rows(); ++i)
    for (unsigned int j = 0; j < A.n_columns(); ++j)
      T(j, i) = A(i, j);
  return T;
}

/// Eigenvalues of a symmetric matrix, ascending; A becomes the vectors.
inline std::vector<double> eigen(Matrix &A)
{
  PetscBLASInt        n = A.n_rows(), size = 10 * n + 10, info = 0;
  std::vector<double> values(n), work(size);
  if (n > 0)
    LAPACKsyev_("V", "U", &n, A.column(0), &n, values.data(), work.data(), &size, &info);
  EXPECT_EQ(info, 0);
  return values;
}

/// Moore-Penrose inverse of a symmetric positive semidefinite matrix.
inline Matrix pseudo_inverse(Matrix A)
{
  const auto   values = eigen(A);
  const double cut    = values.empty() ? 0. : 1e-10 * std::abs(values.back());
  Matrix       scaled = A;
  for (unsigned int j = 0; j < A.n_columns(); ++j)
    for (unsigned int i = 0; i < A.n_rows(); ++i)
      scaled(i, j) = values[j] > cut ? A(i, j) / values[j] : 0.;
  return product(scaled, transpose(A));
}

/// A^{-1} b by LU; A regular.
inline Matrix solve(Matrix A, Matrix b)
{
  PetscBLASInt              n = A.n_rows(), k = b.n_columns(), info = 0;
  std::vector<PetscBLASInt> pivots(n);
  LAPACKgesv_(&n, &k, A.column(0), &n, pivots.data(), b.column(0), &n, &info);
  EXPECT_EQ(info, 0);
  return b;
}

inline Matrix random(unsigned int m, unsigned int n, std::mt19937 &generator)
{
  std::uniform_real_distribution<double> uniform(-1., 1.);
  Matrix                                 A(m, n);
  for (unsigned int j = 0; j < n; ++j)
    for (unsigned int i = 0; i < m; ++i)
      A(i, j) = uniform(generator);
  return A;
}

inline double largest(const Matrix &A)
{
  double result = 0.;
  for (unsigned int j = 0; j < A.n_columns(); ++j)
    for (unsigned int i = 0; i < A.n_rows(); ++i)
      result = std::max(result, std::abs(A(i, j)));
  return result;
}

inline double distance(Matrix A, const Matrix &B)
{
  A.add(-1., B);
  return largest(A);
}
} // namespace dense

#endif
