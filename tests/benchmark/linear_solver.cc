#include <snug/base/narrow.h>

#include <benchmark/linear_solver.h>

#include <stdexcept>

namespace snug::benchmark {
using petsc::check;

const std::vector<LinearMethod> &linear_methods()
{
  // Direct solutions are as exact as K allows; multigrid stops at the equilibrium that a state's
  // certificate asks for.
  static const std::vector<LinearMethod> methods = {
    {"CHOLMOD",
     "-ksp_type preonly -pc_type cholesky -pc_factor_mat_solver_type cholmod "
     "-mat_cholmod_nmethods 3",
     1e-8},
    {"MUMPS", "-ksp_type preonly -pc_type cholesky -pc_factor_mat_solver_type mumps", 1e-8},
    {"GAMG-CG",
     "-ksp_type cg -ksp_norm_type unpreconditioned -ksp_rtol 1e-6 -pc_type gamg "
     "-pc_gamg_reuse_interpolation true -mg_levels_ksp_type chebyshev -mg_levels_pc_type jacobi",
     1.001e-6}};
  return methods;
}

LinearSolver::LinearSolver(const Bonded &bonded, const LinearMethod &method)
  : method(method), bonded(bonded)
{
  const std::string prefix = method.name + "_";
  check(PetscOptionsPrefixPush(nullptr, prefix.c_str()));
  check(PetscOptionsInsertString(nullptr, method.options.c_str()));
  check(PetscOptionsPrefixPop(nullptr));
  check(KSPCreate(PETSC_COMM_SELF, solver.put()));
  check(KSPSetOptionsPrefix(solver, prefix.c_str()));
  check(KSPSetOperators(solver, bonded.matrix, bonded.matrix));
  check(KSPSetErrorIfNotConverged(solver, PETSC_TRUE));
  check(KSPSetFromOptions(solver));
  factorize();
}

void LinearSolver::factorize()
{
  // Mark the values as new, because PETSc keeps the factors of unchanged values.
  check(MatAssemblyBegin(bonded.matrix, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(bonded.matrix, MAT_FINAL_ASSEMBLY));
  check(KSPSetOperators(solver, bonded.matrix, bonded.matrix));
  check(KSPSetUp(solver));
  check(KSPSetUpOnBlocks(solver));
}

void LinearSolver::solve()
{
  check(KSPSolve(solver, bonded.right_hand_side, bonded.solution));
  if (const double residual = bonded.residual(); !(residual <= method.tolerance))
    throw std::runtime_error(method.name + " leaves a residual of " + std::to_string(residual));
}

unsigned int LinearSolver::iterations() const
{
  PetscInt n;
  check(KSPGetIterationNumber(solver, &n));
  return narrow<unsigned int>(n);
}
} // namespace snug::benchmark
