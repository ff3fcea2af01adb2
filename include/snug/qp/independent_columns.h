#ifndef snug_qp_independent_columns_h
#define snug_qp_independent_columns_h

#include <snug/qp/multi_vector.h>

namespace snug::qp {
/**
 * Return C (k x rank) with C' S C = I by a rank-revealing Cholesky factorization of the symmetric
 * positive semidefinite S (k x k). Pivots (of S scaled to unit diagonal) below @p cut are dropped,
 * and also rows whose diagonal entry does not exceed their entry of @p smallest.
 */
MultiVector
orthonormal_combinations(const MultiVector &S, const std::vector<double> &smallest, double cut);

/**
 * Return the indices of some of k columns such that all columns are near the span of these. @p S is
 * the Gram matrix (k x k) of the columns. A Cholesky factorization with pivots takes the farthest
 * column first, at least one. It stops if no column is farther from the span of the taken columns
 * than @p distance, or than @p part of the length of the longest column.
 */
std::vector<unsigned int> leading_columns(const MultiVector &S, double distance, double part);
} // namespace snug::qp

#endif
