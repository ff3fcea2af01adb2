#include <snug/feti/generalized_inverse.h>
#include <snug/feti/local_schur.h>

#include <gtest/gtest.h>
#include <unit/feti/truss_block.h>

#include <random>

namespace {
using namespace snug;
using namespace snug::test;

std::vector<feti::SubdomainSystem> examples()
{
  return {truss_system(Block(0, {0, 0}, {4, 3}), {2., 1.}),
          truss_system(Block(1, {1, 0, 2}, {3, 3, 5}), {2., 1., 3.})};
}

qp::MultiVector random_columns(unsigned int n, unsigned int k)
{
  std::mt19937                           generator(11);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  qp::MultiVector                        x(n, k);
  for (unsigned int j = 0; j < k; ++j)
    for (unsigned int i = 0; i < n; ++i)
      x(i, j) = uniform(generator);
  return x;
}

qp::MultiVector times(const feti::CsrMatrix &A, const qp::MultiVector &x)
{
  qp::MultiVector y(A.n_rows(), x.n_columns());
  A.multiply_add(1., x, y);
  return y;
}

double largest(const qp::MultiVector &x)
{
  double value = 0.;
  for (unsigned int j = 0; j < x.n_columns(); ++j)
    for (unsigned int i = 0; i < x.n_rows(); ++i)
      value = std::max(value, std::abs(x(i, j)));
  return value;
}

class Packages : public ::testing::TestWithParam<feti::Factorization>
{
protected:
  std::ostringstream  log;
  RunContext          context{MPI_COMM_WORLD, log};
  feti::FillOrderings orderings;
  feti::FactorPool    factors{feti::MatrixKind::kplus, GetParam(), &orderings, &context.work};
};

TEST_P(Packages, InvertsOnTheRange)
{
  for (const auto &system : examples())
    {
      // the kernel is what the geometry says
      EXPECT_LT(largest(times(system.K, system.R)), 1e-12);
      const feti::GeneralizedInverse inverse(system, factors, context, "test");
      const auto                     x  = random_columns(system.n_dofs(), 3);
      const auto                     Kx = times(system.K, x);
      qp::MultiVector                y(system.n_dofs(), 3);
      inverse.apply(Kx, y);
      auto error = times(system.K, y);
      error.add(-1., Kx);
      EXPECT_LT(largest(error), 1e-12 * largest(Kx));
    }
  EXPECT_EQ(context.work.symbolic_factorizations, 2u);
  EXPECT_EQ(context.work.numeric_factorizations, 2u);
}

TEST_P(Packages, FollowsNewNumbers)
{
  auto system = examples()[0];
  feti::GeneralizedInverse(system, factors, context, "test");
  for (double &value : system.K.values)
    value *= 7.;
  const feti::GeneralizedInverse inverse(system, factors, context, "test");
  const auto                     x  = random_columns(system.n_dofs(), 1);
  const auto                     Kx = times(system.K, x);
  qp::MultiVector                y(system.n_dofs());
  inverse.apply(Kx, y);
  auto error = times(system.K, y);
  error.add(-1., Kx);
  EXPECT_LT(largest(error), 1e-12 * largest(Kx));
  EXPECT_EQ(context.work.symbolic_factorizations, 1u);
}

/// Subdomains of a grid have the same K, and matrices R that differ by rounding.
TEST_P(Packages, CongruentSubdomainsShareTheirInverse)
{
  const auto system = examples()[1];
  auto       other  = system;
  for (unsigned int mode = 0; mode < other.R.n_columns(); ++mode)
    for (unsigned int i = 0; i < other.n_dofs(); ++i)
      other.R(i, mode) *= 1. + 1e-15 * (i % 3);
  auto first  = std::make_unique<feti::GeneralizedInverse>(system, factors, context, "test");
  auto second = std::make_unique<feti::GeneralizedInverse>(other, factors, context, "test");
  EXPECT_EQ(context.work.numeric_factorizations, 1u);
  const auto      Kx = times(system.K, random_columns(system.n_dofs(), 1));
  qp::MultiVector y(system.n_dofs()), z(system.n_dofs());
  // also where one of them is gone
  first->apply(Kx, y);
  other.K.values[0] *= 1. + 1e-15;
  first.reset();
  second->apply(Kx, z);
  EXPECT_EQ(largest(y), largest(z));
  second.reset();
  second = std::make_unique<feti::GeneralizedInverse>(other, factors, context, "test");
  EXPECT_EQ(context.work.numeric_factorizations, 2u);
  EXPECT_EQ(context.work.symbolic_factorizations, 1u);
}

INSTANTIATE_TEST_SUITE_P(GeneralizedInverse,
                         Packages,
                         ::testing::Values(feti::Factorization::CHOLMOD,
                                           feti::Factorization::MUMPS));

TEST(LocalSchur, IsTheSchurComplement)
{
  auto system = examples()[0];
  // rows at the nodes with x = 0, and one inside
  for (unsigned int dof = 0; dof < system.n_dofs(); ++dof)
    if (dof % 10 < 2 || dof == 15)
      system.boundary.push_back(dof);
  std::ostringstream      log;
  RunContext              context(MPI_COMM_WORLD, log);
  const feti::FactorCache cache(feti::Factorization::CHOLMOD, context);
  for (const bool lumped : {false, true})
    {
      const feti::LocalSchur schur(system, lumped, cache, "test");
      const auto            &position = schur.boundary_position();
      const auto             x        = random_columns(schur.n_boundary(), 2);
      const auto             y        = schur.apply(x);
      // energy of the best extension of x: K at the boundary rows of the u
      // whose other rows vanish
      qp::MultiVector inner(system.n_dofs(), 2);
      Matrix          K(system.n_dofs(), system.n_dofs());
      for (unsigned int i = 0; i < K.m(); ++i)
        for (PetscInt p = system.K.row_start()[i]; p < system.K.row_start()[i + 1]; ++p)
          K(i, system.K.columns()[p]) = system.K.values[p];
      Matrix extended = K;
      for (unsigned int i = 0; i < K.m(); ++i)
        if (position[i] < schur.n_boundary())
          for (unsigned int j = 0; j < K.m(); ++j)
            extended(i, j) = i == j;
      extended.gauss_jordan();
      for (unsigned int k = 0; k < 2; ++k)
        for (unsigned int i = 0; i < K.m(); ++i)
          for (unsigned int j = 0; j < K.m(); ++j)
            if (position[j] < schur.n_boundary() && (!lumped || i == j))
              inner(i, k) += (lumped ? 1. : extended(i, j)) * x(position[j], k);
      const auto forces = times(system.K, inner);
      for (unsigned int k = 0; k < 2; ++k)
        for (unsigned int i = 0; i < K.m(); ++i)
          if (position[i] < schur.n_boundary())
            {
              EXPECT_NEAR(y(position[i], k), forces(i, k), 1e-10);
            }
    }
}

/// Many rows along one axis leave a body free to move along the others.
TEST(LocalSchur, HoldsWhereRowsLeaveRigidMotions)
{
  std::ostringstream      log;
  RunContext              context(MPI_COMM_WORLD, log);
  const feti::FactorCache cache(feti::Factorization::CHOLMOD, context);
  for (auto system : examples())
    {
      const unsigned int dim = system.R.n_columns() == 3 ? 2 : 3;
      for (unsigned int dof = dim - 1; dof < system.n_dofs(); dof += dim)
        if (dof < system.n_dofs() / 2)
          system.boundary.push_back(dof);
      const feti::LocalSchur schur(system, false, cache, "the body");
      EXPECT_GT(schur.n_boundary(), system.boundary.size());
    }
}
} // namespace
