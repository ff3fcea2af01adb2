#include <snug/base/errors.h>
#include <snug/base/petsc_handle.h>
#include <snug/base/petsc_options.h>
#include <snug/feti/sparse_factor.h>

#include <gtest/gtest.h>
#include <unit/feti/torn_truss.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace {
using namespace snug;
using namespace snug::test;

const double nan = std::numeric_limits<double>::quiet_NaN();

/// Factors with the error handler of the program, because PETSc's default handler prints.
class Factors : public ::testing::TestWithParam<feti::Factorization>
{
protected:
  Factors() { petsc::return_errors(); }
  ~Factors() override { PetscPopErrorHandler(); }
};

/// A truss on springs: positive definite, all diagonal entries near 2.
feti::CsrMatrix truss_on_springs()
{
  auto K = truss_system(Block(0, {0, 0}, {4, 3}), {2., 1.}).K;
  for (unsigned int i = 0; i < K.n_rows(); ++i)
    K.values[K.position(i, i)] += 1.;
  return K;
}

/// Return the error message of the factorization of "the punch".
std::string failure_reason(feti::SparseFactor &factor, const feti::CsrMatrix &A)
{
  try
    {
      factor.factorize(A, "the punch");
    }
  catch (const SolveError &error)
    {
      return error.what();
    }
  return "";
}

/// It names the matrix and what to try.
void expect_clear(const std::string &message)
{
  EXPECT_NE(message.find("the punch"), std::string::npos) << message;
  EXPECT_NE(message.find("look for degenerate cells"), std::string::npos) << message;
}

/// The factor inverts its matrix.
void expect_inverse(const feti::CsrMatrix &A, const feti::SparseFactor &factor)
{
  for (const unsigned int n_columns : {1, 2})
    {
      qp::MultiVector x(A.n_rows(), n_columns), b(A.n_rows(), n_columns), y(A.n_rows(), n_columns);
      for (unsigned int i = 0; i < A.n_rows(); ++i)
        for (unsigned int k = 0; k < n_columns; ++k)
          x(i, k) = std::sin(1. + i + 2. * k);
      A.multiply_add(1., x, b);
      factor.solve(b, y);
      for (unsigned int i = 0; i < A.n_rows(); ++i)
        for (unsigned int k = 0; k < n_columns; ++k)
          EXPECT_NEAR(y(i, k), x(i, k), 1e-10);
    }
}

TEST_P(Factors, SingularMatricesAreErrors)
{
  // a floating body, a node without cells, and nothing at all
  auto floating = truss_system(Block(1, {1, 0, 2}, {3, 3, 5}), {2., 1., 3.}).K;
  auto loose    = truss_on_springs();
  for (PetscInt p = loose.row_start()[3]; p < loose.row_start()[4]; ++p)
    {
      loose.values[p]                                     = 0.;
      loose.values[loose.position(loose.columns()[p], 3)] = 0.;
    }
  auto zero = truss_on_springs();
  std::fill(zero.values.begin(), zero.values.end(), 0.);
  for (const auto *matrix : {&floating, &loose, &zero})
    {
      feti::SparseFactor factor(*matrix, feti::MatrixKind::kplus, GetParam());
      expect_clear(failure_reason(factor, *matrix));
      if (matrix == &loose)
        {
          ASSERT_EQ(failure_reason(factor, truss_on_springs()), "");
          expect_inverse(truss_on_springs(), factor);
        }
    }
}

TEST_P(Factors, IndefiniteMatricesAndNaNAreErrorsAndLeaveAFactorThatWorks)
{
  auto               K    = truss_on_springs();
  const auto         good = K.values;
  feti::SparseFactor factor(K, feti::MatrixKind::kplus, GetParam());
  // an off-diagonal entry and its mirror image
  const unsigned int other = K.columns()[K.row_start()[3]] == 3 ? K.columns()[K.row_start()[3] + 1]
                                                                : K.columns()[K.row_start()[3]];
  for (const double bad : {-1e4, -1e-4, 0., nan, -nan, double(INFINITY), -double(INFINITY)})
    for (const unsigned int column : {3u, other})
      {
        if (column == other && std::isfinite(bad))
          continue; // is positive definite still, or nearly
        K.values[K.position(3, column)] = bad;
        K.values[K.position(column, 3)] = bad;
        SCOPED_TRACE(bad);
        expect_clear(failure_reason(factor, K));
        K.values = good;
        ASSERT_EQ(failure_reason(factor, K), "");
        expect_inverse(K, factor);
      }
  // all diagonal entries negative
  for (double &value : K.values)
    value *= -1.;
  expect_clear(failure_reason(factor, K));
}

