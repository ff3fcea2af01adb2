#ifndef snug_feti_sparse_factor_h
#define snug_feti_sparse_factor_h

#include <snug/base/petsc_handle.h>
#include <snug/feti/csr_matrix.h>
#include <snug/feti/feti_parameters.h>
#include <snug/feti/fill_orderings.h>
#include <snug/feti/team.h>

#include <memory>

namespace snug::feti {
/// The matrices that are factorized. PETSc's options for one begin with its name and "_":
/// -NAME_pc_factor_mat_solver_type PACKAGE, -NAME_pc_type cholesky or lu,
/// -NAME_pc_factor_mat_ordering_type ORDER and those of the package, as -NAME_mat_mumps_icntl_7.
enum class FactorOf
{
  kplus,
  dirichlet,
  coarse,
  soft_modes,
  row_gram
};
inline Names names(FactorOf)
{
  return {{"kplus", "K with fixed nodes, whose inverse is K^+"},
          {"dirichlet", "the inner unknowns of a subdomain, in the Dirichlet preconditioner"},
          {"coarse", "G G' of the rows that are free"},
          {"soft_modes", "the coarse problem of the soft modes"},
          {"row_gram", "B D^-1 B'"}};
}

/// @throws InputError if PETSc's options name a package or a factorization that PETSc lacks for
/// one of the matrices, those of the stiffness being by @p package if the options name none.
/// The same on all ranks.
void check_factor_options(Factorization package);

/**
 * Cholesky factorization of sparse symmetric positive definite matrices
 * of one pattern on one process, or on a team of them, by a package of
 * PETSc. The symbolic part is done once. Scaling the matrix by a power of two changes no digit:
 * the package factorizes it divided by one, so that no square root of its
 * units is taken. No matrix is kept.
 */
class SparseFactor
{
public:
  /**
   * @param[in] pattern of the matrices; values are not used.
   * @param[in] of whose options of PETSc hold.
   * @param[in] package unless the options name another.
   * @param[in] orderings where CHOLMOD takes its order from; null: it tries some of its own.
   * @param[in] team Factorizes matrices that are the same on all its ranks, and all functions are
   *   collective on them; null: this rank alone.
   * @throws InputError see check_factor_options()
   */
  SparseFactor(const CsrMatrix            &pattern,
               FactorOf                    of,
               Factorization               package,
               FillOrderings              *orderings = nullptr,
               std::shared_ptr<const Team> team      = nullptr);

  /**
   * Factorize a matrix of the pattern.
   * @throws SolveError if the matrix is not positive definite, holds NaN,
   *   or the solution of one check system is wrong (packages can fail
   *   silently); @p what names the matrix. It counts as singular where
   *   entries of a solution that should be of order one are above
   *   @p singular_size: 1e11 leaves five digits. Other matrices may follow.
   */
  void factorize(const CsrMatrix &A, const std::string &what, double singular_size = 1e11);

  /// x = A^{-1} b for every column.
  void solve(const qp::MultiVector &b, qp::MultiVector &x) const;

private:
  void            analyse(const CsrMatrix &pattern);
  petsc::IndexSet elimination_order(Mat wrapped, const CsrPattern &pattern) const;
  void            factorize_values(const CsrMatrix &A, const std::string &what);
  void            check(const CsrMatrix &A, const std::string &what, double singular_size) const;
  petsc::Matrix   petsc_copy(const CsrMatrix &A) const;
  void            solve_in_team(const qp::MultiVector &b, qp::MultiVector &x) const;

  PetscInt                    n;
  std::string                 prefix, package; ///< PETSc's names
  bool                        is_lu;
  FillOrderings              *orderings;
  std::shared_ptr<const Team> team; ///< before what lives on its communicator
  petsc::Matrix               factor;
  petsc::Vector               right_hand_side, solution;
  bool                        has_failed = false;
  double                      unit       = 1.; ///< power of two; the factor is of A / unit
};

/**
 * Who factorizes a coarse problem of @p n_rows that all ranks have: null, each of them for itself,
 * or a team of @p wanted. By size if that is 0: alone is faster up to 20,000 rows, and than three
 * ranks; a team has one for 6,000 rows. Alone, too, by a package of PETSc's options but MUMPS.
 * Collective.
 */
std::shared_ptr<const Team>
coarse_team(MPI_Comm all, unsigned int n_rows, FactorOf of, unsigned int wanted);
} // namespace snug::feti

#endif
