#include <snug/mesh/tetrahedron.h>

#include "cells.h"

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

using namespace elasticity_cells;

template <typename Case>
class Stiffness : public ::testing::Test
{
public:
  static constexpr int          dim    = Case::dim;
  static constexpr unsigned int degree = Case::degree;

  const Element<dim>  element{degree};
  const Nodes<dim>    X = distorted<dim>(degree, 1);
  std::vector<double> K;

  Stiffness() { element.stiffness(X, material, K); }
};
TYPED_TEST_SUITE(Stiffness, AllCases);

/// Eigenvalues of a symmetric matrix.
dealii::Vector<double> eigenvalues(const std::vector<double> &K)
{
  const unsigned int               n = std::lround(std::sqrt(K.size()));
  dealii::LAPACKFullMatrix<double> matrix(n);
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n; ++j)
      matrix(i, j) = K[i * n + j];
  const double               bound = n * largest(K);
  dealii::Vector<double>     values;
  dealii::FullMatrix<double> vectors;
  matrix.compute_eigenvalues_symmetric(-bound, bound, 0., values, vectors);
  return values;
}

TYPED_TEST(Stiffness, IsExactlySymmetric)
{
  constexpr int dim = TestFixture::dim;
  for (const auto &of : all_elements<dim>(TestFixture::degree, 1))
    {
      std::vector<double> K;
      of.element.stiffness(of.X, material, K);
      const unsigned int n = dim * of.X.size();
      ASSERT_EQ(K.size(), n * n);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < i; ++j)
          EXPECT_EQ(K[i * n + j], K[j * n + i]) << of.name();
    }
}

TYPED_TEST(Stiffness, OnlyRigidMotionsAreFree)
{
  constexpr int dim = TestFixture::dim;
  for (const auto &of : all_elements<dim>(TestFixture::degree, 1))
    {
      std::vector<double> K;
      of.element.stiffness(of.X, material, K);
      const double scale = largest(K);
      for (unsigned int d = 0; d < dim; ++d)
        if (of.may_translate(d))
          {
            Nodes<dim> translation(of.X.size());
            for (auto &vector : translation)
              vector[d] = 1.;
            EXPECT_LT(norm<dim>(multiply<dim>(K, translation)), 1e-13 * scale) << of.name();
          }
      if (!of.idealization.is_axisymmetric())
        for (const unsigned int seed : {1, 2, 3})
          {
            const auto rotation = times<dim>(random_skew<dim>(seed), of.X);
            EXPECT_LT(norm<dim>(multiply<dim>(K, rotation)), 1e-13 * scale) << of.name();
          }

      // as many zero eigenvalues as rigid motions, all others positive
      const auto values = eigenvalues(K);
      ASSERT_EQ(values.size(), dim * of.X.size());
      unsigned int n_zero = 0;
      for (const double eigenvalue : values)
        {
          EXPECT_GT(eigenvalue, -1e-13 * scale) << of.name();
          n_zero += eigenvalue < 1e-13 * scale;
          EXPECT_TRUE(eigenvalue < 1e-13 * scale || eigenvalue > 1e-4 * scale) << of.name();
        }
      EXPECT_EQ(n_zero, of.idealization.n_rigid_motions()) << of.name();
    }
}

