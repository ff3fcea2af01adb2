#include <gtest/gtest.h>
#include <unit/feti/torn_truss.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <random>

namespace {
using namespace snug;
using namespace snug::test;

/// Moore-Penrose inverse of a singular symmetric A with orthonormal kernel N.
Matrix pseudo_inverse(const Matrix &A, const Matrix &N)
{
  const Matrix NN      = product(N, transposed(N));
  Matrix       inverse = A;
  inverse.add(1., NN);
  inverse.gauss_jordan();
  inverse.add(-1., NN);
  return inverse;
}

qp::MultiVector random_rows(const TornTruss &truss, unsigned int k)
{
  std::mt19937                           generator(5);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  qp::MultiVector                        x(truss.n_rows(), k);
  for (unsigned int j = 0; j < k; ++j)
    for (unsigned int i = 0; i < truss.n_rows(); ++i)
      x(i, j) = uniform(generator);
  return x;
}

qp::MultiVector times(const Matrix &A, const qp::MultiVector &x)
{
  qp::MultiVector y(A.m(), x.n_columns());
  for (unsigned int k = 0; k < x.n_columns(); ++k)
    for (unsigned int i = 0; i < A.m(); ++i)
      for (unsigned int j = 0; j < A.n(); ++j)
        y(i, k) += A(i, j) * x(j, k);
  return y;
}

void expect_near(const qp::MultiVector &a, const qp::MultiVector &b, double tolerance)
{
  ASSERT_EQ(a.n_rows(), b.n_rows());
  double error = 0., size = 0.;
  for (unsigned int k = 0; k < b.n_columns(); ++k)
    for (unsigned int i = 0; i < b.n_rows(); ++i)
      {
        error = std::max(error, std::abs(a(i, k) - b(i, k)));
        size  = std::max(size, std::abs(b(i, k)));
      }
  EXPECT_LE(error, tolerance * std::max(size, 1e-300));
}

/// Masks of all rows: all, equality rows only, one contact, two contacts.
std::vector<qp::RowSet> masks(const TornTruss &truss)
{
  std::vector<qp::RowSet> result(4, qp::RowSet(truss.n_rows(), 1));
  unsigned int            n = 0;
  for (unsigned int i = 0; i < truss.n_rows(); ++i)
    if (truss.bounded[i])
      {
        result[1][i] = 0;
        result[2][i] = n == 2;
        result[3][i] = n == 1 || n == 5;
        ++n;
      }
  return result;
}

class Trusses : public ::testing::TestWithParam<std::pair<bool, bool>>
{
protected:
  TornTruss truss{GetParam().first, GetParam().second};
};

TEST_P(Trusses, DualOperatorOnTheKernelOfG)
{
  // P F P with the Moore-Penrose inverse: any K^+ gives the same
  const auto   feti     = truss.make({});
  const Matrix K_pseudo = pseudo_inverse(truss.K, truss.R);
  const Matrix F        = product(truss.B, product(K_pseudo, transposed(truss.B)));
  const auto   free_set = feti->free_set(truss.owned(qp::RowSet(truss.n_rows(), 1)));
  auto         x        = truss.owned(random_rows(truss, 3));
  free_set->project(x);
  const unsigned long before = feti->context().work.f_mults;
  auto                Fx     = feti->apply(x);
  EXPECT_EQ(feti->context().work.f_mults - before, 3u);
  free_set->project(Fx);
  auto expected = truss.owned(times(F, truss.gathered(x)));
  free_set->project(expected);
  expect_near(truss.gathered(Fx), truss.gathered(expected), 1e-10);
}

/// K^+ of subdomains whose joints have equal moments: N (N'KN)^+ N' with an orthonormal basis N of
/// the displacements without jumps of the moments.
Matrix inverse_with_joints(const TornTruss &truss)
{
  const Matrix       joints = truss.joints();
  const unsigned int n      = truss.K.m();
  // of J'J and of K on N; the largest gap is that between zero and the others
  const auto eigenvectors = [](const Matrix &A, bool of_zero, std::vector<double> &values) {
    dealii::LAPACKFullMatrix<double> matrix(A.m());
    matrix = A;
    dealii::FullMatrix<double> vectors(A.m());
    dealii::Vector<double>     all(A.m());
    matrix.compute_eigenvalues_symmetric(-1e30, 1e30, 1e-14, all, vectors);
    const double          cut = 1e-9 * all(A.m() - 1);
    std::vector<unsigned> chosen;
    for (unsigned int i = 0; i < A.m(); ++i)
      if ((all(i) < cut) == of_zero)
        chosen.push_back(i);
    Matrix result(A.m(), chosen.size());
    for (unsigned int j = 0; j < chosen.size(); ++j)
      {
        values.push_back(all(chosen[j]));
        for (unsigned int i = 0; i < A.m(); ++i)
          result(i, j) = vectors(i, chosen[j]);
      }
    return result;
  };
  std::vector<double> zeros, values;
  const Matrix        N  = eigenvectors(product(transposed(joints), joints), true, zeros);
  const Matrix        V  = eigenvectors(product(transposed(N), product(truss.K, N)), false, values);
  Matrix              NV = product(N, V), scaled = NV;
  EXPECT_EQ(n - values.size() - (n - N.n()), 2u * 3u); // two clusters float
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < values.size(); ++j)
      scaled(i, j) /= values[j];
  return product(scaled, transposed(NV));
}

