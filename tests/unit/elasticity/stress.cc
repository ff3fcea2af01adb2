#include <snug/elasticity/stress.h>

#include "cells.h"

using namespace elasticity_cells;

TEST(MaterialLimits, LameConstants)
{
  const Material cork{10., 0.};
  EXPECT_EQ(cork.lame_lambda(), 0.);
  EXPECT_EQ(cork.lame_mu(), 5.);

  // bulk modulus lambda + 2/3 mu = E / (3 (1 - 2 nu)) up to incompressibility
  for (const double nu : {-0.9, -0.3, 0.1, 0.3, 0.49, 0.4999999})
    {
      const Material m{10., nu};
      const double   bulk = 10. / (3. * (1. - 2. * nu));
      EXPECT_GT(m.lame_mu(), 0.);
      EXPECT_NEAR(m.lame_lambda() + 2. / 3. * m.lame_mu(), bulk, 1e-12 * bulk);
      EXPECT_EQ(m.bulk_modulus(), bulk);
    }
}

/// Stress of a displacement gradient.
dealii::SymmetricTensor<2, 3> stress_of(const Idealization         &idealization,
                                        const dealii::Tensor<2, 3> &gradient)
{
  return cauchy_stress(material, strain(idealization, material, gradient));
}

/// A random gradient in the x-y plane.
dealii::Tensor<2, 3> plane_gradient(const unsigned int seed)
{
  const auto           in_plane = random_matrix<2>(seed);
  dealii::Tensor<2, 3> gradient;
  for (unsigned int i = 0; i < 2; ++i)
    for (unsigned int j = 0; j < 2; ++j)
      gradient[i][j] = in_plane[i][j];
  return gradient;
}

const Idealization solid{Idealization::Kind::solid};
const Idealization sheet{Idealization::Kind::plane_stress};

TEST(CauchyStress, UniaxialTensionRecoversYoungAndPoisson)
{
  const double         along = 1e-3;
  dealii::Tensor<2, 3> gradient;
  gradient[0][0] = along;
  gradient[1][1] = gradient[2][2] = -material.poissons_ratio * along;
  auto stress                     = stress_of(solid, gradient);
  EXPECT_NEAR(stress[0][0], material.youngs_modulus * along, 1e-16);
  stress[0][0] = 0.;
  EXPECT_LT(stress.norm(), 1e-16);
}

TEST(CauchyStress, SheetsHaveNoStressAcross)
{
  const auto gradient = plane_gradient(51);
  const auto stress   = stress_of(sheet, gradient);
  EXPECT_NEAR(stress[2][2], 0., 1e-14);
  // the textbook's plane stress: E / (1 - nu^2) (e_xx + nu e_yy)
  const double E = material.youngs_modulus, nu = material.poissons_ratio;
  EXPECT_NEAR(stress[0][0], E / (1. - nu * nu) * (gradient[0][0] + nu * gradient[1][1]), 1e-13);
  EXPECT_NEAR(stress[0][1], E / (2. + 2. * nu) * (gradient[0][1] + gradient[1][0]), 1e-13);
  // and the strain across is what this stress makes of a free sheet
  EXPECT_NEAR(strain(sheet, material, gradient)[2][2], -nu / E * (stress[0][0] + stress[1][1]),
              1e-14);
}

TEST(CauchyStress, StiffnessInTheSheet)
{
  // in the plane, sigma = lambda tr(e) I + 2 mu e with the lambda of sheets
  const auto gradient = plane_gradient(55);
  const auto stress   = stress_of(sheet, gradient);
  EXPECT_NEAR(stress[0][0],
              lame_lambda(sheet, material) * (gradient[0][0] + gradient[1][1]) +
                2. * material.lame_mu() * gradient[0][0],
              1e-13);
  EXPECT_EQ(lame_lambda(solid, material), material.lame_lambda());
}

TEST(CauchyStress, RotationsAreFree)
{
  EXPECT_EQ(stress_of(solid, random_skew<3>(52)).norm(), 0.);
  auto rotation = plane_gradient(53);
  rotation      = rotation - transpose(rotation);
  EXPECT_EQ(stress_of(sheet, rotation).norm(), 0.);
}

TEST(VonMises, KnownStates)
{
  dealii::SymmetricTensor<2, 3> uniaxial, shear, biaxial;
  uniaxial[1][1] = -4.;
  shear[0][2]    = 2.;
  biaxial[0][0] = biaxial[1][1] = -3.;
  EXPECT_NEAR(von_mises(uniaxial), 4., 1e-14);
  EXPECT_NEAR(von_mises(shear), 2. * std::sqrt(3.), 1e-14);
  EXPECT_NEAR(von_mises(biaxial), 3., 1e-14);
  EXPECT_NEAR(von_mises(3. * dealii::unit_symmetric_tensor<3>()), 0., 1e-14);
}

TEST(VonMises, AgreesWithPrincipalStresses)
{
  const auto   stress = dealii::SymmetricTensor<2, 3>(symmetrize(random_matrix<3>(54)));
  const auto   s      = eigenvalues(stress);
  const double expected =
    std::sqrt(0.5 * ((s[0] - s[1]) * (s[0] - s[1]) + (s[1] - s[2]) * (s[1] - s[2]) +
                     (s[2] - s[0]) * (s[2] - s[0])));
  // dealii::eigenvalues solves the cubic: fewer digits
  EXPECT_NEAR(von_mises(stress), expected, 1e-12);
}
