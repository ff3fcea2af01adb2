#include <snug/mortar/moment_correction.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace snug;
using namespace snug::faces;
using namespace snug::mortar;

namespace {
/// A slave node and some master nodes on a curved face, with forces whose sum is zero.
template <int dim>
struct RowOfNodes
{
  using Vector = dealii::Tensor<1, dim>;

  std::vector<Vector> x;
  std::vector<double> coefficients, weights;
  Vector              n;

  explicit RowOfNodes(unsigned int seed)
  {
    std::mt19937                           random(seed);
    std::uniform_real_distribution<double> uniform(-1., 1.);
    double                                 sum = 0.;
    for (unsigned int k = 0; k < 6; ++k)
      {
        x.emplace_back();
        for (int i = 0; i < dim; ++i)
          x.back()[i] = uniform(random);
        weights.push_back(k == 0 ? 0. : 0.1 + std::abs(uniform(random)));
        coefficients.push_back(k == 0 ? 1. : -std::abs(uniform(random)));
        sum += coefficients.back();
      }
    coefficients[0] -= sum;
    for (int i = 0; i < dim; ++i)
      n[i] = uniform(random);
    n /= n.norm();
  }

  std::vector<double> correction() const { return moment_correction(x, coefficients, weights, n); }
};

template <int dim>
void expect_no_moment(unsigned int seed)
{
  const RowOfNodes<dim>  row(seed);
  const auto             dM    = row.correction();
  double                 total = 0.;
  dealii::Tensor<1, dim> lever;
  for (unsigned int k = 0; k < row.x.size(); ++k)
    {
      total += dM[k];
      lever -= (row.coefficients[k] - dM[k]) * row.x[k];
    }
  EXPECT_EQ(dM[0], 0.);
  EXPECT_NEAR(total, 0., 1e-14);
  EXPECT_NEAR((lever - (lever * row.n) * row.n).norm(), 0., 1e-13);
}

/// @p values as variables of @p recording.
std::vector<Recorded> variables(const std::vector<double> &values, Recording &recording)
{
  std::vector<Recorded> result;
  for (const double value : values)
    result.push_back(recording.variable(value));
  return result;
}

template <int dim>
dealii::Tensor<1, dim, Recorded> variables(const dealii::Tensor<1, dim> &v, Recording &recording)
{
  dealii::Tensor<1, dim, Recorded> result;
  for (int i = 0; i < dim; ++i)
    result[i] = recording.variable(v[i]);
  return result;
}

/// The recorded gradient against differences of fourth order, in all that a correction is made of;
/// the normal stays a unit vector.
template <int dim>
void expect_gradient(unsigned int seed)
{
  const RowOfNodes<dim> row(seed);
  const RowOfNodes<dim> other(seed + 100);
  const auto           &q     = other.weights;
  const auto            value = [&](double t) {
    RowOfNodes<dim> moved = row;
    for (unsigned int k = 0; k < row.x.size(); ++k)
      {
        moved.coefficients[k] += t * other.coefficients[k];
        moved.weights[k] += t * other.weights[k];
        moved.x[k] += t * other.x[k];
      }
    moved.n += t * other.n;
    moved.n /= moved.n.norm();
    const auto dM  = moved.correction();
    double     sum = 0.;
    for (unsigned int k = 0; k < dM.size(); ++k)
      sum += q[k] * dM[k];
    return sum;
  };
  const double h = 1e-4;
  const double slope =
    (value(-2. * h) - 8. * value(-h) + 8. * value(h) - value(2. * h)) / (12. * h);

  Recording                                     recording;
  std::vector<dealii::Tensor<1, dim, Recorded>> x;
  for (const auto &place : row.x)
    x.push_back(variables(place, recording));
  const auto coefficients = variables(row.coefficients, recording);
  const auto weights      = variables(row.weights, recording);
  const auto n            = variables(row.n, recording);
  const auto dM           = moment_correction(x, coefficients, weights, n);
  for (unsigned int k = 0; k < dM.size(); ++k)
    recording.add(dM[k], q[k]);
  recording.sweep();
  double     exact = 0.;
  const auto dn    = other.n - (row.n * other.n) * row.n;
  for (unsigned int k = 0; k < row.x.size(); ++k)
    {
      exact += recording.derivative(coefficients[k]) * other.coefficients[k] +
               recording.derivative(weights[k]) * other.weights[k];
      for (int i = 0; i < dim; ++i)
        exact += recording.derivative(x[k][i]) * other.x[k][i];
    }
  for (int i = 0; i < dim; ++i)
    exact += recording.derivative(n[i]) * dn[i];
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