/// This class sets an option of PETSc during its lifetime.
class PetscOption
{
public:
  PetscOption(const std::string &the_name, const std::string &value) : name(the_name)
  {
    petsc::check(PetscOptionsSetValue(nullptr, name.c_str(), value.c_str()));
  }
  ~PetscOption() { PetscOptionsClearValue(nullptr, name.c_str()); }
  PetscOption(const PetscOption &)            = delete;
  PetscOption &operator=(const PetscOption &) = delete;

private:
  std::string name;
};

/// Any number of ranks factorizes together, and bad matrices are errors on all of them.
TEST(TeamFactors, InvertOnAllRanks)
{
  petsc::return_errors();
  int size;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  const auto good  = truss_on_springs();
  auto       loose = good, not_a_number = good;
  for (PetscInt p = loose.row_start()[3]; p < loose.row_start()[4]; ++p)
    {
      loose.values[p]                                     = 0.;
      loose.values[loose.position(loose.columns()[p], 3)] = 0.;
    }
  not_a_number.values[not_a_number.position(7, 7)] = nan;
  for (int members = 1; members <= size; ++members)
    {
      const auto         group = std::make_shared<const feti::CoarseGroup>(MPI_COMM_WORLD, members);
      feti::SparseFactor factor(good, feti::MatrixKind::coarse, feti::Factorization::CHOLMOD,
                                nullptr, group);
      for (const auto *bad : {&loose, &not_a_number})
        {
          expect_clear(failure_reason(factor, *bad));
          ASSERT_EQ(failure_reason(factor, good), "");
          expect_inverse(good, factor);
        }
    }
  PetscPopErrorHandler();
}

TEST(TeamFactors, AreMadeWhereTheyAreFaster)
{
  int size;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  const auto members = [](const unsigned int n_rows, const unsigned int wanted) {
    const auto group = feti::coarse_group(MPI_COMM_WORLD, n_rows, feti::MatrixKind::coarse, wanted);
    return group ? group->size() : 1;
  };
  EXPECT_EQ(members(1000, 0), 1);
  EXPECT_EQ(members(1000000, 0), size < 4 ? 1 : size);
  EXPECT_EQ(members(1000000, 1), 1);
  EXPECT_EQ(members(1000, 100), size);
  const PetscOption package("-coarse_pc_factor_mat_solver_type", "cholmod");
  EXPECT_EQ(members(1000, 2), 1);
}

/// The Laplacian of a square with more rows than one rank factorizes alone, if there are 4 ranks.
TEST(TeamFactors, SolveWhatIsTooLargeForOneRank)
{
  const PetscInt                     n = 160;
  std::vector<std::vector<PetscInt>> rows(n * n);
  const auto add_neighbours = [&](const PetscInt row, const PetscInt i, const PetscInt j) {
    for (const auto &[k, l] : {std::pair(i - 1, j), {i, j - 1}, {i, j}, {i, j + 1}, {i + 1, j}})
      if (k >= 0 && k < n && l >= 0 && l < n)
        rows[row].push_back(k * n + l);
  };
  for (PetscInt i = 0; i < n; ++i)
    for (PetscInt j = 0; j < n; ++j)
      add_neighbours(i * n + j, i, j);
  auto A = feti::CsrMatrix::from_rows(rows, n * n);
  for (PetscInt row = 0; row < n * n; ++row)
    for (const PetscInt column : rows[row])
      A.values[A.position(row, column)] = row == column ? 4. : -1.;
  const auto group = feti::coarse_group(MPI_COMM_WORLD, n * n, feti::MatrixKind::coarse, 0);
  int        size;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  ASSERT_EQ(group != nullptr, size >= 4);
  feti::SparseFactor factor(A, feti::MatrixKind::coarse, feti::Factorization::CHOLMOD, nullptr,
                            group);
  ASSERT_EQ(failure_reason(factor, A), "");
  expect_inverse(A, factor);
}

TEST_P(Factors, UnitsAreNoErrors)
{
  auto       K    = truss_on_springs();
  const auto good = K.values;
  for (const double unit : {1e-290, 1e-30, 1., 1e30, 1e280})
    {
      for (std::size_t p = 0; p < good.size(); ++p)
        K.values[p] = unit * good[p];
      feti::SparseFactor factor(K, feti::MatrixKind::kplus, GetParam());
      ASSERT_EQ(failure_reason(factor, K), "") << unit;
      expect_inverse(K, factor);
    }
}

