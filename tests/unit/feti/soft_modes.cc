#include <snug/feti/soft_modes.h>
#include <snug/qp/row_set.h>

#include <gtest/gtest.h>
#include <unit/feti/torn_truss.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <random>

namespace {
using namespace snug;
using namespace snug::test;

/// B without contact rows, B_D = W^-1 B D^-1 and P_D = B_D'B, dense.
struct DenseJumps
{
  Matrix B_D, P;

  explicit DenseJumps(const TornTruss &truss)
  {
    const unsigned int n = truss.K.m(), n_rows = truss.n_rows();
    Matrix             B = truss.B, BD(n_rows, n);
    for (unsigned int i = 0; i < n_rows; ++i)
      for (unsigned int j = 0; j < n; ++j)
        {
          B(i, j)  = truss.bounded[i] ? 0. : B(i, j);
          BD(i, j) = B(i, j) / truss.K(j, j);
        }
    Matrix W = product(BD, transposed(B));
    for (unsigned int i = 0; i < n_rows; ++i)
      if (truss.bounded[i])
        W(i, i) = 1.;
    W.gauss_jordan();
    B_D = product(W, BD);
    P   = product(transposed(B_D), B);
  }
};

class SoftModes : public ::testing::TestWithParam<std::pair<bool, bool>>
{
protected:
  SoftModes()
  {
    feti::FetiParameters parameters;
    problem                     = truss.make(parameters);
    const auto         &layout  = truss.row_layout();
    const auto         &systems = problem->linearization().subdomains();
    std::vector<double> values;
    for (unsigned int s = 0; s < systems.size(); ++s)
      for (const auto &entry : problem->linearization().B()[s])
        {
          values.push_back(entry.value);
          values.push_back(1. / systems[s].K.diagonal(entry.dof));
        }
    const auto                   entries = layout.gather_entries(2, values);
    const feti::RowGramStructure structure(layout, problem->linearization().table());
    const feti::RowGram          gram(structure, entries, 2);
    unsigned int                 mine = systems.size();
    MPI_Scan(&mine, &first, 1, MPI_UNSIGNED, MPI_SUM, MPI_COMM_WORLD);
    first -= mine;
    columns = feti::jump_operator(layout, gram, entries, 2, problem->linearization().table(), mine);
  }

  /// P_D on the unknowns of block t and those of block s.
  Matrix block_of_P(unsigned int t, unsigned int s) const
  {
    Matrix P(truss.start[t + 1] - truss.start[t], truss.start[s + 1] - truss.start[s]);
    for (unsigned int i = 0; i < P.m(); ++i)
      for (unsigned int j = 0; j < P.n(); ++j)
        P(i, j) = dense.P(truss.start[t] + i, truss.start[s] + j);
    return P;
  }

