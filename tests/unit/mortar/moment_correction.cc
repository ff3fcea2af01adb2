#include <snug/mortar/moment_correction.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace snug;
using namespace snug::mortar;

namespace {
/// A slave node and some master nodes on a curved face, with forces whose sum is zero.
template <int dim>
struct RowOfNodes
{
  using Vector = std::array<double, dim>;

  std::vector<Vector> x;
  std::vector<double> coefficients, weights;
  Vector              n{};

  explicit RowOfNodes(unsigned int seed)
  {
    std::mt19937                           random(seed);
    std::uniform_real_distribution<double> uniform(-1., 1.);
    double                                 sum = 0.;
    for (unsigned int k = 0; k < 6; ++k)
      {
        x.emplace_back();
        for (double &c : x.back())
          c = uniform(random);
        weights.push_back(k == 0 ? 0. : 0.1 + std::abs(uniform(random)));
        coefficients.push_back(k == 0 ? 1. : -std::abs(uniform(random)));
        sum += coefficients.back();
      }
    coefficients[0] -= sum;
    double square = 0.;
    for (double &c : n)
      {
        c = uniform(random);
        square += c * c;
      }
    for (double &c : n)
      c /= std::sqrt(square);
  }

  MomentCorrection<dim, double> correction() const { return {x, coefficients, weights, n}; }
};

template <int dim>
void expect_no_moment(unsigned int seed)
{
  const RowOfNodes<dim>   row(seed);
  const auto              dM    = row.correction().masses();
  double                  total = 0., along = 0.;
  std::array<double, dim> lever{};
  for (unsigned int k = 0; k < row.x.size(); ++k)
    {
      total += dM[k];
      for (int i = 0; i < dim; ++i)
        lever[i] -= (row.coefficients[k] - dM[k]) * row.x[k][i];
    }
  EXPECT_EQ(dM[0], 0.);
  EXPECT_NEAR(total, 0., 1e-14);
  for (int i = 0; i < dim; ++i)
    along += lever[i] * row.n[i];
  for (int i = 0; i < dim; ++i)
    EXPECT_NEAR(lever[i], along * row.n[i], 1e-13);
}

/// gradient() against differences of fourth order, in all that a correction is made of; the normal
/// stays a unit vector.
template <int dim>
void expect_gradient(unsigned int seed)
{
  const RowOfNodes<dim> row(seed);
  const RowOfNodes<dim> other(seed + 100);
  const auto           &q        = other.weights;
  const auto            gradient = row.correction().gradient(q);
  const auto            value    = [&](double t) {
    RowOfNodes<dim> moved  = row;
    double          square = 0.;
    for (unsigned int k = 0; k < row.x.size(); ++k)
      {
        moved.coefficients[k] += t * other.coefficients[k];
        moved.weights[k] += t * other.weights[k];
        for (int i = 0; i < dim; ++i)
          moved.x[k][i] += t * other.x[k][i];
      }
    for (int i = 0; i < dim; ++i)
      {
        moved.n[i] += t * other.n[i];
        square += moved.n[i] * moved.n[i];
      }
    for (double &c : moved.n)
      c /= std::sqrt(square);
    const auto dM  = moved.correction().masses();
    double     sum = 0.;
    for (unsigned int k = 0; k < dM.size(); ++k)
      sum += q[k] * dM[k];
    return sum;
  };
  const double h = 1e-4;
  const double slope =
    (value(-2. * h) - 8. * value(-h) + 8. * value(h) - value(2. * h)) / (12. * h);
  double exact = 0., along = 0.;
  for (int i = 0; i < dim; ++i)
    along += row.n[i] * other.n[i];
  for (unsigned int k = 0; k < row.x.size(); ++k)
    {
      exact +=
        gradient.coefficients[k] * other.coefficients[k] + gradient.weights[k] * other.weights[k];
      for (int i = 0; i < dim; ++i)
        exact += gradient.x[k][i] * other.x[k][i];
    }
  for (int i = 0; i < dim; ++i)
    exact += gradient.n[i] * (other.n[i] - along * row.n[i]);
  EXPECT_NEAR(exact, slope, 1e-9 * std::max(1., std::abs(slope)));
}
} // namespace

TEST(MomentCorrection, RowsHaveNoMomentAndKeepTheirSum)
{
  for (unsigned int seed = 0; seed < 20; ++seed)
    {
      expect_no_moment<2>(seed);
      expect_no_moment<3>(seed);
    }
}

TEST(MomentCorrection, GradientIsThatOfDifferences)
{
  for (unsigned int seed = 0; seed < 20; ++seed)
    {
      expect_gradient<2>(seed);
      expect_gradient<3>(seed);
    }
}
