#include "textbook_element.h"

#include <Sacado.hpp>

using namespace elasticity_cells;

namespace {
/// A number with its derivative along one velocity.
using Dual = Sacado::Fad::SFad<double, 1>;

/// The textbook's element for positions X + t V.
template <int dim>
TextbookElement<Dual> differentiated(const TestElement<dim> &of,
                                     const unsigned int      degree,
                                     const Material         &material,
                                     const Nodes<dim>       &V)
{
  Matrix<Dual> X;
  for (unsigned int a = 0; a < V.size(); ++a)
    {
      X.emplace_back();
      for (unsigned int c = 0; c < dim; ++c)
        {
          Dual x(of.X[a][c]);
          x.resize(1);
          x.fastAccessDx(0) = V[a][c];
          X.back().push_back(x);
        }
    }
  return TextbookElement<Dual>(dealii::Tensor<1, dim>(), of.idealization, of.formulation, degree,
                               material, X);
}
} // namespace

template <typename Case>
class AutomaticDifferentiation : public ::testing::Test
{
};
TYPED_TEST_SUITE(AutomaticDifferentiation, AllCases);

TYPED_TEST(AutomaticDifferentiation, GivesStiffnessAndItsDerivative)
{
  constexpr int          dim    = TypeParam::dim;
  constexpr unsigned int degree = TypeParam::degree;
  for (const double nu : {0.3, 0.4999})
    for (const auto &of : all_elements<dim>(degree, 61))
      {
        const Material      material{7., nu};
        const auto          V        = random_field<dim>(of.X.size(), 62);
        const auto          u        = random_field<dim>(of.X.size(), 63);
        const auto          expected = differentiated<dim>(of, degree, material, V);
        const unsigned int  N        = dim * V.size();
        std::vector<double> K;
        of.element.stiffness(of.X, material, K);
        Nodes<dim> Ku(V.size());
        const auto found =
          of.element
            .internal_force_derivatives(of.X, {random_field<dim>(of.X.size(), 64), V}, material, u)
            .back();
        // round-off; the textbook's condensation of D cancels 1e-4 of it
        const double scale = largest(K);
        for (unsigned int i = 0; i < N; ++i)
          for (unsigned int j = 0; j < N; ++j)
            {
              EXPECT_NEAR(K[i * N + j], expected.K[i][j].val(), 1e-12 * scale) << of.name();
              Ku[i / dim][i % dim] += expected.K[i][j].dx(0) * u[j / dim][j % dim];
            }
        EXPECT_LT(distance<dim>(found, Ku), 1e-12 * scale) << of.name();
      }
}

TYPED_TEST(AutomaticDifferentiation, GivesVolumeAndBodyForceWithDerivatives)
{
  constexpr int          dim    = TypeParam::dim;
  constexpr unsigned int degree = TypeParam::degree;
  for (const auto &of : all_elements<dim>(degree, 64))
    {
      const auto V        = random_field<dim>(of.X.size(), 65);
      const auto expected = differentiated<dim>(of, degree, material, V);
      Nodes<dim> gradient(V.size()), f, f_derivative;
      of.element.add_volume_gradient(of.X, 1., gradient);
      const double size = of.element.volume(of.X);
      EXPECT_NEAR(size, expected.volume.val(), 1e-13 * size) << of.name();
      EXPECT_NEAR(dot<dim>(gradient, V), expected.volume.dx(0),
                  1e-13 * norm<dim>(gradient) * norm<dim>(V))
        << of.name();

      dealii::Tensor<1, dim> ones;
      for (unsigned int c = 0; c < dim; ++c)
        ones[c] = 1.;
      const Nodes<dim> density(V.size(), ones);
      of.element.body_force(of.X, density, f);
      of.element.body_force_derivative(of.X, V, density, f_derivative);
      for (unsigned int i = 0; i < dim * V.size(); ++i)
        {
          EXPECT_NEAR(f[i / dim][i % dim], expected.body_force[i].val(), 1e-13 * size);
          EXPECT_NEAR(f_derivative[i / dim][i % dim], expected.body_force[i].dx(0), 1e-12 * size);
        }
    }
}
