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
    }
}

TEST(CauchyStress, UniaxialTensionRecoversYoungAndPoisson)
{
  const double         strain = 1e-3;
  dealii::Tensor<2, 3> gradient;
  gradient[0][0] = strain;
  gradient[1][1] = gradient[2][2] = -material.poissons_ratio * strain;
  auto stress                     = cauchy_stress(material, gradient);
  EXPECT_NEAR(stress[0][0], material.youngs_modulus * strain, 1e-16);
  stress[0][0] = 0.;
  EXPECT_LT(stress.norm(), 1e-16);
}

TEST(CauchyStress, PlaneStrainIsASliceOf3D)
{
  const auto           gradient = random_matrix<2>(51);
  dealii::Tensor<2, 3> gradient_3d;
  for (unsigned int i = 0; i < 2; ++i)
    for (unsigned int j = 0; j < 2; ++j)
      gradient_3d[i][j] = gradient[i][j];
  const auto stress    = cauchy_stress(material, gradient);
  const auto stress_3d = cauchy_stress(material, gradient_3d);
  for (unsigned int i = 0; i < 2; ++i)
    for (unsigned int j = 0; j < 2; ++j)
      EXPECT_DOUBLE_EQ(stress[i][j], stress_3d[i][j]);
  EXPECT_DOUBLE_EQ(von_mises(stress, stress_3d[2][2]),
                   von_mises(stress_3d, 0.));
}

TEST(CauchyStress, RotationsAreFree)
{
  EXPECT_EQ(cauchy_stress(material, random_skew<3>(52)).norm(), 0.);
  EXPECT_EQ(cauchy_stress(material, random_skew<2>(53)).norm(), 0.);
}

TEST(VonMises, KnownStates)
{
  dealii::SymmetricTensor<2, 3> uniaxial, shear;
  uniaxial[1][1] = -4.;
  shear[0][2]    = 2.;
  EXPECT_NEAR(von_mises(uniaxial, 99.), 4., 1e-14);
  EXPECT_NEAR(von_mises(shear, 99.), 2. * std::sqrt(3.), 1e-14);
  EXPECT_NEAR(von_mises(3. * dealii::unit_symmetric_tensor<3>(), 0.),
              0.,
              1e-14);

  const auto pressure = -3. * dealii::unit_symmetric_tensor<2>();
  EXPECT_NEAR(von_mises(pressure, -3.), 0., 1e-14);
  EXPECT_NEAR(von_mises(pressure, 0.), 3., 1e-14);
}

TEST(VonMises, AgreesWithPrincipalStresses)
{
  const auto stress =
    dealii::SymmetricTensor<2, 3>(symmetrize(random_matrix<3>(54)));
  const auto   s        = eigenvalues(stress);
  const double expected = std::sqrt(0.5 * ((s[0] - s[1]) * (s[0] - s[1]) +
                                           (s[1] - s[2]) * (s[1] - s[2]) +
                                           (s[2] - s[0]) * (s[2] - s[0])));
  // dealii::eigenvalues solves the cubic: fewer digits
  EXPECT_NEAR(von_mises(stress, 0.), expected, 1e-12);
}
