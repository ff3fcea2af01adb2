#ifndef snug_tests_benchmark_linear_solver_h
#define snug_tests_benchmark_linear_solver_h

#include <benchmark/bonded.h>

#include <string>
#include <vector>

namespace snug::benchmark {
/// A solver of PETSc with its options, and the residual that it must reach.
struct LinearMethod
{
  std::string name, options;
  double      tolerance;
};

/// CHOLMOD, MUMPS, and conjugate gradients with multigrid by smoothed aggregation.
const std::vector<LinearMethod> &linear_methods();

/// One of them on the bonded bodies.
class LinearSolver
{
public:
  /// Does once what depends on the pattern: symbolic factorization, aggregates.
  /// @p bonded must outlive this object.
  LinearSolver(const Bonded &bonded, const LinearMethod &method);

  /// Numeric factorization; of multigrid, matrices of all levels and smoothers.
  void factorize();

  /// From zero. @throws std::runtime_error if it misses the tolerance.
  void solve();

  /// Return the iterations of the last solve().
  unsigned int iterations() const;

  const LinearMethod &method;

private:
  const Bonded &bonded;
  petsc::Solver solver;
};
} // namespace snug::benchmark

#endif
