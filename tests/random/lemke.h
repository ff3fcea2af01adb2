#ifndef snug_tests_random_lemke_h
#define snug_tests_random_lemke_h

#include <random/linear_program.h>

#include <optional>

namespace snug::test {
/**
 * z >= 0 with w = q + M z >= 0 and z'w = 0 by Lemke's complementary pivots
 * from the covering vector @p d > 0; ratios are compared lexicographically, so
 * that it cannot cycle. For positive semidefinite M it ends on a ray, and
 * returns nothing, only if there is no such z.
 *
 * Source: Cottle, Pang, Stone, The Linear Complementarity Problem (1992), 4.4.
 */
std::optional<Vector> lemke(const Matrix &M, const Vector &q, const Vector &d);
} // namespace snug::test

#endif
