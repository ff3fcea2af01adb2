#include "cells.h"

using namespace elasticity_cells;

namespace {
/// A thermal strain that varies over the cell.
template <int dim>
double varying(const snug::mesh::LagrangePoint<dim> &at)
{
  return 0.3 + 0.5 * at.point[0] * at.point[0] - 0.4 * at.point[dim - 1];
}
} // namespace

template <typename Case>
class ThermalStrains : public ::testing::Test
{
public:
  static constexpr int          dim    = Case::dim;
  static constexpr unsigned int degree = Case::degree;

  const std::vector<TestElement<dim>> elements = all_elements<dim>(degree, 61);
  const std::size_t                   n        = elements[0].X.size();
  const Nodes<dim>                    V        = random_field<dim>(n, 62);
  const Nodes<dim>                    w        = random_field<dim>(n, 63);

  Nodes<dim> force(const Element<dim> &element, const Nodes<dim> &X) const
  {
    Nodes<dim> f;
    element.thermal_force(X, material, varying<dim>, f);
    return f;
  }
};
TYPED_TEST_SUITE(ThermalStrains, AllCases);

TYPED_TEST(ThermalStrains, FreeExpansionHasNeitherStressNorEnergy)
{
  // A section in plane strain is held across.
  constexpr int dim = TestFixture::dim;
  for (const auto &of : this->elements)
    {
      if (of.idealization.kind == Idealization::Kind::plane_strain)
        continue;
      const double strain  = 0.2;
      const auto   thermal = [&](const auto &) { return strain; };
      Nodes<dim>   u, f, r;
      for (const auto &x : of.X)
        u.push_back(strain * x);
      of.element.thermal_force(of.X, material, thermal, f);
      of.element.internal_force(of.X, material, u, r);
      EXPECT_LT(distance<dim>(f, r), 1e-13 * norm<dim>(r)) << of.name();
      const auto shapes = snug::mesh::lagrange_nodes<dim>(TestFixture::degree);
      for (const auto &stress : of.element.stresses(of.X, material, u, shapes, thermal))
        EXPECT_LT(stress.norm(), 1e-13 * material.youngs_modulus) << of.name();
      EXPECT_NEAR(0.5 * dot<dim>(r, u) - dot<dim>(f, u) +
                    of.element.thermal_energy(of.X, material, thermal),
                  0., 1e-13 * dot<dim>(r, u))
        << of.name();
    }
}

TYPED_TEST(ThermalStrains, HeldCellsHaveTheTextbookStress)
{
  constexpr int dim = TestFixture::dim;
  const double  E = material.youngs_modulus, nu = material.poissons_ratio, strain = 0.2;
  const auto    shapes = snug::mesh::lagrange_nodes<dim>(TestFixture::degree);
  for (const auto &of : this->elements)
    {
      const bool sheet = of.idealization.kind == Idealization::Kind::plane_stress;
      for (const auto &stress : of.element.stresses(of.X, material, Nodes<dim>(this->n), shapes,
                                                    [&](const auto &) { return strain; }))
        {
          EXPECT_NEAR(stress[0][0], -E * strain / (1. - (sheet ? nu : 2. * nu)), 1e-12 * E);
          EXPECT_NEAR(stress[2][2], sheet ? 0. : stress[0][0], 1e-12 * E);
        }
    }
}

TYPED_TEST(ThermalStrains, DerivativesAgreeWithDifferences)
{
  constexpr int dim = TestFixture::dim;
  for (const auto &of : this->elements)
    {
      Nodes<dim> found;
      of.element.thermal_force_derivative(of.X, this->V, material, varying<dim>, found);
      const auto expected =
        derivative<dim>([&](const Nodes<dim> &X) { return this->force(of.element, X); }, of.X,
                        this->V);
      EXPECT_LT(distance<dim>(found, expected), 1e-9 * norm<dim>(expected)) << of.name();

      Nodes<dim> gradient(this->n);
      of.element.add_thermal_force_gradient(of.X, material, varying<dim>, this->w, 2., gradient);
      EXPECT_NEAR(dot<dim>(gradient, this->V), 2. * dot<dim>(found, this->w),
                  1e-13 * norm<dim>(gradient) * norm<dim>(this->V))
        << of.name();

      gradient.assign(this->n, {});
      of.element.add_thermal_energy_gradient(of.X, material, varying<dim>, 3., gradient);
      const double slope = derivative<double>([&](const double t) {
        return 3. * of.element.thermal_energy(sum<dim>(of.X, t, this->V), material, varying<dim>);
      });
      EXPECT_NEAR(dot<dim>(gradient, this->V), slope,
                  1e-9 * norm<dim>(gradient) * norm<dim>(this->V))
        << of.name();
    }
}