TEST_P(Factors, AnEmptyMatrixHasAnEmptyInverse)
{
  const auto         empty = feti::CsrMatrix::from_rows({}, 0);
  feti::SparseFactor factor(empty, feti::MatrixKind::kplus, GetParam());
  EXPECT_EQ(failure_reason(factor, empty), "");
  expect_inverse(empty, factor);
}

bool is_unused(const std::string &option)
{
  const auto unused = petsc::unused_options(MPI_COMM_SELF);
  return std::find(unused.begin(), unused.end(), option) != unused.end();
}

TEST_P(Factors, PetscOptionsOfAPrefixChooseThePackage)
{
  const auto K = truss_on_springs();
  for (const std::string kind : {"cholesky", "lu"})
    for (const std::string package : {"petsc", "mumps", "cholmod", "superlu"})
      {
        const PetscOption kind_option("-dirichlet_pc_type", kind),
          package_option("-dirichlet_pc_factor_mat_solver_type", package);
        SCOPED_TRACE(package + " " + kind);
        if (package == (kind == "lu" ? "cholmod" : "superlu")) // which PETSc lacks
          {
            EXPECT_THROW(feti::SparseFactor(K, feti::MatrixKind::dirichlet, GetParam()),
                         InputError);
            EXPECT_THROW(feti::check_factor_options(GetParam()), InputError);
            continue;
          }
        EXPECT_NO_THROW(feti::check_factor_options(GetParam()));
        feti::SparseFactor factor(K, feti::MatrixKind::dirichlet, GetParam());
        ASSERT_EQ(failure_reason(factor, K), "");
        expect_inverse(K, factor);
        // those of another matrix do not hold
        feti::SparseFactor other(K, feti::MatrixKind::kplus, GetParam());
        ASSERT_EQ(failure_reason(other, K), "");
        expect_inverse(K, other);
      }
  const PetscOption wrong("-kplus_pc_type", "jacobi");
  EXPECT_THROW(feti::check_factor_options(GetParam()), InputError);
}

TEST_P(Factors, PetscOptionsNobodyAskedForAreKnown)
{
  const PetscOption asked("-kplus_pc_factor_mat_ordering_type", "rcm"),
    methods("-kplus_mat_cholmod_nmethods", "2"), fill("-kplus_mat_mumps_icntl_7", "0"),
    misspelt("-kplus_pc_factor_solver", "mumps"), flag("-k_plus", "");
  const auto         K = truss_on_springs();
  feti::SparseFactor factor(K, feti::MatrixKind::kplus, GetParam());
  ASSERT_EQ(failure_reason(factor, K), "");
  expect_inverse(K, factor);
  EXPECT_FALSE(is_unused("-kplus_pc_factor_mat_ordering_type rcm"));
  EXPECT_EQ(is_unused("-kplus_mat_cholmod_nmethods 2"), GetParam() != feti::Factorization::CHOLMOD);
  EXPECT_EQ(is_unused("-kplus_mat_mumps_icntl_7 0"), GetParam() != feti::Factorization::MUMPS);
  EXPECT_TRUE(is_unused("-kplus_pc_factor_solver mumps"));
}

TEST_P(Factors, OneBadSubdomainIsAnErrorOnAllRanks)
{
  feti::FetiParameters parameters;
  parameters.factorization = GetParam();
  TornTruss  truss(false, false);
  const auto good = truss.systems;
  for (unsigned int s = 0; s < truss.systems.size(); ++s)
    for (const double bad : {-1e6, nan})
      {
        truss.systems              = good;
        auto &K                    = truss.systems[s].K;
        K.values[K.position(7, 7)] = bad;
        std::string       message  = "no error";
        const std::string begin = "the stiffness of subdomain " + std::to_string(s) + " of body " +
                                  (s < 4 ? "foundation" : "punch");
        try
          {
            truss.make(parameters);
          }
        catch (const SolveError &error)
          {
            message = error.what();
          }
        EXPECT_NE(message.find(begin), std::string::npos) << message;
        EXPECT_NE(message.find("look for degenerate cells"), std::string::npos) << message;
      }
  truss.systems = good;
  EXPECT_NO_THROW(truss.make(parameters));
}

INSTANTIATE_TEST_SUITE_P(SparseFactor,
                         Factors,
                         ::testing::Values(feti::Factorization::CHOLMOD,
                                           feti::Factorization::MUMPS));
} // namespace