  TornTruss                            truss{GetParam().first, GetParam().second, 0., 0.2};
  DenseJumps                           dense{truss};
  std::unique_ptr<feti::LoadedProblem> problem;
  unsigned int                         first = 0;
  std::vector<feti::JumpColumns>       columns;
};

TEST_P(SoftModes, ColumnsOfTheJumpOperator)
{
  for (unsigned int s = 0; s < columns.size(); ++s)
    {
      Matrix B_D(truss.n_rows(), problem->linearization().subdomains()[s].n_dofs());
      Matrix P(truss.K.m(), B_D.n());
      for (unsigned int i = 0; i < columns[s].size(); ++i)
        {
          const auto &column = columns[s][i];
          EXPECT_TRUE(i == 0 || columns[s][i - 1].dof < column.dof);
          for (const auto &force : column.forces)
            B_D(force.row, column.dof) += force.value;
          for (const auto &copy : column.copies)
            P(truss.start[copy.subdomain] + copy.dof, column.dof) += copy.value;
        }
      for (unsigned int j = 0; j < B_D.n(); ++j)
        {
          for (unsigned int i = 0; i < B_D.m(); ++i)
            EXPECT_NEAR(B_D(i, j), dense.B_D(i, truss.start[first + s] + j), 1e-12);
          for (unsigned int i = 0; i < P.m(); ++i)
            EXPECT_NEAR(P(i, j), dense.P(i, truss.start[first + s] + j), 1e-12);
        }
    }
}

TEST_P(SoftModes, StiffnessOfNeighbours)
{
  const auto found = feti::stiffness_of_neighbours(problem->linearization().subdomains(), columns,
                                                   first, MPI_COMM_WORLD);
  for (unsigned int s = 0; s < columns.size(); ++s)
    {
      const unsigned int n = problem->linearization().subdomains()[s].n_dofs();
      Matrix             expected(n, n), sum(n, n);
      for (unsigned int t = 0; t < truss.blocks.size(); ++t)
        if (t != first + s)
          {
            const Matrix P = block_of_P(t, first + s);
            expected.add(1., product(transposed(P), product(dense_stiffness(truss.blocks[t]), P)));
          }
      for (const auto &entry : found[s])
        sum(entry.i, entry.j) += entry.value;
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          EXPECT_NEAR(sum(i, j), expected(i, j), 1e-10 * expected.linfty_norm());
    }
}

/// Eigenvalues of A v = mu K v for v that are A-orthogonal to the rigid motions, descending.
std::vector<double> eigenvalues(const Matrix &A, const Matrix &K, const qp::MultiVector &rigid)
{
  const unsigned int n = A.m(), m = rigid.n_columns();
  Matrix             R(n, m);
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < m; ++j)
      R(i, j) = rigid(i, j);
  const Matrix RR = product(R, transposed(R)), AR = product(A, R);
  Matrix       K_pseudo = K, RAR = product(transposed(R), AR);
  K_pseudo.add(1., RR);
  K_pseudo.gauss_jordan();
  K_pseudo.add(-1., RR);
  RAR.gauss_jordan();
  Matrix A_off = A;
  A_off.add(-1., product(AR, product(RAR, transposed(AR))));
  dealii::LAPACKFullMatrix<double> matrix(n);
  matrix = product(A_off, K_pseudo);
  matrix.compute_eigenvalues();
  std::vector<double> values;
  for (unsigned int i = 0; i < n; ++i)
    values.push_back(matrix.eigenvalue(i).real());
  std::sort(values.rbegin(), values.rend());
  return values;
}

/// S of all unknowns with an entry in B; zero at the others.
Matrix dense_schur(const std::vector<feti::BEntry> &B, const Matrix &K)
{
  const unsigned int        n = K.m();
  std::vector<bool>         on_boundary(n, false);
  std::vector<unsigned int> inner;
  for (const auto &entry : B)
    on_boundary[entry.dof] = true;
  for (unsigned int i = 0; i < n; ++i)
    if (!on_boundary[i])
      inner.push_back(i);
  Matrix S = K, K_ii(inner.size(), inner.size()), K_i(inner.size(), n);
  for (unsigned int i = 0; i < inner.size(); ++i)
    {
      for (unsigned int j = 0; j < inner.size(); ++j)
        K_ii(i, j) = K(inner[i], inner[j]);
      for (unsigned int j = 0; j < n; ++j)
        K_i(i, j) = K(inner[i], j);
    }
  if (inner.empty())
    return S;
  K_ii.gauss_jordan();
  S.add(-1., product(transposed(K_i), product(K_ii, K_i)));
  return S;
}

TEST_P(SoftModes, AreTheEigenvectorsOfTheJumps)
{
  RunContext              context(MPI_COMM_SELF, std::cout);
  const feti::FactorCache cache(feti::Factorization::CHOLMOD, context);
  const auto             &linearization = problem->linearization();
  const auto   neighbours = feti::stiffness_of_neighbours(problem->linearization().subdomains(),
                                                          columns, first, MPI_COMM_WORLD);
  unsigned int n_modes    = 0;
  for (unsigned int s = 0; s < columns.size(); ++s)
    {
      const auto &system = problem->linearization().subdomains()[s];
      const auto &B      = linearization.B()[s];
      const auto  modes  = feti::soft_modes(
        system, feti::SubdomainFactors(system, feti::Preconditioner::Dirichlet, cache, "K"),
        columns[s], neighbours[s], first + s);

      const Matrix K = dense_stiffness(truss.blocks[first + s]),
                   P = block_of_P(first + s, first + s);
      Matrix A       = product(transposed(P), product(dense_schur(B, K), P));
      for (const auto &entry : neighbours[s])
        A(entry.i, entry.j) += entry.value;
      const auto expected = eigenvalues(A, K, system.R);
      for (unsigned int k = 0; k < modes.mu.size(); ++k)
        EXPECT_NEAR(modes.mu[k], expected[k], 1e-3 * expected[k]);
      EXPECT_LE(expected[modes.mu.size()], 4.001);
      n_modes += modes.mu.size();
    }
  MPI_Allreduce(MPI_IN_PLACE, &n_modes, 1, MPI_UNSIGNED, MPI_SUM, MPI_COMM_WORLD);
  EXPECT_GE(n_modes, 6u); // flat cells have some
}

