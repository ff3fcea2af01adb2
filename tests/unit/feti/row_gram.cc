#include <snug/feti/row_gram.h>

#include <gtest/gtest.h>
#include <unit/feti/torn_truss.h>

#include <random>

namespace {
using namespace snug;
using namespace snug::test;

/// Contact rows node to node, which share no nodes, and node to segment, which share nodes. Slopes
/// couple the rows of both directions.
class RowGrams : public ::testing::TestWithParam<bool>
{
protected:
  RowGrams()
  {
    problem                                  = truss.make({});
    const feti::Linearization &linearization = problem->linearization();
    const auto                &systems       = linearization.subdomains();
    const feti::RowLayout     &layout        = truss.row_layout();
    std::vector<double>        values;
    for (unsigned int s = 0; s < systems.size(); ++s)
      for (const auto &entry : linearization.B()[s])
        {
          values.push_back(entry.value);
          values.push_back(1. / systems[s].K.diagonal(entry.dof));
        }
    structure = std::make_unique<feti::RowGramStructure>(layout, linearization.table());
    gram      = std::make_unique<feti::RowGram>(*structure, layout.gather_entries(2, values), 2);
  }

  /// Return the multipliers of all rows with random values in the rows of @p rows.
  qp::MultiVector random(const qp::RowSet &rows)
  {
    std::uniform_real_distribution<double> uniform(-1., 1.);
    qp::MultiVector                        z(truss.n_rows());
    for (unsigned int i = 0; i < z.n_rows(); ++i)
      z(i) = rows[i] ? uniform(generator) : 0.;
    return z;
  }

  /// Return W_M z from the matrices of the whole truss.
  qp::MultiVector W(const qp::RowSet &M, const qp::MultiVector &z) const
  {
    qp::MultiVector result(truss.n_rows());
    for (unsigned int j = 0; j < truss.K.m(); ++j)
      {
        double sum = 0.;
        for (unsigned int i = 0; i < z.n_rows(); ++i)
          sum += M[i] ? truss.B(i, j) * z(i) / truss.K(j, j) : 0.;
        for (unsigned int i = 0; i < z.n_rows(); ++i)
          result(i) += M[i] ? truss.B(i, j) * sum : 0.;
      }
    return result;
  }

  qp::MultiVector solve(const qp::RowSet &M, const qp::MultiVector &x) const
  {
    auto owned = truss.owned(x);
    gram->solve(truss.owned(M), owned);
    return truss.gathered(owned);
  }

  /// All rows, and every second contact.
  std::vector<qp::RowSet> sets() const
  {
    std::vector<qp::RowSet> result(2, qp::RowSet(truss.n_rows(), 1));
    for (unsigned int i = 0; i < truss.n_rows(); ++i)
      result[1][i] = !truss.bounded[i] || i % 2 == 0;
    return result;
  }

  TornTruss                               truss{true, GetParam(), 0.3, 0.4};
  std::unique_ptr<feti::LoadedProblem>    problem;
  std::unique_ptr<feti::RowGramStructure> structure;
  std::unique_ptr<feti::RowGram>          gram;
  std::mt19937                            generator{7};
};

/// The error of multipliers of equality rows is round-off, that of contact rows is the error of the
/// polynomial.
TEST_P(RowGrams, AreInverted)
{
  for (const qp::RowSet &M : sets())
    {
      qp::RowSet equalities(truss.n_rows());
      for (unsigned int i = 0; i < truss.n_rows(); ++i)
        equalities[i] = !truss.bounded[i];
      for (const bool of_equalities : {true, false})
        {
          const auto z      = random(of_equalities ? equalities : M);
          auto       found  = solve(M, W(M, z));
          double     square = 0., error = 0.;
          for (unsigned int i = 0; i < z.n_rows(); ++i)
            {
              EXPECT_TRUE(M[i] || found(i) == 0.);
              square += z(i) * z(i);
              error += (found(i) - z(i)) * (found(i) - z(i));
            }
          const bool is_exact = of_equalities || !GetParam();
          EXPECT_LE(std::sqrt(error / square), is_exact ? 1e-11 : 0.06);
        }
    }
}

TEST_P(RowGrams, InversesAreSymmetricAndPositive)
{
  for (const qp::RowSet &M : sets())
    {
      const auto   x = random(M), y = random(M);
      const double of_x = qp::transpose_times(x, solve(M, x))(0);
      EXPECT_GT(of_x, 0.);
      EXPECT_NEAR(qp::transpose_times(x, solve(M, y))(0), qp::transpose_times(y, solve(M, x))(0),
                  1e-12 * of_x);
    }
}

INSTANTIATE_TEST_SUITE_P(RowGram, RowGrams, ::testing::Bool(), [](const auto &test) {
  return std::string(test.param ? "NodeToSegment" : "NodeToNode");
});
} // namespace
