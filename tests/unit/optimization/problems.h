#ifndef snug_unit_optimization_problems_h
#define snug_unit_optimization_problems_h

#include <snug/base/errors.h>
#include <snug/optimization/design_problem.h>
#include <snug/optimization/optimization_parameters.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

/// min sum d_i (x_i - t_i)^2 / 2, sum a_i x_i = total, 0 <= x <= 1.
struct Knapsack
{
  explicit Knapsack(unsigned int n)
  {
    std::mt19937                           random(7);
    std::uniform_real_distribution<double> uniform(0., 1.);
    for (unsigned int i = 0; i < n; ++i)
      {
        d.push_back(0.5 + 2. * uniform(random));
        t.push_back(3. * uniform(random) - 1.);
        a.push_back(0.5 + uniform(random));
      }
    total = 0.5 * std::accumulate(a.begin(), a.end(), 0.);
  }

  snug::optimization::DesignProblem problem() const
  {
    snug::optimization::DesignProblem problem;
    problem.lower.assign(d.size(), 0.);
    problem.upper.assign(d.size(), 1.);
    problem.start.assign(d.size(), 0.5);
    problem.constraint_scales = {total};
    problem.evaluate          = [knapsack = *this](const std::vector<double> &x) {
      snug::optimization::Evaluation value;
      value.constraints = {-knapsack.total};
      value.jacobian    = {knapsack.a};
      for (unsigned int i = 0; i < x.size(); ++i)
        {
          const double move = x[i] - knapsack.t[i];
          value.objective += knapsack.d[i] * move * move / 2.;
          value.gradient.push_back(knapsack.d[i] * move);
          value.constraints[0] += knapsack.a[i] * x[i];
        }
      return value;
    };
    return problem;
  }

  /// By bisection on the multiplier, independently of any optimizer.
  std::vector<double> solution() const
  {
    std::vector<double> x(d.size());
    double              low = -100., high = 100.;
    for (unsigned int step = 0; step < 200; ++step)
      {
        const double mu  = (low + high) / 2.;
        double       sum = 0.;
        for (unsigned int i = 0; i < d.size(); ++i)
          {
            x[i] = std::clamp(t[i] - mu * a[i] / d[i], 0., 1.);
            sum += a[i] * x[i];
          }
        (sum > total ? low : high) = mu;
      }
    return x;
  }

  std::vector<double> d, t, a;
  double              total;
};

/// Rosenbrock's valley on the unit circle: x^2 + y^2 = 1.
inline snug::optimization::DesignProblem rosenbrock_on_circle()
{
  snug::optimization::DesignProblem problem;
  problem.lower    = {-1.5, -1.5};
  problem.upper    = {1.5, 1.5};
  problem.start    = {0.1, 0.9};
  problem.evaluate = [](const std::vector<double> &x) {
    const double                   bend = x[1] - x[0] * x[0];
    snug::optimization::Evaluation value;
    value.objective   = (1. - x[0]) * (1. - x[0]) + 100. * bend * bend;
    value.gradient    = {-2. * (1. - x[0]) - 400. * x[0] * bend, 200. * bend};
    value.constraints = {x[0] * x[0] + x[1] * x[1] - 1.};
    value.jacobian    = {{2. * x[0], 2. * x[1]}};
    return value;
  };
  return problem;
}

/// Its minimum, by scanning the circle finely and refining.
inline std::vector<double> rosenbrock_minimum()
{
  const auto f = [](double angle) {
    const double x = std::cos(angle), y = std::sin(angle);
    return (1. - x) * (1. - x) + 100. * (y - x * x) * (y - x * x);
  };
  double best = 0.;
  for (double width = 1., step = 1e-3; step > 1e-12; step /= 10.)
    {
      const double centre = width == 1. ? 0.75 : best;
      best                = centre;
      for (double angle = centre - width; angle < centre + width; angle += step)
        if (f(angle) < f(best))
          best = angle;
      width = 2. * step;
    }
  return {std::cos(best), std::sin(best)};
}

// The objective is flat at a minimum: a relative change of 1e-13 leaves the
// design within about its root, 3e-7, times the problem's condition.
constexpr double design_accuracy = 2e-5;

inline snug::optimization::OptimizationParameters tight()
{
  snug::optimization::OptimizationParameters parameters;
  parameters.gradient_tolerance  = 1e-13;
  parameters.objective_tolerance = 1e-13;
  parameters.design_tolerance    = 1e-10;
  return parameters;
}

/// The problem without values where from < x_0 < to.
inline snug::optimization::DesignProblem
with_hole(snug::optimization::DesignProblem problem, double from, double to)
{
  problem.evaluate = [inner = problem.evaluate, from, to](const std::vector<double> &x) {
    if (x[0] > from && x[0] < to)
      throw snug::TangledMesh("cell 5 of body punch is tangled");
    return inner(x);
  };
  return problem;
}

/// Return a vector of normally distributed numbers.
inline std::vector<double> random_vector(std::mt19937 &random, const unsigned int n)
{
  std::normal_distribution<double> normal;
  std::vector<double>              v(n);
  for (double &entry : v)
    entry = normal(random);
  return v;
}

inline double distance(const std::vector<double> &a, const std::vector<double> &b)
{
  double largest = 0.;
  for (unsigned int i = 0; i < a.size(); ++i)
    largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

#endif