TYPED_TEST(Stiffness, PatchTest)
{
  // A linear displacement has one stress, balanced by sigma n on the faces;
  // of an axisymmetric one, only u = (a r, b r + c z) has equal hoop and
  // radial stress and with it no body force.
  constexpr int dim = TestFixture::dim;
  for (const auto &of : all_elements<dim>(TestFixture::degree, 1))
    {
      auto         gradient = random_matrix<dim>(3);
      const double E = material.youngs_modulus, nu = material.poissons_ratio;
      double       across = 0.; // strain
      if (of.idealization.kind == Idealization::Kind::plane_stress)
        across = -nu / (1. - nu) * trace(gradient);
      if (of.idealization.is_axisymmetric())
        {
          gradient[0][1] = 0.;
          across         = gradient[0][0];
        }
      const auto           u = times<dim>(gradient, of.X);
      dealii::Tensor<2, 3> stress;
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int d = 0; d < dim; ++d)
          stress[c][d] = E / (1. + nu) * (gradient[c][d] + gradient[d][c]) / 2.;
      if (dim == 2)
        stress[2][2] = E / (1. + nu) * across;
      for (unsigned int d = 0; d < 3; ++d)
        stress[d][d] += E / (1. + nu) * nu / (1. - 2. * nu) * (trace(gradient) + across);

      dealii::Tensor<2, dim> in_plane;
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int d = 0; d < dim; ++d)
          in_plane[c][d] = stress[c][d];
      std::vector<double> K;
      of.element.stiffness(of.X, material, K);
      auto expected =
        times<dim>(in_plane, boundary_normals<dim>(TestFixture::degree, of.X, of.idealization));
      if (of.idealization.is_axisymmetric())
        {
          // shear b mu makes the axial body force b mu / r: take the moment
          // of the nodal forces in r alone
          ASSERT_NEAR(stress[0][0], stress[2][2], 1e-13);
          const double shear = stress[0][1];
          Nodes<dim>   force;
          Element<dim>(TestFixture::degree, {Idealization::Kind::plane_strain})
            .body_force(of.X,
                        Nodes<dim>(of.X.size(), -2. * dealii::numbers::PI * shear *
                                                  dealii::Point<dim>::unit_vector(1)),
                        force);
          expected = sum<dim>(expected, 1., force);
        }
      const double scale = largest(K);
      EXPECT_LT(distance<dim>(multiply<dim>(K, u), expected), 1e-13 * scale) << of.name();

      std::vector<snug::mesh::LagrangePoint<dim>> shapes;
      for (const auto &point : snug::mesh::lagrange_gauss_points<dim>(TestFixture::degree + 1))
        shapes.push_back(snug::mesh::lagrange_point<dim>(TestFixture::degree, point.point));
      for (const auto &found : of.element.stresses(of.X, material, u, shapes))
        EXPECT_LT((dealii::Tensor<2, 3>(found) - stress).norm(), 1e-13 * scale) << of.name();
    }
}

TYPED_TEST(Stiffness, InternalForceIsTheProduct)
{
  constexpr int dim = TestFixture::dim;
  for (const auto &of : all_elements<dim>(TestFixture::degree, 1))
    {
      const auto          u = random_field<dim>(of.X.size(), 7);
      std::vector<double> K;
      of.element.stiffness(of.X, material, K);
      Nodes<dim> r(3); // a wrong size must not matter
      of.element.internal_force(of.X, material, u, r);
      EXPECT_LT(distance<dim>(r, multiply<dim>(K, u)), 1e-13 * largest(K)) << of.name();
    }
}

TYPED_TEST(Stiffness, BBarFreesVolumePreservingMotions)
{
  // Stiff against as many motions as there are pressures, 1 or 1 + dim, as
  // Poisson's ratio goes to 0.5; standard elements against many more.
  constexpr int      dim = TestFixture::dim;
  const Material     soft{7., 0.5 - 1e-7};
  const unsigned int n_pressures = TestFixture::degree == 1 ? 1 : 1 + dim;
  for (const auto &of : all_elements<dim>(TestFixture::degree, 1))
    {
      std::vector<double> K;
      of.element.stiffness(of.X, soft, K);
      unsigned int n_stiff = 0;
      for (const double eigenvalue : eigenvalues(K))
        n_stiff += eigenvalue > 1e4 * soft.youngs_modulus;
      if (of.formulation == Formulation::B_bar)
        EXPECT_EQ(n_stiff, n_pressures) << of.name();
      else if (of.idealization.kind == Idealization::Kind::plane_stress)
        EXPECT_EQ(n_stiff, 0u);
      else
        EXPECT_GT(n_stiff, n_pressures) << of.name();
    }
}

