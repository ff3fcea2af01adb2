#ifndef snug_tests_random_linear_program_h
#define snug_tests_random_linear_program_h

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

namespace snug::test {
using Matrix = dealii::FullMatrix<double>;
using Vector = dealii::Vector<double>;

/// The largest c'r, where it is, and by how much r misses what it is to meet:
/// the constraints and, as a proof that nothing is larger, the dual value.
struct Optimum
{
  double value;
  Vector r;
  double error;
};

/**
 * max c'r with A r <= 0 and -1 <= r_i <= 1, from the dual linear program
 * min sum_i |c - A'y|_i, y >= 0: primal simplex from y = 0.
 */
Optimum largest(const Matrix &A, const Vector &c);
} // namespace snug::test

#endif
