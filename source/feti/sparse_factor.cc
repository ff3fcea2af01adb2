#include <snug/base/blocked_signals.h>
#include <snug/base/errors.h>
#include <snug/base/narrow.h>
#include <snug/base/petsc_options.h>
#include <snug/base/run_context.h>
#include <snug/feti/sparse_factor.h>

#include <deal.II/base/mpi.h>

#include <dlfcn.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <optional>

namespace snug::feti {
namespace {
const std::string package_option = "pc_factor_mat_solver_type", kind_option = "pc_type",
                  order_option = "pc_factor_mat_ordering_type";

std::string prefix_of(const MatrixKind of)
{
  return to_text(of) + "_";
}

/// Return PETSc's name of the package, or the package of its options.
std::string package_name(const std::string &prefix, const Factorization package)
{
  return petsc::option(prefix, package_option,
                       package == Factorization::MUMPS ? MATSOLVERMUMPS : MATSOLVERCHOLMOD);
}

bool wants_lu(const std::string &prefix)
{
  const auto kind = petsc::option(prefix, kind_option, "cholesky");
  if (kind != "cholesky" && kind != "lu")
    throw InputError("PETSc option -" + prefix + kind_option + " is '" + kind +
                     "'; it must be one of cholesky, lu");
  return kind == "lu";
}

[[noreturn]] void
throw_no_factorization(const std::string &prefix, const std::string &package, const bool lu)
{
  throw InputError("PETSc has no " + std::string(lu ? "LU" : "Cholesky") + " factorization by '" +
                   package + "': Solver/Factorization or the PETSc options -" + prefix +
                   package_option + " and -" + prefix + kind_option + " must name others");
}

/// Keep CHOLMOD to one thread. It requests four OpenMP threads whatever OMP_NUM_THREADS is.
/// Starting them takes as long as factorizing a subdomain, and the parallelism here is that of the
/// ranks. With no active level allowed, parallel regions are serial. The function is looked up by
/// name, because CHOLMOD loads an OpenMP runtime only if it was built with one.
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

petsc::Matrix copy_of_all(const CsrMatrix &A)
{
  const auto    n = narrow<PetscInt>(A.n_rows());
  petsc::Matrix wrapped, copy;
  // PETSc's wrapper accepts only arrays that it may write to, but PETSc only reads these.
  petsc::check(MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, n, n,
                                         const_cast<PetscInt *>(A.row_start().data()),
                                         const_cast<PetscInt *>(A.columns().data()),
                                         const_cast<double *>(A.values.data()), wrapped.put()));
  petsc::check(MatDuplicate(wrapped, MAT_COPY_VALUES, copy.put()));
  return copy;
}

/// Return the rows of this rank, which is one of the group.
petsc::Matrix copy_of_own(const CsrMatrix &A, const CoarseGroup &group)
{
  const auto n                = narrow<PetscInt>(A.n_rows());
  const auto [first, last]    = group.range(A.n_rows());
  const auto            begin = A.row_start()[first];
  std::vector<PetscInt> start;
  for (unsigned int i = first; i <= last; ++i)
    start.push_back(A.row_start()[i] - begin);
  const auto    m = narrow<PetscInt>(last - first);
  petsc::Matrix copy;
  petsc::check(MatCreateMPIAIJWithArrays(group.communicator(), m, m, n, n, start.data(),
                                         A.columns().data() + begin, A.values.data() + begin,
                                         copy.put()));
  return copy;
}
} // namespace

void check_factor_options(const Factorization package)
{
  auto one                 = CsrMatrix::from_rows({{0}}, 1);
  one.values               = {1.};
  const std::size_t n_uses = names(MatrixKind()).size();
  for (std::size_t use = 0; use < n_uses; ++use)
    {
      const auto   of           = static_cast<MatrixKind>(use);
      const bool   is_stiffness = of == MatrixKind::kplus || of == MatrixKind::dirichlet;
      SparseFactor factor(one, of, is_stiffness ? package : Factorization::CHOLMOD);
      factor.factorize(one, "the matrix 1"); // a factor of SuperLU cannot be destroyed before
    }
}

