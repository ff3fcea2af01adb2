#ifndef snug_feti_dense_h
#define snug_feti_dense_h

#include <snug/qp/multi_vector.h>

#include <vector>

namespace snug::feti {
/// Small dense matrices, column by column, by LAPACK.
namespace dense {
/// A' B.
qp::MultiVector transpose_product(const qp::MultiVector &A, const qp::MultiVector &B);

/// A B.
qp::MultiVector product(const qp::MultiVector &A, const qp::MultiVector &B);

/// A^{-1} B for symmetric positive definite A.
/// @throws std::runtime_error if A is not.
qp::MultiVector solve_spd(qp::MultiVector A, qp::MultiVector B);

/// Ascending eigenvalues of a symmetric matrix; A becomes the
/// orthonormal eigenvectors.
std::vector<double> eigen(qp::MultiVector &A);
} // namespace dense
} // namespace snug::feti

#endif