INSTANTIATE_TEST_SUITE_P(,
                         SoftModes,
                         ::testing::Values(std::make_pair(false, false),
                                           std::make_pair(true, true)));

class Deflation : public ::testing::TestWithParam<std::pair<bool, bool>>
{
protected:
  Deflation()
  {
    feti::FetiParameters parameters;
    parameters.soft_modes = feti::SoftModesOf::all;
    problem               = truss.make(parameters);
    // contact rows of every second node alone
    mask           = truss.bounded;
    unsigned int n = 0;
    for (auto &free : mask)
      free = free ? n++ % 2 : 1;
    free_set = problem->free_set(truss.owned(mask));
  }

  qp::MultiVector random_projected(unsigned int k) const
  {
    std::mt19937    generator(3);
    qp::MultiVector x(truss.n_rows(), k);
    for (unsigned int j = 0; j < k; ++j)
      for (unsigned int i = 0; i < truss.n_rows(); ++i)
        x(i, j) = double(generator()) / double(std::mt19937::max()) - 0.5;
    auto mine = truss.owned(x);
    free_set->project(mine);
    return mine;
  }

  /// X'FX of columns in the range of the projector.
  qp::MultiVector energies(const qp::MultiVector &x) const
  {
    return qp::inner_products(x, problem->apply(x), MPI_COMM_WORLD);
  }

  TornTruss                            truss{GetParam().first, GetParam().second, 0., 0.2};
  qp::RowSet                           mask;
  std::unique_ptr<feti::LoadedProblem> problem;
  std::unique_ptr<qp::FreeSet>         free_set;
};

TEST_P(Deflation, IsTheFOrthogonalProjector)
{
  const auto x       = random_projected(2);
  auto       y       = x;
  const auto removed = free_set->deflate(y);
  // in the face still
  auto projected = y;
  free_set->project(projected);
  projected.add(-1., y);
  for (const double norm : qp::norms(projected, MPI_COMM_WORLD))
    EXPECT_LT(norm, 1e-10);
  // Pythagoras in the norm of F; what is removed is F-orthogonal to what is left
  const auto before = energies(x), after = energies(y);
  auto       difference = x;
  difference.add(-1., y);
  const auto mixed = qp::inner_products(difference, problem->apply(y), MPI_COMM_WORLD);
  for (unsigned int k = 0; k < 2; ++k)
    {
      EXPECT_GT(removed[k], 0.05 * before(k, k));
      EXPECT_NEAR(before(k, k) - after(k, k), removed[k], 1e-8 * before(k, k));
      for (unsigned int l = 0; l < 2; ++l)
        EXPECT_NEAR(mixed(k, l), 0., 1e-8 * before(k, k));
    }
  auto again = y;
  for (const double square : free_set->deflate(again))
    EXPECT_LT(square, 1e-12 * before(0, 0));
}

TEST_P(Deflation, MinimizesOverItsSpan)
{
  auto lambda   = random_projected(2);
  auto residual = random_projected(2);
  residual.add(-1., problem->apply(lambda));
  const auto start = lambda, start_residual = residual;
  free_set->minimize_over_deflated(lambda, residual);
  // the residual is that of the new lambda
  auto step = lambda;
  step.add(-1., start);
  auto expected = start_residual;
  expected.add(-1., problem->apply(step));
  auto error = expected;
  error.add(-1., residual);
  free_set->project(error);
  free_set->project(expected);
  const auto sizes = qp::norms(expected, MPI_COMM_WORLD), errors = qp::norms(error, MPI_COMM_WORLD),
             steps = qp::norms(step, MPI_COMM_WORLD);
  for (unsigned int k = 0; k < 2; ++k)
    {
      EXPECT_LT(errors[k], 1e-9 * sizes[k]);
      EXPECT_GT(steps[k], 0.);
    }
  // nothing is left to gain
  auto again = lambda;
  free_set->minimize_over_deflated(again, residual);
  again.add(-1., lambda);
  const auto more = qp::norms(again, MPI_COMM_WORLD);
  for (unsigned int k = 0; k < 2; ++k)
    EXPECT_LT(more[k], 1e-8 * steps[k]);
}

INSTANTIATE_TEST_SUITE_P(,
                         Deflation,
                         ::testing::Values(std::make_pair(false, false),
                                           std::make_pair(true, true)));
} // namespace