SparseFactor::SparseFactor(const CsrMatrix                   &pattern,
                           const MatrixKind                   of,
                           const Factorization                the_package,
                           FillOrderings                     *the_orderings,
                           std::shared_ptr<const CoarseGroup> the_group)
  : n(narrow<PetscInt>(pattern.n_rows()))
  , prefix(prefix_of(of))
  , package(package_name(prefix, the_group ? Factorization::MUMPS : the_package))
  , is_lu(wants_lu(prefix))
  , orderings(the_orderings)
  , group(std::move(the_group))
{
  keep_to_one_thread();
  if (!group || group->has_this_rank())
    analyse(pattern);
  if (group)
    return;
  petsc::check(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, n, nullptr, right_hand_side.put()));
  petsc::check(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, n, nullptr, solution.put()));
}

/// Return A as a PETSc matrix. It is a copy, because the arrays of @p A may be destroyed before the
/// factor: packages that refine their solutions keep the matrix.
petsc::Matrix SparseFactor::petsc_copy(const CsrMatrix &A) const
{
  auto copy = group ? copy_of_own(A, *group) : copy_of_all(A);
  petsc::check(MatSetOption(copy, MAT_SYMMETRIC, PETSC_TRUE));
  // This flag selects the mode of MUMPS for positive definite matrices.
  petsc::check(MatSetOption(copy, MAT_SPD, PETSC_TRUE));
  return copy;
}

void SparseFactor::analyse(const CsrMatrix &pattern)
{
  const BlockedSignals                during_analysis; // packages may order by METIS
  std::optional<petsc::DefaultOption> methods, silence;
  if (package == MATSOLVERCHOLMOD)
    {
      // Without a given order, CHOLMOD's default accepts AMD if it looks good enough. Trying METIS
      // as well costs symbolic time once and saves 20 to 27 % of the fill.
      methods.emplace(prefix, "mat_cholmod_nmethods", orderings ? "1" : "3");
      // Otherwise CHOLMOD would print a warning of its own before the one line of factorize().
      silence.emplace(prefix, "mat_cholmod_print", "0");
    }
  const auto matrix = petsc_copy(pattern);
  petsc::check(MatSetOptionsPrefixFactor(matrix, prefix.c_str()));
  const auto error = MatGetFactor(matrix, package.c_str(),
                                  is_lu ? MAT_FACTOR_LU : MAT_FACTOR_CHOLESKY, factor.put());
  // Some versions of PETSc return neither a factor nor an error for an unavailable factorization.
  if (error == PETSC_ERR_MISSING_FACTOR || (error == 0 && factor == nullptr))
    throw_no_factorization(prefix, package, is_lu);
  petsc::check(error);
  MatFactorInfo info;
  petsc::check(MatFactorInfoInitialize(&info));
  const auto order = elimination_order(matrix, *pattern.pattern());
  petsc::check(is_lu ? MatLUFactorSymbolic(factor, matrix, order, order, &info)
                     : MatCholeskyFactorSymbolic(factor, matrix, order, &info));
}

