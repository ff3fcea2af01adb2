#include <snug/base/errors.h>
#include <snug/base/narrow.h>
#include <snug/feti/sparse_factor.h>

#include <dlfcn.h>

#include <cmath>
#include <new>

namespace snug::feti {
namespace {
/// Whether the user has set an option of PETSc, asked before anyone else does.
bool is_set(const char *name)
{
  PetscBool set = PETSC_FALSE;
  petsc::check(PetscOptionsHasName(nullptr, nullptr, name, &set));
  return set == PETSC_TRUE;
}

/// Options for the next factor of CHOLMOD that the user has not set. Without an order given its
/// default takes AMD when it looks good enough; trying METIS as well costs symbolic time once and
/// saves 20 to 27 % of the fill.
void set_options(const bool is_ordered)
{
  static const bool chosen = is_set("-mat_cholmod_nmethods"), told = is_set("-mat_cholmod_print");
  if (!chosen)
    petsc::check(PetscOptionsSetValue(nullptr, "-mat_cholmod_nmethods", is_ordered ? "1" : "3"));
  // It would print a warning of its own before the one line of factorize().
  if (!told)
    petsc::check(PetscOptionsSetValue(nullptr, "-mat_cholmod_print", "0"));
}

/// CHOLMOD asks OpenMP for four threads whatever OMP_NUM_THREADS says;
/// starting them takes as long as factorizing a subdomain, and ranks
/// are what runs in parallel here. Parallel regions nested in none are
/// serial. Looked up by name: CHOLMOD brings its runtime if it has one.
void keep_to_one_thread()
{
  using Function = void(int);
  static const auto set_max_active_levels =
    reinterpret_cast<Function *>(dlsym(RTLD_DEFAULT, "omp_set_max_active_levels"));
  if (set_max_active_levels != nullptr)
    set_max_active_levels(0);
}

[[noreturn]] void throw_not_definite(const std::string &what)
{
  throw SolveError(what + " is not positive definite: look for degenerate cells, unconnected "
                          "parts and extreme material constants");
}
} // namespace

SparseFactor::SparseFactor(const CsrMatrix    &the_matrix,
                           const Factorization package,
                           FillOrderings      *orderings)
  : matrix(the_matrix)
{
  set_options(orderings != nullptr);
  keep_to_one_thread();
  const bool mumps = package == Factorization::MUMPS;
  // PETSc wraps the arrays without a copy and does not write to them, but for the scaling in
  // factorize(), which is taken back.
  auto &csr = const_cast<CsrMatrix &>(matrix);
  petsc::check(MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, matrix.n_rows, matrix.n_rows,
                                         csr.row_start.data(), csr.columns.data(),
                                         csr.values.data(), wrapped.put()));
  petsc::check(MatSetOption(wrapped, MAT_SYMMETRIC, PETSC_TRUE));
  // MUMPS takes its mode for positive definite matrices from this flag.
  petsc::check(MatSetOption(wrapped, MAT_SPD, PETSC_TRUE));
  petsc::check(MatGetFactor(wrapped, mumps ? MATSOLVERMUMPS : MATSOLVERCHOLMOD, MAT_FACTOR_CHOLESKY,
                            factor.put()));
  if (mumps)
    petsc::check(MatMumpsSetIcntl(factor, 7, 4)); // PORD: METIS is absent
  MatFactorInfo info;
  petsc::check(MatFactorInfoInitialize(&info));
  petsc::IndexSet order;
  if (orderings && !mumps)
    {
      const auto &rows = orderings->of(matrix);
      petsc::check(ISCreateGeneral(PETSC_COMM_SELF, narrow<PetscInt>(rows.size()), rows.data(),
                                   PETSC_USE_POINTER, order.put()));
    }
  petsc::check(MatCholeskyFactorSymbolic(factor, wrapped, order, &info));
  petsc::check(
    VecCreateSeqWithArray(PETSC_COMM_SELF, 1, matrix.n_rows, nullptr, right_hand_side.put()));
  petsc::check(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, matrix.n_rows, nullptr, solution.put()));
}

