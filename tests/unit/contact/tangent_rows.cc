#include <snug/base/errors.h>
#include <snug/base/section_check.h>

#include <gtest/gtest.h>

#include "rough_boxes.h"

using namespace snug;
using namespace snug::contact;

namespace {
/// Return sum_a c_a . u(a).
template <int dim, typename Motion>
double slip(const Row<dim> &row, const Motion &u)
{
  double sum = 0.;
  for (const auto &[node, c] : row.coefficients)
    sum += c * u(node);
  return sum;
}

/// Return the velocity of x in a rotation with the (angular velocity) @p omega, of which 2D uses
/// the first component.
dealii::Tensor<1, 2> rotation(const dealii::Tensor<1, 2> &omega, const dealii::Tensor<1, 2> &x)
{
  return omega[0] * dealii::cross_product_2d(x);
}

dealii::Tensor<1, 3> rotation(const dealii::Tensor<1, 3> &omega, const dealii::Tensor<1, 3> &x)
{
  return dealii::cross_product_3d(omega, x);
}

/// Return @p omega without the spin about @p n.
dealii::Tensor<1, 2> spin_free(const dealii::Tensor<1, 2> &omega, const dealii::Tensor<1, 2> &)
{
  return omega;
}

dealii::Tensor<1, 3> spin_free(const dealii::Tensor<1, 3> &omega, const dealii::Tensor<1, 3> &n)
{
  return omega - (omega * n) * n;
}

/// Rigid motions of both bodies do not slip, and motions of the slave side slip by their tangential
/// part.
template <int dim>
void expect_slips(const RoughBoxes<dim> &scene, const bool is_flat)
{
  using Vector              = dealii::Tensor<1, dim>;
  const auto   contact      = scene.contact();
  const auto   rows         = contact.rows(scene.positions);
  const auto   tangent_rows = contact.tangent_rows(scene.positions, rows);
  const Vector v            = scene.random_field(3)[0];
  ASSERT_EQ(tangent_rows.size(), (dim - 1) * rows.size());
  std::vector<double> squares(rows.size(), 0.);
  double              largest_common = 0.;
  for (unsigned int i = 0; i < tangent_rows.size(); ++i)
    {
      const auto [row, index, is_held] = contact.tangents()[i];
      const auto &n                    = rows[row].normal;
      EXPECT_EQ(row, i / (dim - 1));
      EXPECT_EQ(index, i % (dim - 1));
      const auto translation = [&](unsigned int) { return v; };
      EXPECT_NEAR(slip(tangent_rows[i], translation), 0., 1e-12);
      const Vector omega = is_flat ? v : spin_free(v, n);
      const auto common = [&](unsigned int node) { return rotation(omega, scene.positions[node]); };
      largest_common    = std::max(largest_common, std::abs(slip(tangent_rows[i], common)));
      const auto   of_one = [&](unsigned int node) { return scene.is_master(node) ? Vector() : v; };
      const double s      = slip(tangent_rows[i], of_one);
      EXPECT_NEAR(dim == 2 ? s - n[0] * v[1] + n[1] * v[0] : 0., 0., 1e-13);
      squares[row] += s * s;
      EXPECT_EQ(tangent_rows[i].gap, 0.);
    }
  EXPECT_LT(largest_common, 1e-12);
  for (unsigned int i = 0; i < rows.size(); ++i)
    EXPECT_NEAR(squares[i], (v - (v * rows[i].normal) * rows[i].normal).norm_square(), 1e-12);
}

template <int dim>
std::vector<Row<dim>> tangent_rows(const Contact<dim>                        &contact,
                                   const std::vector<dealii::Tensor<1, dim>> &positions)
{
  return contact.tangent_rows(positions, contact.rows(positions));
}

/// Return sum_i weight_i f(i h) of the fourth-order difference quotient.
template <typename Function>
void for_each_difference(double h, const Function &f)
{
  for (const auto &term : {std::make_pair(-2., 1.), {-1., -8.}, {1., 8.}, {2., -1.}})
    f(term.first * h, term.second / (12. * h));
}

/// Derivatives of tangential rows against differences.
template <int dim>
void expect_exact_derivatives(const RoughBoxes<dim> &scene, double h)
{
  const auto contact  = scene.contact();
  const auto velocity = scene.random_velocity(4);
  const auto rows     = contact.rows(scene.positions);
  const auto exact =
    contact.tangent_row_derivatives(scene.positions, velocity, rows,
                                    contact.row_derivatives(scene.positions, velocity));
  ASSERT_GT(exact.size(), 0u);
  auto numbers = exact, zero = exact;
  add(numbers, -1., exact);
  add(zero, -1., exact);
  for_each_difference(h, [&](double step, double weight) {
    add(numbers, weight, tangent_rows(contact, sum(scene.positions, step, velocity)));
  });
  EXPECT_LT(difference(exact, numbers), 1e-7 * std::max(1., difference(exact, zero)));
}

/// Return the energy of normal and tangential forces, of which the latter follow the normals from
/// those of @p forces.
template <int dim>
double energy(const RoughBoxes<dim>                     &scene,
              const Contact<dim>                        &contact,
              const std::vector<dealii::Tensor<1, dim>> &positions,
              const std::vector<dealii::Tensor<1, dim>> &displacement,
              const ContactForces<dim>                  &forces)
{
  const auto u        = [&](unsigned int node) { return displacement[node]; };
  const auto rows     = contact.rows(positions);
  const auto tangents = contact.tangent_rows(positions, rows);
  double     sum      = 0.;
  for (unsigned int i = 0; i < rows.size(); ++i)
    sum += forces.normal[i] * (slip(rows[i], u) - rows[i].gap);
  for (unsigned int k = 0; k < tangents.size(); ++k)
    {
      const auto  &row   = rows[contact.tangents()[k].row];
      const auto  &force = forces.tangential[contact.tangents()[k].row];
      const double size  = force.norm();
      auto         along = force - (force * row.normal) * row.normal;
      if (size > 0.)
        along *= size / along.norm();
      sum +=
        (along * scene.tangent(contact, tangents[k])) * (slip(tangents[k], u) - tangents[k].gap);
    }
  return sum;
}

/// Return normal forces and forces at right angles to the normals, both of which some rows lack.
template <int dim>
ContactForces<dim> some_forces(const std::vector<Row<dim>> &rows)
{
  ContactForces<dim> forces;
  forces.tangential = TwoBoxes<dim>::random_field(8, rows.size());
  for (unsigned int i = 0; i < rows.size(); ++i)
    {
      auto &q = forces.tangential[i];
      q       = i % 4 == 1 ? 0. * q : q - (q * rows[i].normal) * rows[i].normal;
      forces.normal.push_back(i % 3 == 0 ? 0. : std::cos(i));
    }
  return forces;
}

/// The energy gradient, and that without the gaps, against differences of the energy.
template <int dim>
void expect_exact_gradient(const RoughBoxes<dim> &scene, double h)
{
  const auto contact      = scene.contact();
  const auto velocity     = scene.random_velocity(5);
  const auto displacement = scene.random_field(6), at_rest = sum(displacement, -1., displacement);
  const auto forces  = some_forces(contact.rows(scene.positions));
  const auto product = [&](const std::vector<dealii::Tensor<1, dim>> &gradient) {
    double result = 0.;
    for (unsigned int i = 0; i < gradient.size(); ++i)
      result += gradient[i] * velocity[i];
    return result;
  };
  double with_gaps = 0., without = 0.;
  for_each_difference(h, [&](double step, double weight) {
    const auto   x = sum(scene.positions, step, velocity);
    const double e = energy(scene, contact, x, displacement, forces);
    with_gaps += weight * e;
    without += weight * (e - energy(scene, contact, x, at_rest, forces));
  });
  const double scale = std::max({1., std::abs(with_gaps), std::abs(without)});
  EXPECT_NEAR(product(contact.energy_gradient(scene.positions, displacement, forces)), with_gaps,
              1e-7 * scale);
  EXPECT_NEAR(product(contact.coefficient_gradient(scene.positions, displacement, forces)), without,
              1e-7 * scale);
}

template <int dim>
void expect_exact(const RoughBoxes<dim> &scene)
{
  const double h = scene.rough.parameters.method == Method::nodal ? 1e-5 : 1e-6;
  expect_exact_derivatives(scene, h);
  expect_exact_gradient(scene, h);
}

/// Return the number of tangential rows of each slave node at x = 0 that supports do not hold. A
/// single one in 3D must be along y.
template <int dim>
unsigned int n_tangents_at_left(const RoughBoxes<dim> &scene)
{
  const auto contact = scene.contact();
  const auto rows    = tangent_rows(contact, scene.positions);
  const auto is_left = [&](unsigned int row) {
    return scene.positions[contact.places()[row].slave][0] == 0.;
  };
  unsigned int n_left = 0, n_rows = 0;
  for (unsigned int row = 0; row < contact.n_rows(); ++row)
    n_rows += is_left(row);
  unsigned int n_held = 0;
  for (const Tangent &tangent : contact.tangents())
    {
      n_left += is_left(tangent.row) && !tangent.is_held;
      n_held += tangent.is_held;
    }
  EXPECT_EQ(rows.size() - n_left - n_held, (dim - 1) * (contact.n_rows() - n_rows));
  EXPECT_EQ(n_left % n_rows, 0u);
  for (unsigned int k = 0; k < rows.size(); ++k)
    if (dim == 3 && n_left == n_rows && is_left(contact.tangents()[k].row) &&
        !contact.tangents()[k].is_held)
      {
        EXPECT_EQ(contact.tangents()[k].index, 0u);
        EXPECT_NEAR(std::abs(scene.tangent(contact, rows[k])[1]), 1., 1e-12);
      }
  return n_left / n_rows;
}

template <int dim>
void expect_rows_at_supports()
{
  for (const Method method : {Method::nodal, Method::mortar})
    {
      RoughBoxes<dim> scene(RoughBoxes<dim>::boxes(3, 4), 1);
      scene.rough.parameters.method = method;
      EXPECT_EQ(n_tangents_at_left(scene), dim - 1);
      scene.hold_left();
      EXPECT_EQ(n_tangents_at_left(scene), dim - 2);
      for (unsigned int node = 0; node < scene.held.size(); ++node)
        if (scene.is_master(node))
          scene.held[node].clear();
      EXPECT_EQ(n_tangents_at_left(scene), dim - 1);
      scene.meet_ball();
      scene.rough.obstacle->shape = "plane";
      scene.rough.obstacle->point.assign(dim, 0.9);
      EXPECT_EQ(n_tangents_at_left(scene), dim - 2);
      // A direction at an angle leaves the slave nodes a motion that the normal row resists.
      for (auto &held : scene.held)
        if (!held.empty())
          {
            held[0][0]       = std::cos(0.3);
            held[0][dim - 1] = std::sin(0.3);
          }
      EXPECT_EQ(n_tangents_at_left(scene), dim - 2);
    }
}
} // namespace

