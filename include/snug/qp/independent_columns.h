#ifndef snug_qp_independent_columns_h
#define snug_qp_independent_columns_h

#include <snug/qp/multi_vector.h>

namespace snug::qp {
/**
 * Rank-revealing Cholesky factorization of the symmetric positive
 * semidefinite S (k x k): C (k x rank) with C' S C = I. Pivots (of S
 * scaled to unit diagonal) below @p cut are dropped, and rows whose
 * diagonal entry is not above their entry of @p smallest.
 */
MultiVector
orthonormal_combinations(const MultiVector &S, const std::vector<double> &smallest, double cut);

/**
 * Some of k columns whose span all of them are near: by Cholesky
 * factorization with pivots of their Gram matrix @p S (k x k), columns are
 * taken, farthest first, until none is farther from the span of those taken
 * than @p distance, or than @p part of the longest column. At least one.
 */
std::vector<unsigned int> leading_columns(const MultiVector &S, double distance, double part);
} // namespace snug::qp

#endif
