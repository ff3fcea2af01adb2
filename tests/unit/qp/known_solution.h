#ifndef snug_tests_qp_known_solution_h
#define snug_tests_qp_known_solution_h

#include "dense_problem.h"

/// A dual problem made from its solution.
struct KnownSolution
{
  DenseData     data;
  dense::Matrix lambda, alpha, w;
};

struct KnownShape
{
  unsigned int n        = 30; ///< rows; every second one is bounded
  unsigned int n_kernel = 4;
  unsigned int n_active = 6;
  unsigned int n_weak   = 0;   ///< lambda_i = w_i = 0
  double       smallest = 0.5; ///< eigenvalue of F; the largest is 2 n
};

/**
 * Choose lambda >= 0, w <= 0 complementary on the bounded rows, and alpha;
 * then d = F lambda - G' alpha + w and e = G lambda have this solution, the
 * only one since F is positive definite.
 */
inline KnownSolution known_solution(const KnownShape &shape, unsigned int seed)
{
  std::mt19937       generator(seed);
  const unsigned int n = shape.n;
  KnownSolution      known;
  DenseData         &data = known.data;
  auto               V    = dense::random(n, n, generator);
  data.F                  = dense::product(V, dense::transpose(V));
  for (unsigned int i = 0; i < n; ++i)
    data.F(i, i) += shape.smallest;
  data.G       = dense::random(shape.n_kernel, n, generator);
  known.lambda = dense::random(n, 1, generator);
  known.alpha  = dense::random(shape.n_kernel, 1, generator);
  known.w      = dense::Matrix(n);
  data.bounded.assign(n, 0);
  for (unsigned int i = 0, count = 0; i < n; ++i)
    if (i % 2 == 1)
      {
        data.bounded[i]   = 1;
        const double size = 0.1 + std::abs(known.lambda(i));
        known.lambda(i)   = count < shape.n_active ? size : 0.;
        if (count >= shape.n_active + shape.n_weak)
          known.w(i) = -size;
        ++count;
      }
  data.d = dense::product(data.F, known.lambda);
  data.d.add(-1., dense::product(dense::transpose(data.G), known.alpha));
  data.d.add(1., known.w);
  data.e = dense::product(data.G, known.lambda);
  return known;
}

/**
 * The natural KKT residual bounds the error: F is at least `smallest` on the
 * kernel of G, the residual is relative to s <= ||d - F lambda_Im||, and F_ii
 * and 1 / smallest weigh it.
 */
inline double error_bound(const KnownSolution &known, double tolerance)
{
  return 1e3 * tolerance * (1. + dense::largest(known.data.d));
}

#endif