/// Return the order of rows and columns, which is empty if the package finds its own order.
petsc::IndexSet SparseFactor::elimination_order(Mat matrix, const CsrPattern &pattern) const
{
  petsc::IndexSet order;
  PetscBool       takes_order;
  petsc::check(MatFactorGetCanUseOrdering(factor, &takes_order));
  if (takes_order == PETSC_FALSE || group) // PETSc orders matrices of one rank only
    return order;
  MatOrderingType preferred;
  petsc::check(
    MatFactorGetPreferredOrdering(factor, is_lu ? MAT_FACTOR_LU : MAT_FACTOR_CHOLESKY, &preferred));
  const bool finds_own = preferred == nullptr || std::string(preferred) == MATORDERINGEXTERNAL;
  // PETSc's own LU needs an order that keeps rows of equal pattern together. MatGetOrdering()
  // provides it, so the preferred order is requested by name.
  const auto wanted = petsc::option(prefix, order_option, is_lu && !finds_own ? preferred : "");
  if (!wanted.empty())
    {
      petsc::IndexSet columns;
      petsc::check(MatGetOrdering(matrix, wanted.c_str(), order.put(), columns.put()));
      return order;
    }
  if (finds_own && !(orderings && package == MATSOLVERCHOLMOD))
    return order;
  FillOrderings own;
  const auto   &rows = (orderings ? *orderings : own).of(pattern);
  petsc::check(ISCreateGeneral(PETSC_COMM_SELF, narrow<PetscInt>(rows.size()), rows.data(),
                               PETSC_COPY_VALUES, order.put()));
  return order;
}

void SparseFactor::factorize(const CsrMatrix   &A,
                             const std::string &what,
                             const double       singular_size)
{
  if (n == 0) // CHOLMOD does not accept empty matrices
    return;
  if (std::isnormal(A.diagonal(0)))
    // The exponent of one entry suffices: any power of two of about the right size is a valid unit,
    // and dividing by it is exact.
    unit = std::ldexp(1., std::ilogb(A.diagonal(0)));
  if (!group)
    factorize_values(A, what);
  else
    throw_collectively(group->all(), [&]() {
      if (group->has_this_rank())
        factorize_values(A, what);
    });
  check(A, what, singular_size);
  has_failed = false;
}

void SparseFactor::factorize_values(const CsrMatrix &A, const std::string &what)
{
  if (has_failed) // MUMPS does not continue after an error
    analyse(A);
  has_failed           = true;
  const auto    matrix = petsc_copy(A);
  MatFactorInfo info;
  petsc::check(MatFactorInfoInitialize(&info));
  petsc::check(MatScale(matrix, 1. / unit));
  const PetscErrorCode error = is_lu ? MatLUFactorNumeric(factor, matrix, &info)
                                     : MatCholeskyFactorNumeric(factor, matrix, &info);
  if (error == PETSC_ERR_MAT_CH_ZRPVT)
    throw_not_definite(what);
  petsc::check(error);
  // MUMPS returns no error for failures that MatFactorGetError() reports.
  MatFactorError kept;
  petsc::check(MatFactorGetError(factor, &kept));
  if (kept == MAT_FACTOR_OUTMEMORY)
    throw std::bad_alloc();
}

void SparseFactor::check(const CsrMatrix   &A,
                         const std::string &what,
                         const double       singular_size) const
{
  qp::MultiVector b(A.n_rows()), x(A.n_rows());
  double          largest = 0.;
  for (unsigned int i = 0; i < A.n_rows(); ++i)
    {
      // Right-hand sides of the size of the diagonal make x of order one in any units.
      b(i)    = A.diagonal(i) * (1. + i % 3);
      largest = std::max(largest, std::abs(b(i)));
    }
  solve(b, x);
  qp::MultiVector residual = b;
  A.multiply_add(-1., x, residual);
  double error = 0., size = 0., energy = 0.; // energy = b' A^-1 b
  for (unsigned int i = 0; i < A.n_rows(); ++i)
    {
      error = std::max(error, std::abs(residual(i)));
      size  = std::max(size, std::abs(x(i)));
      energy += b(i) * x(i);
      if (!std::isfinite(x(i)))
        error = INFINITY;
      // LDL' of an indefinite matrix does not fail, but its diagonal is often not positive.
      if (b(i) <= 0.)
        energy = -INFINITY;
    }
  // The backward error of a Cholesky solve is near 1e-15 |A| |x|.
  if (!(error <= 1e-8 * std::max(largest, largest * size)))
    throw SolveError("the factorization of " + what +
                     " is inaccurate or the matrix holds NaN: look for "
                     "degenerate cells and extreme material constants");
  // A solution should be of order one, because b is one to three times the diagonal.
  if (!(energy > 0. && size < singular_size))
    throw_not_definite(what);
}