TEST(TangentRows, MeasureTheSlipOfTheSlaveAlone)
{
  for_each_rough_scene<2>(expect_slips<2>);
  for_each_rough_scene<3>(expect_slips<3>);
}

TEST(TangentRows, DerivativesAgreeWithFiniteDifferences)
{
  const auto check = [](auto &scene, bool is_flat) {
    if (is_flat)
      return;
    scene.hold_left();
    scene.turn();
    expect_exact(scene);
  };
  for_each_rough_scene<2>(check);
  for_each_rough_scene<3>(check);
}

TEST(TangentRows, FollowAnObstacle)
{
  const auto check = [](auto &scene, bool) {
    if (scene.rough.parameters.method == Method::mortar)
      return;
    scene.meet_ball();
    scene.turn();
    const auto contact = scene.contact();
    const auto rows    = tangent_rows(contact, scene.positions);
    const auto w       = scene.position.of_obstacle("ball").vector(
      to_point<std::decay_t<decltype(scene.positions[0])>::dimension>(
        scene.rough.obstacle->displacement));
    ASSERT_GT(rows.size(), 0u);
    for (const auto &row : rows)
      {
        EXPECT_EQ(row.coefficients.size(), 1u);
        EXPECT_NEAR(row.gap, scene.tangent(contact, row) * w, 1e-15);
        EXPECT_NEAR(row.normal * scene.tangent(contact, row), 0., 1e-15);
      }
    expect_exact(scene);
  };
  for_each_rough_scene<2>(check);
  for_each_rough_scene<3>(check);
}