TYPED_TEST(Stiffness, ScalesWithUnits)
{
  // K ~ E length^(dim-2); powers of two scale without round-off
  constexpr int dim = TestFixture::dim;
  Nodes<dim>    X_scaled(this->X);
  for (auto &x : X_scaled)
    x *= 8.;
  std::vector<double> K_scaled;
  this->element.stiffness(X_scaled, Material{4. * material.youngs_modulus, material.poissons_ratio},
                          K_scaled);
  const double factor = 4. * (dim == 3 ? 8. : 1.);
  for (unsigned int i = 0; i < this->K.size(); ++i)
    EXPECT_DOUBLE_EQ(K_scaled[i], factor * this->K[i]);
}

TYPED_TEST(Stiffness, RotatesWithTheCell)
{
  // K(R X) R u = R K(X) u for a quarter turn in the x-y plane
  constexpr int          dim = TestFixture::dim;
  dealii::Tensor<2, dim> R;
  R[0][1] = -1.;
  R[1][0] = 1.;
  if (dim == 3)
    R[dim - 1][dim - 1] = 1.;
  const auto          u = random_field<dim>(this->X.size(), 8);
  std::vector<double> K_rotated;
  this->element.stiffness(times<dim>(R, this->X), material, K_rotated);
  EXPECT_LT(distance<dim>(multiply<dim>(K_rotated, times<dim>(R, u)),
                          times<dim>(R, multiply<dim>(this->K, u))),
            1e-13 * largest(this->K));
}

TYPED_TEST(Stiffness, TangledCellGivesNumbers)
{
  // a mirrored cell has negative det J everywhere and K of opposite sign
  constexpr int dim      = TestFixture::dim;
  auto          mirrored = this->X;
  for (auto &x : mirrored)
    x[0] = -x[0];
  std::vector<double> K_mirrored;
  this->element.stiffness(mirrored, material, K_mirrored);
  for (unsigned int i = 0; i < this->K.size(); i += dim * this->X.size() + 1)
    EXPECT_NEAR(K_mirrored[i], -this->K[i], 1e-13 * largest(this->K));
}

/// The stiffness of a tetrahedron is the sum over its cells, condensed to its ten nodes: with
/// straight edges, where it has a rule of its own, and with curved ones.
TEST(StiffnessOfTetrahedron, IsTheSumOverItsCells)
{
  const Element<3> element(2);
  for (const double curvature : {0., 0.05})
    {
      Nodes<3> X(10);
      X[1] = dealii::Point<3>(1.1, 0.1, 0.);
      X[2] = dealii::Point<3>(0.2, 0.9, 0.1);
      X[3] = dealii::Point<3>(0.1, 0.2, 1.2);
      for (unsigned int a = 0; a < 4; ++a)
        for (unsigned int b = 0; b < a; ++b)
          {
            X[snug::mesh::Tetrahedron::middle(a, b)] = 0.5 * (X[a] + X[b]);
            X[snug::mesh::Tetrahedron::middle(a, b)][a % 3] += curvature * (1. + 0.3 * b);
          }
      std::vector<double> sum(900, 0.), of_cell, K;
      for (unsigned int corner = 0; corner < 4; ++corner)
        {
          const auto &T = snug::mesh::tetrahedron_functions(corner);
          Nodes<3>    x(27);
          for (unsigned int i = 0; i < 27; ++i)
            for (unsigned int a = 0; a < 10; ++a)
              x[i] += T[10 * i + a] * X[a];
          element.stiffness(x, material, of_cell);
          for (unsigned int row = 0; row < 81; ++row)
            for (unsigned int column = 0; column < 81; ++column)
              for (unsigned int a = 0; a < 10; ++a)
                for (unsigned int b = 0; b < 10; ++b)
                  sum[(3 * a + row % 3) * 30 + 3 * b + column % 3] +=
                    T[row / 3 * 10 + a] * T[column / 3 * 10 + b] * of_cell[row * 81 + column];
        }
      element.stiffness_of_tetrahedron(X, material, K);
      ASSERT_EQ(K.size(), sum.size());
      for (unsigned int i = 0; i < K.size(); ++i)
        EXPECT_NEAR(K[i], sum[i], 1e-12 * largest(K)) << curvature;
    }
}
