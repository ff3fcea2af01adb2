#ifndef snug_tests_benchmark_bonded_h
#define snug_tests_benchmark_bonded_h

#include <snug/base/petsc_handle.h>
#include <snug/state/state_solver.h>

namespace snug::benchmark {
/**
 * The bodies of a state problem as one untorn linear problem: slave nodes
 * glued to the master nodes they touch. K and f are sums over the subdomains
 * of the solver's dual problem, so that both sides solve with the same
 * numbers. Held unknowns keep their diagonal entry and no load: every node
 * has its three unknowns, which multigrid asks for. One rank, no hanging nodes.
 */
class Bonded
{
public:
  /// @throws InputError if slave and master nodes do not match.
  Bonded(const state::StateSolver<3> &solver, const feti::LoadedProblem &dual);
  Bonded(const Bonded &)            = delete; ///< matrix is of the arrays of K
  Bonded &operator=(const Bonded &) = delete;

  /// ||K u - f|| / ||f||
  double residual() const;

  /// K with the rigid motions as its near null space, f and u, for PETSc.
  petsc::Matrix matrix;
  petsc::Vector right_hand_side, solution;

private:
  void number_unknowns(const state::StateSolver<3> &solver);
  void assemble(const state::StateSolver<3> &solver, const feti::LoadedProblem &dual);
  void wrap();
  void add_rigid_motions(const state::StateSolver<3> &solver);

  std::vector<unsigned int>  unknown; ///< of each degree of freedom 3 * node + component
  std::vector<unsigned char> is_held; ///< per unknown
  feti::CsrMatrix            K;
  qp::MultiVector            f, u;
};
} // namespace snug::benchmark

#endif
