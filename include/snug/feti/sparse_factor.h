#ifndef snug_feti_sparse_factor_h
#define snug_feti_sparse_factor_h

#include <snug/base/petsc_handle.h>
#include <snug/feti/coarse_group.h>
#include <snug/feti/csr_matrix.h>
#include <snug/feti/feti_parameters.h>
#include <snug/feti/fill_orderings.h>

#include <map>
#include <memory>

namespace snug::feti {
/// Uses of factorizations. The PETSc options of a use begin with its name and "_":
/// -NAME_pc_factor_mat_solver_type PACKAGE, -NAME_pc_type cholesky or lu,
/// -NAME_pc_factor_mat_ordering_type ORDER and the options of the package, as
/// -NAME_mat_mumps_icntl_7.
enum class MatrixKind
{
  kplus,
  dirichlet,
  coarse,
  clusters,
  soft_modes,
  row_gram
};
inline Names names(MatrixKind)
{
  return {{"kplus", "K with fixed nodes, whose inverse is K^+"},
          {"dirichlet", "the inner unknowns of a subdomain, in the Dirichlet preconditioner"},
          {"coarse", "G G' of the rows that are free"},
          {"clusters", "the moments of the faces in a cluster of subdomains"},
          {"soft_modes", "the coarse problem of the soft modes"},
          {"row_gram", "B D^-1 B'"}};
}

/// Check the PETSc options of all uses. Stiffness matrices are factorized by @p package if the
/// options name no package.
/// @throws InputError if the options name a package or a factorization that PETSc lacks. The error
/// is the same on all ranks.
void check_factor_options(Factorization package);

/**
 * This class is the Cholesky factorization of sparse symmetric positive definite matrices of one
 * pattern by a package of PETSc, on one process or on a group of processes. The symbolic part is
 * done once. Scaling the matrix by a power of two changes no digit of the factor: the package
 * factorizes the matrix divided by a power of two of its size, so that no square root of its units
 * is taken. No matrix is kept.
 */
class SparseFactor
{
public:
  /**
   * Analyze the pattern.
   * @param[in] pattern of the matrices; values are not used.
   * @param[in] of the use, whose PETSc options apply.
   * @param[in] package unless the options name another package.
   * @param[in] orderings from which CHOLMOD takes its order; null: CHOLMOD tries some orderings of
   *   its own.
   * @param[in] group factorizes matrices that are the same on all its ranks, and all functions are
   *   collective on group->all(); null: this rank factorizes alone.
   * @throws InputError see check_factor_options()
   */
  SparseFactor(const CsrMatrix                   &pattern,
               MatrixKind                         of,
               Factorization                      package,
               FillOrderings                     *orderings = nullptr,
               std::shared_ptr<const CoarseGroup> group     = nullptr);

  /**
   * Factorize a matrix of the pattern. A further matrix may follow, also after an error.
   * @throws SolveError if the matrix is not positive definite, holds NaN, or the solution of one
   *   check system is wrong (packages can fail silently); @p what names the matrix. The matrix
   *   counts as singular if an entry of a solution that should be of order one exceeds
   *   @p singular_size: 1e11 leaves five correct digits.
   */
  void factorize(const CsrMatrix &A, const std::string &what, double singular_size = 1e11);

  /// Compute x = A^{-1} b for every column.
  void solve(const qp::MultiVector &b, qp::MultiVector &x) const;

private:
  void            analyse(const CsrMatrix &pattern);
  petsc::IndexSet elimination_order(Mat wrapped, const CsrPattern &pattern) const;
  void            factorize_values(const CsrMatrix &A, const std::string &what);
  void            check(const CsrMatrix &A, const std::string &what, double singular_size) const;
  petsc::Matrix   petsc_copy(const CsrMatrix &A) const;
  void            solve_in_group(const qp::MultiVector &b, qp::MultiVector &x) const;

  PetscInt       n;
  std::string    prefix, package; ///< PETSc's names of the use and of the package
  bool           is_lu;
  FillOrderings *orderings;
  std::shared_ptr<const CoarseGroup> group; ///< declared before the objects on its communicator
  petsc::Matrix                      factor;
  petsc::Vector                      right_hand_side, solution;
  /// right-hand sides and solutions by their number of columns, without arrays of their own
  mutable std::map<PetscInt, std::pair<petsc::Matrix, petsc::Matrix>> blocks;
  bool                                                                has_failed = false;
  double unit = 1.; ///< power of two; the factor is that of A / unit
};

/**
 * Return the group that factorizes a replicated coarse problem of @p n_rows rows, or null if each
 * rank factorizes it for itself. @p wanted is the number of members; 0 chooses the number by size.
 * Up to 20,000 rows, or with fewer than four ranks, each rank factorizes for itself: one rank is
 * then faster than a group, and also faster than a group of three. Larger problems have one member
 * for 6,000 rows, but at least four members. The result is also null if PETSc's options name a
 * package other than MUMPS. Collective.
 */
std::shared_ptr<const CoarseGroup>
coarse_group(MPI_Comm all, unsigned int n_rows, MatrixKind of, unsigned int wanted);
} // namespace snug::feti

#endif