void SparseFactor::factorize(const std::string &what, const double singular_size)
{
  if (matrix.n_rows == 0) // CHOLMOD takes no empty matrix
    return;
  // The values were changed behind PETSc's back: an assembly tells it that they are others.
  petsc::check(MatAssemblyBegin(wrapped, MAT_FINAL_ASSEMBLY));
  petsc::check(MatAssemblyEnd(wrapped, MAT_FINAL_ASSEMBLY));
  MatFactorInfo info;
  petsc::check(MatFactorInfoInitialize(&info));
  if (std::isnormal(matrix.diagonal(0)))
    // The exponent of one entry is enough: any power of two of about the right size will do, and to
    // divide and multiply by it is exact.
    unit = std::ldexp(1., std::ilogb(matrix.diagonal(0)));
  petsc::check(MatScale(wrapped, 1. / unit));
  // Not by petsc::check() at once: first the values become what they were before.
  const PetscErrorCode error = MatCholeskyFactorNumeric(factor, wrapped, &info);
  petsc::check(MatScale(wrapped, unit));
  if (error == PETSC_ERR_MAT_CH_ZRPVT)
    throw_not_definite(what);
  petsc::check(error);
  // MUMPS returns no error for what it keeps here
  MatFactorError kept;
  petsc::check(MatFactorGetError(factor, &kept));
  if (kept == MAT_FACTOR_OUTMEMORY)
    throw std::bad_alloc();
  check(what, singular_size);
}

void SparseFactor::check(const std::string &what, const double singular_size) const
{
  qp::MultiVector b(matrix.n_rows), x(matrix.n_rows);
  double          largest = 0.;
  for (unsigned int i = 0; i < matrix.n_rows; ++i)
    {
      // Right-hand sides of the size of the diagonal make x of order one, whatever the units.
      b(i)    = matrix.diagonal(i) * (1. + i % 3);
      largest = std::max(largest, std::abs(b(i)));
    }
  solve(b, x);
  qp::MultiVector residual = b;
  matrix.multiply_add(-1., x, residual);
  double error = 0., size = 0., energy = 0.; // energy: b' A^-1 b
  for (unsigned int i = 0; i < matrix.n_rows; ++i)
    {
      error = std::max(error, std::abs(residual(i)));
      size  = std::max(size, std::abs(x(i)));
      energy += b(i) * x(i);
      if (!std::isfinite(x(i)))
        error = INFINITY;
      // LDL' of an indefinite matrix works; its diagonal often tells
      if (b(i) <= 0.)
        energy = -INFINITY;
    }
  // backward error of a Cholesky solve is near 1e-15 |A| |x|
  if (!(error <= 1e-8 * std::max(largest, largest * size)))
    throw SolveError("the factorization of " + what +
                     " is inaccurate or the matrix holds NaN: look for "
                     "degenerate cells and extreme material constants");
  // b is the diagonal, about
  if (!(energy > 0. && size < singular_size))
    throw_not_definite(what);
}

void SparseFactor::solve(const qp::MultiVector &b, qp::MultiVector &x) const
{
  const PetscInt n = matrix.n_rows, k = b.n_columns();
  if (n == 0 || k == 0)
    return;
  if (k == 1)
    {
      // One column is solved in place of the vectors' arrays, without making dense matrices.
      petsc::check(VecPlaceArray(right_hand_side, b.column(0)));
      petsc::check(VecPlaceArray(solution, x.column(0)));
      petsc::check(MatSolve(factor, right_hand_side, solution));
      petsc::check(VecResetArray(right_hand_side));
      // The factor is that of A / unit.
      petsc::check(VecScale(solution, 1. / unit));
      petsc::check(VecResetArray(solution));
      return;
    }
  petsc::Matrix B, X;
  petsc::check(
    MatCreateSeqDense(PETSC_COMM_SELF, n, k, const_cast<double *>(b.column(0)), B.put()));
  petsc::check(MatCreateSeqDense(PETSC_COMM_SELF, n, k, x.column(0), X.put()));
  petsc::check(MatMatSolve(factor, B, X));
  petsc::check(MatScale(X, 1. / unit));
}
} // namespace snug::feti