TEST_P(Trusses, DualOperatorOfClusters)
{
  truss.clustered   = true;
  const auto   feti = truss.make({});
  const Matrix F    = product(truss.B, product(inverse_with_joints(truss), transposed(truss.B)));
  const auto   free_set = feti->free_set(truss.owned(qp::RowSet(truss.n_rows(), 1)));
  EXPECT_EQ(feti->linearization().table().n_kernel(), 6u);
  auto x = truss.owned(random_rows(truss, 3));
  free_set->project(x);
  auto Fx = feti->apply(x);
  free_set->project(Fx);
  auto expected = truss.owned(times(F, truss.gathered(x)));
  free_set->project(expected);
  expect_near(truss.gathered(Fx), truss.gathered(expected), 1e-10);
}

TEST_P(Trusses, DualOperatorOfClustersIsSymmetric)
{
  truss.clustered = true;
  const auto feti = truss.make({});
  const auto x    = truss.owned(random_rows(truss, 4));
  const auto xFx  = qp::inner_products(x, feti->apply(x), MPI_COMM_WORLD);
  for (unsigned int i = 0; i < 4; ++i)
    for (unsigned int j = 0; j <= i; ++j)
      EXPECT_NEAR(xFx(i, j), xFx(j, i), 1e-11 * xFx(0, 0));
}

/// Gluing rows inside a cluster hold no body, not even by rounding errors.
TEST_P(Trusses, ClustersLeaveBodiesFree)
{
  const auto free_bodies = [this](const bool clustered) {
    truss.clustered = clustered;
    const auto feti = truss.make({});
    return feti::free_bodies(feti->linearization(), truss.owned(masks(truss)[1]));
  };
  const auto expected = free_bodies(false);
  EXPECT_FALSE(expected.empty());
  EXPECT_EQ(free_bodies(true), expected);
}

TEST_P(Trusses, CoarseSpaceIsRB)
{
  const auto   feti = truss.make({});
  const Matrix G    = product(transposed(truss.R), transposed(truss.B));
  const auto   x    = random_rows(truss, 2);
  expect_near(feti->apply_G(truss.owned(x)), times(G, x), 1e-12);
  qp::MultiVector alpha(feti->linearization().table().n_kernel(), 2);
  for (unsigned int i = 0; i < alpha.n_rows(); ++i)
    for (unsigned int k = 0; k < 2; ++k)
      alpha(i, k) = std::sin(3. * i + k);
  expect_near(truss.gathered(feti->apply_Gt(alpha)), times(transposed(G), alpha), 1e-12);
}

TEST_P(Trusses, ProjectorOnEveryFace)
{
  const auto feti = truss.make({});
  for (const auto &mask : masks(truss))
    {
      const auto free_set = feti->free_set(truss.owned(mask));
      auto       x        = truss.owned(random_rows(truss, 2));
      free_set->project(x);
      const auto all = truss.gathered(x);
      for (unsigned int i = 0; i < truss.n_rows(); ++i)
        EXPECT_TRUE(mask[i] || all(i) == 0.);
      const auto Gx = feti->apply_G(x);
      for (const double norm : qp::norms(Gx, MPI_COMM_SELF))
        EXPECT_LT(norm, 1e-11);
      auto PPx = x;
      free_set->project(PPx);
      expect_near(truss.gathered(PPx), truss.gathered(x), 1e-11);
      // x - P x is in the range of G_M', orthogonal to P y
      auto y    = truss.owned(random_rows(truss, 2));
      auto rest = y;
      for (unsigned int i = 0; i < rest.n_rows(); ++i)
        for (unsigned int k = 0; k < 2; ++k)
          rest(i, k) *= free_set->free_rows().rows()[i];
      auto Py = rest;
      free_set->project(Py);
      rest.add(-1., Py);
      const auto products = qp::inner_products(x, rest, MPI_COMM_WORLD);
      for (unsigned int k = 0; k < 2; ++k)
        EXPECT_NEAR(products(k, k), 0., 1e-10);
    }
}

