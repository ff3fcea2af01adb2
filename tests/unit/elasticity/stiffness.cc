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

  Stiffness()
  {
    element.stiffness(X, material, K);
  }
};
TYPED_TEST_SUITE(Stiffness, AllCases);

TYPED_TEST(Stiffness, IsExactlySymmetric)
{
  const unsigned int n = TestFixture::dim * this->X.size();
  ASSERT_EQ(this->K.size(), n * n);
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < i; ++j)
      EXPECT_EQ(this->K[i * n + j], this->K[j * n + i]);
}

TYPED_TEST(Stiffness, OnlyRigidMotionsAreFree)
{
  constexpr int dim   = TestFixture::dim;
  const double  scale = largest(this->K);

  for (unsigned int d = 0; d < dim; ++d)
    {
      Nodes<dim> translation(this->X.size());
      for (auto &vector : translation)
        vector[d] = 1.;
      EXPECT_LT(norm<dim>(multiply<dim>(this->K, translation)), 1e-13 * scale);
    }
  for (const unsigned int seed : {1, 2, 3})
    {
      const auto rotation = times<dim>(random_skew<dim>(seed), this->X);
      EXPECT_LT(norm<dim>(multiply<dim>(this->K, rotation)), 1e-13 * scale);
    }

  // as many zero eigenvalues as rigid motions, all others positive
  const unsigned int               n = dim * this->X.size();
  dealii::LAPACKFullMatrix<double> matrix(n);
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n; ++j)
      matrix(i, j) = this->K[i * n + j];
  dealii::Vector<double>     eigenvalues;
  dealii::FullMatrix<double> eigenvectors;
  matrix.compute_eigenvalues_symmetric(
    -1e3 * scale, 1e3 * scale, 0., eigenvalues, eigenvectors);
  ASSERT_EQ(eigenvalues.size(), n);
  unsigned int n_zero = 0;
  for (const double eigenvalue : eigenvalues)
    {
      EXPECT_GT(eigenvalue, -1e-13 * scale);
      n_zero += eigenvalue < 1e-13 * scale;
      EXPECT_TRUE(eigenvalue < 1e-13 * scale || eigenvalue > 1e-4 * scale);
    }
  EXPECT_EQ(n_zero, dim * (dim + 1) / 2);
}

TYPED_TEST(Stiffness, PatchTest)
{
  // A linear displacement has one stress, balanced by sigma n on the faces.
  constexpr int dim      = TestFixture::dim;
  const auto    gradient = random_matrix<dim>(3);
  const auto    u        = times<dim>(gradient, this->X);

  const double           trace_e = trace(gradient);
  dealii::Tensor<2, dim> stress  = gradient + transpose(gradient);
  stress *= material.lame_mu();
  for (unsigned int d = 0; d < dim; ++d)
    stress[d][d] += material.lame_lambda() * trace_e;

  const auto boundary_force =
    times<dim>(stress, boundary_normals<dim>(TestFixture::degree, this->X));
  const double scale = largest(this->K);
  EXPECT_LT(distance<dim>(multiply<dim>(this->K, u), boundary_force),
            1e-13 * scale);

  for (const unsigned int seed : {1, 2})
    {
      dealii::Point<dim> point;
      for (unsigned int d = 0; d < dim; ++d)
        point[d] = 0.5 + 0.5 * random_field<dim>(1, seed)[0][d];
      double     out_of_plane = -1.;
      const auto found =
        this->element.stress(this->X, material, u, point, out_of_plane);
      EXPECT_LT((dealii::Tensor<2, dim>(found) - stress).norm(), 1e-13 * scale);
      EXPECT_NEAR(out_of_plane,
                  dim == 2 ? material.lame_lambda() * trace_e : 0.,
                  1e-13 * scale);
    }
}

TYPED_TEST(Stiffness, InternalForceIsTheProduct)
{
  constexpr int dim = TestFixture::dim;
  const auto    u   = random_field<dim>(this->X.size(), 7);
  Nodes<dim>    r(3); // a wrong size must not matter
  this->element.internal_force(this->X, material, u, r);
  EXPECT_LT(distance<dim>(r, multiply<dim>(this->K, u)),
            1e-13 * largest(this->K));
}

TYPED_TEST(Stiffness, ScalesWithUnits)
{
  // K ~ E length^(dim-2); powers of two scale without round-off
  constexpr int dim = TestFixture::dim;
  Nodes<dim>    X_scaled(this->X);
  for (auto &x : X_scaled)
    x *= 8.;
  std::vector<double> K_scaled;
  this->element.stiffness(X_scaled,
                          Material{4. * material.youngs_modulus,
                                   material.poissons_ratio},
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
