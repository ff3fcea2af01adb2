#ifndef snug_tests_benchmark_bonded_h
#define snug_tests_benchmark_bonded_h

#include <snug/base/petsc_handle.h>
#include <snug/state/state_solver.h>

namespace snug::benchmark {
/**
 * The bodies of a state problem as one untorn linear problem: slave nodes
 * glued to the master nodes they touch, supported unknowns eliminated. K
 * and f are sums over the subdomains of the solver's dual problem, so that
 * both sides solve with the same numbers. One rank, no hanging nodes.
 */
class Bonded
{
public:
  /// @throws InputError if slave and master nodes do not match.
  Bonded(const state::StateSolver<3> &solver, const feti::TotalFeti &dual);

  unsigned int n_unknowns() const { return K.n_rows(); }

  /// Numeric factorization by CHOLMOD through PETSc (the symbolic one is
  /// done once, by the constructor).
  void factorize();

  void solve();

  /// ||K u - f|| / ||f|| of the last solve.
  double residual() const;

private:
  std::vector<unsigned int> number_unknowns(const state::StateSolver<3> &solver);
  void                      assemble(const state::StateSolver<3>     &solver,
                                     const feti::TotalFeti           &dual,
                                     const std::vector<unsigned int> &unknown);
  void                      analyse();

  feti::CsrMatrix K;
  qp::MultiVector f, u;
  petsc::Matrix   matrix, factor;
  petsc::Vector   right_hand_side, solution;
};
} // namespace snug::benchmark

#endif
