#include <snug/faces/recording.h>

#include <gtest/gtest.h>

using namespace snug::faces;

namespace {
/// A function with all operations, of which some are on constants.
template <typename Number>
Number some_function(const Number &x, const Number &y)
{
  using std::sqrt;
  Number z = 2. * x - y / 3. + 1.;
  z *= x;
  z -= sqrt(x * x + y * y) / (2. + y);
  z /= -y;
  return z + x * 0.5 - 4. / x;
}

dealii::Tensor<1, 2, Recorded> variables(double x, double y, Recording &recording)
{
  dealii::Tensor<1, 2, Recorded> result;
  result[0] = recording.variable(x);
  result[1] = recording.variable(y);
  return result;
}
} // namespace

TEST(Recording, GradientIsThatOfTheForwardMode)
{
  Recording  recording;
  const auto v = variables(0.7, 1.9, recording);
  const auto z = some_function(v[0], v[1]);
  EXPECT_EQ(z.value, some_function(0.7, 1.9));
  recording.add(z, 3.);
  recording.sweep();
  for (unsigned int i = 0; i < 2; ++i)
    {
      Differential<1> x = 0.7, y = 1.9;
      (i == 0 ? x : y).slope[0] = 3.;
      EXPECT_NEAR(recording.derivative(v[i]), some_function(x, y).slope[0], 1e-14);
    }
}

TEST(Recording, GradientOfAKnownFunction)
{
  Recording  recording;
  const auto v = variables(3., 4., recording);
  recording.add(sqrt(v * v), 1.);
  recording.sweep();
  EXPECT_NEAR(recording.derivative(v[0]), 0.6, 1e-15);
  EXPECT_NEAR(recording.derivative(v[1]), 0.8, 1e-15);
}

TEST(Recording, PartsMayBeRemovedOneAfterTheOther)
{
  Recording         recording;
  const auto        v      = variables(0.7, 1.9, recording);
  const Recorded    common = v[0] * v[1];
  const std::size_t begin  = recording.size();
  for (unsigned int i = 0; i < 5; ++i)
    {
      recording.add(some_function(common, v[1] + double(i)), 1. + i);
      recording.sweep_to(begin);
      EXPECT_EQ(recording.size(), begin);
    }
  recording.sweep();

  Recording  whole;
  const auto w       = variables(0.7, 1.9, whole);
  const auto product = w[0] * w[1];
  Recorded   sum     = 0.;
  for (unsigned int i = 0; i < 5; ++i)
    sum += (1. + i) * some_function(product, w[1] + double(i));
  whole.add(sum, 1.);
  whole.sweep();
  for (unsigned int i = 0; i < 2; ++i)
    EXPECT_NEAR(recording.derivative(v[i]), whole.derivative(w[i]), 1e-12);
}

TEST(Recording, ConstantsAreNotRecorded)
{
  Recording      recording;
  const Recorded constant = some_function(Recorded(2.), Recorded(3.));
  EXPECT_EQ(constant.recording, nullptr);
  recording.add(constant, 1.);
  recording.sweep();
  EXPECT_EQ(recording.size(), 0u);
  EXPECT_EQ(recording.derivative(constant), 0.);
}