/// The normals of the contacts, nearly parallel, hold the punch across them: by little, but forces
/// that they cannot balance are not to be called balanced, nor others that they can the opposite.
TEST(NearlyParallelNormals, HoldAndBalanceToTheLastDigits)
{
  for (const double slope : {1e-3, 1e-5, 1e-6})
    {
      TornTruss  truss(true, true, slope);
      const auto feti     = truss.make({});
      const auto free_set = feti->free_set(truss.owned(qp::RowSet(truss.n_rows(), 1)));
      const auto forces   = truss.owned(random_rows(truss, 1));
      const auto wrench   = feti->apply_G(forces);
      auto       x        = qp::MultiVector(feti->n_owned());
      EXPECT_LT(free_set->make_feasible(x, wrench)[0], 1e-13 * qp::norms(wrench, MPI_COMM_SELF)[0]);
      // The shortest of these forces is no longer than those that make the wrench.
      EXPECT_LT(qp::norms(x, MPI_COMM_WORLD)[0], qp::norms(forces, MPI_COMM_WORLD)[0]);
      auto part = forces;
      free_set->project(part);
      EXPECT_LT(qp::norms(feti->apply_G(part), MPI_COMM_SELF)[0], 1e-13) << slope;
      part.add(1., x);
      expect_near(truss.gathered(part), truss.gathered(forces), 1e-9);
    }
}

TEST_P(Trusses, FeasibilityTellsWhatAFaceCanHold)
{
  const auto   feti = truss.make({});
  const double load = qp::norms(feti->e(), MPI_COMM_SELF)[0];
  const auto   all  = masks(truss);
  for (unsigned int m = 0; m < all.size(); ++m)
    {
      const auto      free_set = feti->free_set(truss.owned(all[m]));
      qp::MultiVector x(feti->n_owned());
      const double    left = free_set->make_feasible(x, feti->e())[0];
      // nothing below, or one contact: the punch falls, or tips if it is not
      // guided (its rollers at one side resist turning)
      const bool held = m == 0 || m == 3 || (m == 2 && !GetParam().first);
      if (held)
        EXPECT_LT(left, 1e-10 * load);
      else
        EXPECT_GT(left, 1e-2 * load);
      auto missing = feti->e();
      missing.add(-1., feti->apply_G(x));
      EXPECT_NEAR(qp::norms(missing, MPI_COMM_SELF)[0], left, 1e-10 * load);
      if (m != 1)
        continue;
      // the falling punch closes all its contacts
      const auto &motions = free_set->unresisted_motions();
      const auto  rates   = feti->apply_Gt(times(motions, transpose_times(motions, feti->e())));
      for (unsigned int i = 0; i < rates.n_rows(); ++i)
        EXPECT_TRUE(!feti->bounded()[i] || rates(i) > 0.);
    }
}

