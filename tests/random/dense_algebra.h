#ifndef snug_tests_random_dense_algebra_h
#define snug_tests_random_dense_algebra_h

#include <random/linear_program.h>

namespace snug::test {
/// Solutions of A x = 0, by elimination with complete pivots.
struct NullSpace
{
  Matrix                    basis; ///< x of each column; unit entries where nothing is held
  std::vector<unsigned int> pivot_rows, pivot_columns;
  double                    least_taken;  ///< least pivot; infinite: none
  double                    largest_left; ///< largest entry taken for zero
};

/// Entries below @p cut are zero.
NullSpace null_space(Matrix A, double cut);

/// Gram-Schmidt, twice for rounding.
void orthonormalise(Matrix &columns);

/// @p v less its part in the orthonormal @p columns.
Vector without(const Matrix &columns, Vector v);

/// The shortest x with the least |S x - b|; singular values below @p cut of
/// the largest are zero.
Vector least_squares(const Matrix &S, const Vector &b, double cut);
} // namespace snug::test

#endif
