#ifndef snug_faces_differential_h
#define snug_faces_differential_h

#include <deal.II/base/template_constraints.h>

#include <array>
#include <cmath>

namespace snug::faces {
/**
 * A number with its derivatives along n directions, for the forward mode of algorithmic
 * differentiation (Griewank, Walther, Evaluating Derivatives, SIAM, 2008). Functions templated on
 * their number type are differentiated exactly. Comparisons must use value_of().
 */
template <int n>
struct Differential
{
  double                value = 0.;
  std::array<double, n> slope{};

  Differential() = default;

  /// Construct a constant.
  Differential(double value) : value(value) {}

  Differential &operator+=(const Differential &b)
  {
    value += b.value;
    for (int i = 0; i < n; ++i)
      slope[i] += b.slope[i];
    return *this;
  }

  Differential &operator-=(const Differential &b)
  {
    value -= b.value;
    for (int i = 0; i < n; ++i)
      slope[i] -= b.slope[i];
    return *this;
  }

  Differential &operator*=(double b)
  {
    value *= b;
    for (int i = 0; i < n; ++i)
      slope[i] *= b;
    return *this;
  }

  Differential &operator*=(const Differential &b)
  {
    for (int i = 0; i < n; ++i)
      slope[i] = slope[i] * b.value + value * b.slope[i];
    value *= b.value;
    return *this;
  }

  Differential &operator/=(const Differential &b)
  {
    value /= b.value;
    for (int i = 0; i < n; ++i)
      slope[i] = (slope[i] - value * b.slope[i]) / b.value;
    return *this;
  }

  friend Differential operator+(Differential a, const Differential &b) { return a += b; }

  friend Differential operator-(Differential a, const Differential &b) { return a -= b; }

  friend Differential operator-(Differential a) { return a *= -1.; }

  friend Differential operator*(Differential a, const Differential &b) { return a *= b; }

  friend Differential operator*(Differential a, double b) { return a *= b; }

  friend Differential operator*(double a, Differential b) { return b *= a; }

  friend Differential operator/(Differential a, const Differential &b) { return a /= b; }

  friend Differential sqrt(Differential a)
  {
    const double root = std::sqrt(a.value);
    a *= 0.5 / root;
    a.value = root;
    return a;
  }
};

template <int n>
double value_of(const Differential<n> &a)
{
  return a.value;
}

inline double value_of(double a)
{
  return a;
}

/// Return the inner product of two vectors of numbers.
template <typename Number, std::size_t n>
Number dot(const std::array<Number, n> &a, const std::array<Number, n> &b)
{
  Number sum = a[0] * b[0];
  for (std::size_t i = 1; i < n; ++i)
    sum += a[i] * b[i];
  return sum;
}
} // namespace snug::faces

namespace dealii {
/// Allow numbers with derivatives in tensors.
template <int n>
struct EnableIfScalar<snug::faces::Differential<n>>
{
  using type = snug::faces::Differential<n>;
};
} // namespace dealii

#endif