TEST_P(Trusses, PreconditionerIsTheFormula)
{
  // M^-1 = W^-1 B D^-1 S D^-1 B' W^-1 on the rows of M, W = B D^-1 B'
  for (const auto scaling : {feti::Scaling::stiffness, feti::Scaling::multiplicity})
    for (const auto kind : {feti::Preconditioner::Dirichlet, feti::Preconditioner::lumped})
      {
        const auto         feti = truss.make({feti::Factorization::CHOLMOD, kind, scaling});
        const unsigned int n    = truss.K.m();
        std::vector<bool>  boundary(n, false);
        for (unsigned int i = 0; i < truss.n_rows(); ++i)
          for (unsigned int j = 0; j < n; ++j)
            boundary[j] = boundary[j] || truss.B(i, j) != 0.;
        // S x: K times the extension of x that is in balance inside
        Matrix extension = truss.K;
        for (unsigned int i = 0; i < n; ++i)
          if (boundary[i] || kind == feti::Preconditioner::lumped)
            for (unsigned int j = 0; j < n; ++j)
              extension(i, j) = i == j;
        extension.gauss_jordan();
        Matrix S = product(truss.K, extension);
        Matrix BD(truss.n_rows(), n);
        for (unsigned int i = 0; i < truss.n_rows(); ++i)
          for (unsigned int j = 0; j < n; ++j)
            BD(i, j) = truss.B(i, j) / (scaling == feti::Scaling::stiffness ? truss.K(j, j) : 1.);
        const Matrix BSB   = product(BD, product(S, transposed(BD)));
        const Matrix W_all = product(BD, transposed(truss.B));
        for (const auto &mask : masks(truss))
          {
            Matrix W = W_all;
            for (unsigned int i = 0; i < W.m(); ++i)
              for (unsigned int j = 0; j < W.m(); ++j)
                if (!mask[i] || !mask[j])
                  W(i, j) = i == j;
            W.gauss_jordan();
            auto x = random_rows(truss, 2);
            for (unsigned int i = 0; i < W.m(); ++i)
              for (unsigned int k = 0; k < 2; ++k)
                x(i, k) *= mask[i];
            auto y = times(BSB, times(W, x));
            for (unsigned int i = 0; i < W.m(); ++i)
              for (unsigned int k = 0; k < 2; ++k)
                y(i, k) *= mask[i];
            const auto expected = times(W, y);
            const auto free_set = feti->free_set(truss.owned(mask));
            // Contact rows that share nodes are inverted within 5 % on both sides, see ContactGram.
            const double tolerance = GetParam().second ? 0.1 : 1e-10;
            expect_near(truss.gathered(free_set->precondition(truss.owned(x))), expected,
                        tolerance);
          }
      }
}

TEST_P(Trusses, PreconditionerIsSymmetricPositive)
{
  const auto feti = truss.make({});
  for (const auto &mask : masks(truss))
    {
      const auto free_set = feti->free_set(truss.owned(mask));
      auto       x        = truss.owned(random_rows(truss, 6));
      free_set->project(x);
      auto z = free_set->precondition(x);
      free_set->project(z);
      const auto Q = qp::inner_products(x, z, MPI_COMM_WORLD);
      for (unsigned int i = 0; i < 6; ++i)
        {
          EXPECT_GT(Q(i, i), 0.);
          for (unsigned int j = 0; j < i; ++j)
            EXPECT_NEAR(Q(i, j), Q(j, i), 1e-11 * Q(i, i));
        }
    }
}

TEST_P(Trusses, PackagesAgree)
{
  const auto cholmod = truss.make(feti::FetiParameters());
  const auto d       = truss.gathered(cholmod->d());
  const auto x       = truss.owned(random_rows(truss, 2));
  const auto Fx      = truss.gathered(cholmod->apply(x));
  TornTruss  same(GetParam().first, GetParam().second);
  const auto mumps = same.make({feti::Factorization::MUMPS});
  expect_near(truss.gathered(mumps->d()), d, 1e-11);
  expect_near(truss.gathered(mumps->apply(x)), Fx, 1e-11);
}

/// K u = f - B' lambda for every feasible lambda and any amplitudes.
void expect_balance(TornTruss &truss)
{
  const auto      feti     = truss.make({});
  const auto      free_set = feti->free_set(truss.owned(masks(truss)[0]));
  auto            lambda   = truss.owned(random_rows(truss, 1));
  qp::MultiVector alpha(feti->linearization().table().n_kernel());
  for (unsigned int i = 0; i < alpha.n_rows(); ++i)
    alpha(i) = std::cos(2. * i);
  free_set->make_feasible(lambda, feti->e());
  const auto u      = feti->linearization().recover(feti->loads(), lambda, alpha);
  const auto forces = feti->linearization().multiply_Bt(lambda);
  for (unsigned int s = 0; s < u.size(); ++s)
    {
      const auto     &system   = feti->linearization().subdomains()[s];
      qp::MultiVector residual = forces[s];
      system.K.multiply_add(1., u[s], residual);
      for (unsigned int i = 0; i < system.n_dofs(); ++i)
        EXPECT_NEAR(residual(i), feti->loads()[s](i), 1e-10);
    }
}

TEST_P(Trusses, RecoveryIsInBalance)
{
  expect_balance(truss);
  truss.clustered = true;
  expect_balance(truss);
}

std::string truss_name(const ::testing::TestParamInfo<std::pair<bool, bool>> &info)
{
  return std::string(info.param.first ? "Floating" : "Guided") +
         (info.param.second ? "NodeToSegment" : "NodeToNode");
}

INSTANTIATE_TEST_SUITE_P(Linearization,
                         Trusses,
                         ::testing::Values(std::make_pair(false, false),
                                           std::make_pair(true, false),
                                           std::make_pair(false, true),
                                           std::make_pair(true, true)),
                         truss_name);
} // namespace
