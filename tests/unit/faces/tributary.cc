#include "one_box.h"

#include <snug/faces/tributary.h>

#include <deal.II/base/numbers.h>

#include <gtest/gtest.h>

using namespace snug;
using namespace snug::faces;

namespace {
template <int dim>
std::vector<unsigned int> nodes_that_do_not_hang(const BoxTop<dim> &box)
{
  std::vector<unsigned int> nodes;
  for (unsigned int node = 0; node < box.surface.n_nodes(); ++node)
    if (box.surface.masters(node).empty())
      nodes.push_back(node);
  return nodes;
}

/// sum_i factors_i area_i over the nodes that do not hang.
template <int dim>
double weighted_area(const BoxTop<dim>                 &box,
                     const std::vector<double>         &factors,
                     double                             h,
                     const typename BoxTop<dim>::Field &velocity)
{
  const auto positions = box.moved(h, velocity);
  const auto areas =
    tributary_areas<dim>({box.surface, box.faces, box.shape}, nodes_that_do_not_hang(box),
                         faces::PointField<dim, double>(positions));
  double sum = 0.;
  for (unsigned int i = 0; i < areas.size(); ++i)
    sum += factors[i] * areas[i];
  return sum;
}

template <int dim>
void expect_exact_gradient(BoxTop<dim> box)
{
  box.shake();
  const auto          nodes    = nodes_that_do_not_hang(box);
  const auto          velocity = box.random_velocity(1);
  std::vector<double> factors;
  for (unsigned int i = 0; i < nodes.size(); ++i)
    factors.push_back(std::cos(i + 1.));
  typename BoxTop<dim>::Field gradient(box.surface.n_points());
  add_tributary_gradient<dim>({box.surface, box.faces, box.shape}, nodes, box.positions, factors,
                              gradient);
  const auto   f = [&](double h) { return weighted_area(box, factors, h, velocity); };
  const double h = 1e-4;
  EXPECT_NEAR(inner_product(gradient, velocity),
              (f(-2. * h) - 8. * f(-h) + 8. * f(h) - f(2. * h)) / (12. * h), 1e-10);

  // Areas grow with the power dim - 1 of the size.
  const std::vector<double>   ones(nodes.size(), 1.);
  typename BoxTop<dim>::Field of_area(box.surface.n_points());
  add_tributary_gradient<dim>({box.surface, box.faces, box.shape}, nodes, box.positions, ones,
                              of_area);
  EXPECT_NEAR(inner_product(of_area, box.positions),
              (dim - 1) * weighted_area(box, ones, 0., velocity), 1e-13);
}
} // namespace

TEST(Tributary, GradientAgreesWithFiniteDifferences)
{
  for (const unsigned int degree : {1, 2})
    {
      expect_exact_gradient(BoxTop<2>(degree, true));
      expect_exact_gradient(BoxTop<3>(degree, true));
      expect_exact_gradient(BoxTop<3>(degree, true, "sphere 3"));
    }
}

TEST(Tributary, AreasOfAPlaneSumToIt)
{
  for (const unsigned int degree : {1, 2})
    {
      const BoxTop<3>           box(degree, true);
      const std::vector<double> ones(nodes_that_do_not_hang(box).size(), 1.);
      EXPECT_NEAR(weighted_area(box, ones, 0., box.positions), 1., 1e-14);
    }
}

/// An arc of radius 1 over a chord of length 1 has the length pi / 3.
TEST(Tributary, LengthsOfAnArcConverge)
{
  const double exact = dealii::numbers::PI / 3.;
  for (const unsigned int degree : {1, 2})
    {
      const BoxTop<2>           box(degree, false, "cylinder z 1");
      const std::vector<double> ones(nodes_that_do_not_hang(box).size(), 1.);
      // Four chords of angle a are shorter by a^2 / 24; the error of quadratic edges is of higher
      // order.
      const double error = exact - weighted_area(box, ones, 0., box.positions);
      EXPECT_GT(error, degree == 1 ? 2e-3 : 0.);
      EXPECT_LT(error, degree == 1 ? 5e-3 : 1e-5);
    }
}

TEST(Tributary, ShapeIntegralsOfASquareAreKnown)
{
  const BoxTop<3> linear(1, false), quadratic(2, false);
  for (const double integral : shape_integrals(linear.surface, 0, linear.shape, linear.positions))
    EXPECT_NEAR(integral, 1. / 64., 1e-16);
  // Simpson's rule: 1/6, 4/6, 1/6 of the side 1/4.
  const auto integrals =
    shape_integrals(quadratic.surface, 0, quadratic.shape, quadratic.positions);
  const double simpson[] = {1. / 24., 4. / 24., 1. / 24.};
  for (unsigned int k = 0; k < 9; ++k)
    EXPECT_NEAR(integrals[k], simpson[k % 3] * simpson[k / 3], 1e-16);
}