void SparseFactor::solve(const qp::MultiVector &b, qp::MultiVector &x) const
{
  const PetscInt k = b.n_columns();
  if (n == 0 || k == 0)
    return;
  if (group)
    solve_in_group(b, x);
  else if (k == 1)
    {
      // Solve one column in place in the arrays of the vectors, without creating dense matrices.
      petsc::check(VecPlaceArray(right_hand_side, b.column(0)));
      petsc::check(VecPlaceArray(solution, x.column(0)));
      petsc::check(MatSolve(factor, right_hand_side, solution));
      petsc::check(VecResetArray(right_hand_side));
      // The factor is that of A / unit.
      petsc::check(VecScale(solution, 1. / unit));
      petsc::check(VecResetArray(solution));
    }
  else
    {
      // Making matrices for every call takes longer than the solve of a small subdomain.
      auto &[B, X] = blocks[k];
      if (B == nullptr)
        {
          petsc::check(MatCreateSeqDense(PETSC_COMM_SELF, n, k, x.column(0), B.put()));
          petsc::check(MatCreateSeqDense(PETSC_COMM_SELF, n, k, x.column(0), X.put()));
        }
      petsc::check(MatDensePlaceArray(B, b.column(0)));
      petsc::check(MatDensePlaceArray(X, x.column(0)));
      const auto error = MatMatSolve(factor, B, X);
      if (error == 0)
        petsc::check(MatScale(X, 1. / unit));
      petsc::check(MatDenseResetArray(B));
      petsc::check(MatDenseResetArray(X));
      petsc::check(error);
    }
}

/// All columns are on all ranks. Each member uses its rows of b and computes its rows of x.
void SparseFactor::solve_in_group(const qp::MultiVector &b, qp::MultiVector &x) const
{
  const auto          rows = group->range(b.n_rows());
  const auto          m    = narrow<PetscInt>(rows.second - rows.first);
  std::vector<double> column(b.n_rows());
  petsc::Vector       from, to;
  if (group->has_this_rank())
    {
      petsc::check(VecCreateMPIWithArray(group->communicator(), 1, m, n, nullptr, from.put()));
      petsc::check(VecCreateMPIWithArray(group->communicator(), 1, m, n, nullptr, to.put()));
    }
  for (unsigned int k = 0; k < b.n_columns(); ++k)
    {
      if (group->has_this_rank())
        {
          petsc::check(VecPlaceArray(from, b.column(k) + rows.first));
          petsc::check(VecPlaceArray(to, column.data() + rows.first));
          petsc::check(MatSolve(factor, from, to));
          petsc::check(VecScale(to, 1. / unit));
          petsc::check(VecResetArray(from));
          petsc::check(VecResetArray(to));
        }
      group->allgather(column);
      std::copy(column.begin(), column.end(), x.column(k));
    }
}

std::shared_ptr<const CoarseGroup> coarse_group(MPI_Comm           all,
                                                const unsigned int n_rows,
                                                const MatrixKind   of,
                                                const unsigned int wanted)
{
  // Measured: MUMPS takes 1.5 to 2 times as long as CHOLMOD on one rank.
  const unsigned int alone_limit = 20000, rows_of_member = 6000, least = 4;
  const unsigned int n_ranks   = dealii::Utilities::MPI::n_mpi_processes(all);
  const bool         by_itself = n_rows <= alone_limit || n_ranks < least;
  const unsigned int by_size   = by_itself ? 1 : std::max(least, n_rows / rows_of_member);
  const unsigned int n_members = std::min(wanted == 0 ? by_size : wanted, n_ranks);
  if (n_members == 1 || package_name(prefix_of(of), Factorization::MUMPS) != MATSOLVERMUMPS)
    return nullptr;
  return std::make_shared<const CoarseGroup>(all, n_members);
}
} // namespace snug::feti
