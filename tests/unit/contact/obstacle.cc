#include <snug/contact/obstacle.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace snug;
using namespace snug::contact;

namespace {
const double element_size = 0.2;

/// An oblique obstacle of every shape.
template <int dim>
ObstacleParameters parameters(const std::string &shape)
{
  ObstacleParameters result;
  result.shape        = shape;
  result.point        = {0.3, -0.2, 0.7};
  result.normal       = {0.4, 1.2, -0.5};
  result.axis         = {0.5, 0.3, 2.};
  result.radius       = 1.3;
  result.displacement = {0., 0., 0.};
  // an ellipse or ellipsoid with a bump
  result.formula = dim == 2 ? "x^2 / 4 + y^2 + 0.1 * sin(2 * x + y) - 1"
                            : "x^2 / 4 + y^2 + z^2 / 2 + 0.1 * sin(2 * x + y) - 1";
  for (auto *list : {&result.point, &result.normal, &result.axis, &result.displacement})
    list->resize(dim);
  return result;
}

template <int dim>
std::unique_ptr<Obstacle<dim>> make(const ObstacleParameters &parameters)
{
  return choose(obstacle_table<dim>(), parameters.shape).make(parameters, element_size);
}

template <int dim>
dealii::Tensor<1, dim> random_vector(std::mt19937 &random)
{
  std::uniform_real_distribution<double> uniform(-1., 1.);
  dealii::Tensor<1, dim>                 result;
  for (unsigned int d = 0; d < dim; ++d)
    result[d] = uniform(random);
  return result;
}

/// A point at @p height above a point of the obstacle, and that point.
template <int dim>
std::pair<dealii::Point<dim>, dealii::Point<dim>>
point_above(const Obstacle<dim> &obstacle, double height, std::mt19937 &random)
{
  dealii::Point<dim> y(3. * random_vector<dim>(random));
  for (unsigned int i = 0; i < 3; ++i)
    {
      const auto d = obstacle.distance(y);
      if (!d)
        return point_above(obstacle, height, random);
      y -= d->value * d->gradient;
    }
  return {y + height * obstacle.distance(y)->gradient, y};
}

template <int dim>
void expect_distance_and_derivatives(const std::string &shape)
{
  const auto   obstacle = make<dim>(parameters<dim>(shape));
  std::mt19937 random(1);
  for (const double height : {0.4, 0., -0.1})
    for (unsigned int trial = 0; trial < 5; ++trial)
      {
        const auto [x, y] = point_above(*obstacle, height, random);
        const auto d      = obstacle->distance(x);
        ASSERT_TRUE(d.has_value()) << shape;
        EXPECT_NEAR(d->value, height, 1e-11) << shape;
        EXPECT_NEAR((x - height * d->gradient - y).norm(), 0., 1e-11);
        EXPECT_NEAR(d->gradient.norm(), 1., 1e-14);
        const auto   v  = random_vector<dim>(random);
        const double h  = 1e-3;
        const auto   at = [&](double t) { return *obstacle->distance(x + t * v); };
        const double slope =
          (8. * (at(h).value - at(-h).value) - (at(2 * h).value - at(-2 * h).value)) / (12. * h);
        const auto turn =
          (8. * (at(h).gradient - at(-h).gradient) - (at(2 * h).gradient - at(-2 * h).gradient)) /
          (12. * h);
        EXPECT_NEAR(slope, d->gradient * v, 1e-9) << shape;
        EXPECT_NEAR((turn - d->hessian * v).norm(), 0., 1e-8) << shape;
      }
}

template <int dim>
void expect_formula_equals(const std::string &shape, const std::string &formula)
{
  auto       of_formula  = parameters<dim>(shape);
  const auto exact       = make<dim>(of_formula);
  of_formula.shape       = "formula";
  of_formula.formula     = formula;
  const auto   level_set = make<dim>(of_formula);
  std::mt19937 random(2);
  for (unsigned int trial = 0; trial < 20; ++trial)
    {
      const auto x = dealii::Point<dim>(2. * random_vector<dim>(random));
      const auto a = exact->distance(x);
      const auto b = level_set->distance(x);
      // Newton's method need not reach the surface from deep inside
      if (!b && a->value < -0.5)
        continue;
      ASSERT_TRUE(a && b) << shape << " at " << x;
      EXPECT_NEAR(a->value, b->value, 1e-11);
      EXPECT_NEAR((a->gradient - b->gradient).norm(), 0., 1e-10);
      EXPECT_NEAR((a->hessian - b->hessian).norm(), 0., 1e-8);
    }
}
} // namespace

TEST(Obstacle, DistanceAndItsDerivativesOfAllShapes)
{
  for (const auto &shape : obstacle_table<3>())
    {
      expect_distance_and_derivatives<2>(shape.name);
      expect_distance_and_derivatives<3>(shape.name);
    }
}

TEST(Obstacle, PlaneLiesBehindItsNormal)
{
  const auto plane = make<2>(parameters<2>("plane"));
  const auto d     = plane->distance(dealii::Point<2>(0.3 + 4., -0.2 + 12.));
  EXPECT_NEAR(d->value, std::sqrt(160.), 1e-13);
}

TEST(Obstacle, FormulasEqualShapes)
{
  // the formula's last coordinate runs along Axis, that of a plane as well
  expect_formula_equals<2>("sphere", "x^2 + y^2 - 1.69");
  expect_formula_equals<3>("sphere", "x^2 + y^2 + z^2 - 1.69");
  expect_formula_equals<3>("hollow sphere", "1.69 - (x^2 + y^2 + z^2)");
  expect_formula_equals<3>("cylinder", "x^2 + y^2 - 1.69");
}

TEST(Obstacle, HasNoDistanceWhereTheClosestPointIsNotUnique)
{
  for (const std::string shape : {"sphere", "hollow sphere", "cylinder"})
    EXPECT_FALSE(make<3>(parameters<3>(shape))->distance(dealii::Point<3>(0.3, -0.2, 0.7)));
  auto ball    = parameters<3>("formula");
  ball.formula = "x^2 + y^2 + z^2 - 1";
  EXPECT_FALSE(make<3>(ball)->distance(dealii::Point<3>(0.3, -0.2, 0.7)));
}

TEST(Obstacle, FormulaThatCannotBeParsedIsNamed)
{
  auto wrong    = parameters<3>("formula");
  wrong.formula = "x^2 +";
  EXPECT_THROW(make<3>(wrong), InputError);
}