TEST(TangentRows, AreDroppedWhereBothSidesAreHeld)
{
  expect_rows_at_supports<2>();
  expect_rows_at_supports<3>();
}

TEST(TangentRows, FrictionBelongsToTheReference)
{
  RoughBoxes<2> scene(RoughBoxes<2>::boxes(4, 4), 1);
  const auto    reference = scene.positions;
  for (auto &x : scene.positions)
    x[0] += 2.;
  scene.rough.parameters.friction_coefficient = "0.2 * x";
  const auto contact                          = scene.contact();
  EXPECT_TRUE(contact.has_friction());
  // The coefficient is 0 at one of the five nodes.
  EXPECT_EQ(contact.tangents().size(), 4u);
  for (unsigned int i = 0; i < contact.n_rows(); ++i)
    {
      EXPECT_NEAR(contact.friction(i).coefficient, 0.2 * reference[contact.places()[i].slave][0],
                  1e-15);
      EXPECT_EQ(contact.friction(i).bound, 0.);
    }
  scene.rough.parameters.friction_coefficient = "0.1 - x";
  EXPECT_THROW(scene.contact(), InputError);
  scene.rough.parameters.friction_coefficient = "1 / x";
  EXPECT_THROW(scene.contact(), InputError);
  scene.rough.parameters.friction             = Friction::Tresca;
  scene.rough.parameters.friction_coefficient = "0";
  scene.rough.parameters.friction_bound       = "5";
  EXPECT_EQ(scene.contact().friction(2).bound, 5.);
  scene.rough.parameters.friction_bound = "0";
  EXPECT_FALSE(scene.contact().has_friction());
  EXPECT_FALSE(static_cast<const TwoBoxes<2> &>(scene).contact().has_friction());
}

TEST(TangentRows, EntriesMustBeFormulas)
{
  const Origins      where;
  const SectionCheck section("Contact", where, 2);
  PairParameters     parameters;
  EXPECT_NO_THROW(parameters.check(section));
  parameters.friction             = Friction::Coulomb;
  parameters.friction_coefficient = "0.3 + x";
  EXPECT_NO_THROW(parameters.check(section));
  parameters.friction_bound = "1 +";
  EXPECT_THROW(parameters.check(section), InputError);
}

TEST(TangentRows, OneFrictionForThePairsOfTheSameFaces)
{
  const RoughBoxes<2> scene(RoughBoxes<2>::boxes(4, 4), 1);
  Pair                other = scene.rough;
  const auto          join  = [&]() {
    return Contact<2>(scene.surface, {scene.rough, other}, 1, scene.positions, scene.held)
      .pairs()
      .size();
  };
  EXPECT_EQ(join(), 1u);
  other.parameters.friction_coefficient = "0.4";
  EXPECT_THROW(join(), InputError);
}
