#ifndef snug_tests_unit_contact_row_checks_h
#define snug_tests_unit_contact_row_checks_h

#include <gtest/gtest.h>

#include "two_boxes.h"

/// Largest difference of two sets of rows with the same nodes.
template <int dim>
double difference(const std::vector<snug::contact::Row<dim>> &a,
                  const std::vector<snug::contact::Row<dim>> &b)
{
  double worst = 0.;
  for (unsigned int i = 0; i < a.size(); ++i)
    {
      worst = std::max(worst, std::abs(a[i].gap - b[i].gap));
      worst = std::max(worst, (a[i].normal - b[i].normal).norm());
      for (unsigned int j = 0; j < a[i].coefficients.size(); ++j)
        {
          EXPECT_EQ(a[i].coefficients[j].first, b[i].coefficients[j].first);
          worst =
            std::max(worst, (a[i].coefficients[j].second - b[i].coefficients[j].second).norm());
        }
    }
  return worst;
}

/// rows += factor * more
template <int dim>
void add(std::vector<snug::contact::Row<dim>>       &rows,
         double                                      factor,
         const std::vector<snug::contact::Row<dim>> &more)
{
  for (unsigned int i = 0; i < rows.size(); ++i)
    {
      rows[i].gap += factor * more[i].gap;
      rows[i].normal += factor * more[i].normal;
      for (unsigned int j = 0; j < rows[i].coefficients.size(); ++j)
        rows[i].coefficients[j].second += factor * more[i].coefficients[j].second;
    }
}

/// Derivatives of all rows along a random velocity against differences of
/// fourth order with steps of @p h.
template <int dim>
double
derivative_error(const TwoBoxes<dim> &scene, const snug::contact::Contact<dim> &contact, double h)
{
  const auto velocity = scene.random_velocity(4);
  const auto exact    = contact.row_derivatives(scene.positions, velocity);
  // (f(-2h) - 8 f(-h) + 8 f(h) - f(2h)) / 12h
  auto numbers = exact;
  add(numbers, -1., exact);
  for (const auto &term : {std::make_pair(-2., 1.), {-1., -8.}, {1., 8.}, {2., -1.}})
    add(numbers, term.second / (12. * h),
        contact.rows(sum(scene.positions, term.first * h, velocity)));
  return difference(exact, numbers);
}

/// Difference of the energy gradient and the derivatives of the rows along a
/// random velocity, relative to the sum of the sizes of all terms.
template <int dim>
double reverse_error(const TwoBoxes<dim> &scene, const snug::contact::Contact<dim> &contact)
{
  const auto          velocity     = scene.random_velocity(5);
  const auto          displacement = scene.random_field(6);
  std::vector<double> forces(contact.n_rows());
  for (unsigned int i = 0; i < forces.size(); ++i)
    forces[i] = std::cos(i + 1.);
  double     direct = 0., reverse = 0., scale = 0.;
  const auto rows = contact.row_derivatives(scene.positions, velocity);
  for (unsigned int i = 0; i < rows.size(); ++i)
    {
      double term = -rows[i].gap;
      for (const auto &c : rows[i].coefficients)
        term += c.second * displacement[c.first];
      direct += forces[i] * term;
      scale += std::abs(forces[i] * term);
    }
  const auto gradient = contact.energy_gradient(scene.positions, displacement, {forces});
  for (unsigned int node = 0; node < gradient.size(); ++node)
    reverse += gradient[node] * velocity[node];
  return std::abs(direct - reverse) / scale;
}

/// x -> Q x + shift with a fixed rotation Q.
template <int dim>
dealii::Tensor<2, dim> some_rotation()
{
  const double           a = 0.7, b = -1.1;
  dealii::Tensor<2, dim> q;
  q[0][0] = q[1][1] = std::cos(a);
  q[0][1]           = -std::sin(a);
  q[1][0]           = std::sin(a);
  if (dim == 2)
    return q;
  dealii::Tensor<2, dim> r;
  q[dim - 1][dim - 1] = r[0][0] = 1.;
  r[1][1] = r[dim - 1][dim - 1] = std::cos(b);
  r[1][dim - 1]                 = -std::sin(b);
  r[dim - 1][1]                 = std::sin(b);
  return q * r;
}

/// Gaps stay and normals turn when both bodies move rigidly.
template <int dim>
void expect_invariance(TwoBoxes<dim> &scene)
{
  const auto                   contact = scene.contact();
  const auto                   rows    = contact.rows(scene.positions);
  const dealii::Tensor<2, dim> q       = some_rotation<dim>();
  dealii::Tensor<1, dim>       shift;
  shift[0] = 3.;
  shift[1] = -2.;
  for (auto &x : scene.positions)
    x = q * x + shift;
  const auto moved_rows = scene.contact().rows(scene.positions);
  ASSERT_EQ(rows.size(), moved_rows.size());
  for (unsigned int i = 0; i < rows.size(); ++i)
    {
      EXPECT_NEAR(rows[i].gap, moved_rows[i].gap, 1e-13);
      EXPECT_NEAR((q * rows[i].normal - moved_rows[i].normal).norm(), 0., 1e-12);
      // a translation of both bodies does not open the contact
      dealii::Tensor<1, dim> total;
      for (const auto &c : rows[i].coefficients)
        total += c.second;
      EXPECT_NEAR(total.norm(), 0., 1e-14);
    }
}

#endif
