#include "cells.h"

#include <snug/elasticity/semi_analytic.h>

using namespace elasticity_cells;

namespace {
/// Relative step of the differences of this file.
const double tiny = 1e-5;

template <typename Case>
class SemiAnalyticDerivatives : public ::testing::Test
{
public:
  static constexpr int          dim    = Case::dim;
  static constexpr unsigned int degree = Case::degree;

  const std::vector<TestElement<dim>> elements = all_elements<dim>(degree, 31);
  const std::size_t                   n        = elements[0].X.size();
  const Nodes<dim>                    V        = random_field<dim>(n, 32);
  const Nodes<dim>                    u        = random_field<dim>(n, 33);

  static Nodes<dim> exact(const TestElement<dim> &of, const Nodes<dim> &V, const Nodes<dim> &u)
  {
    return of.element.internal_force_derivatives(of.X, {V}, material, u).front();
  }

  static Nodes<dim> differences(const TestElement<dim> &of,
                                const Differences       name,
                                const bool              refined,
                                const double            step,
                                const Nodes<dim>       &V,
                                const Nodes<dim>       &u)
  {
    Nodes<dim> r;
    SemiAnalytic<dim>(stencil(name), refined, step, of.idealization)
      .internal_force_derivative(of.element, of.X, V, material, u, r);
    return r;
  }

  /// A rigid motion of the element.
  Nodes<dim> rigid(const TestElement<dim> &of) const
  {
    const auto W      = random_skew<dim>(34);
    const auto t      = random_field<dim>(1, 35)[0];
    Nodes<dim> motion = times<dim>(W, of.X);
    for (unsigned int a = 0; a < this->n; ++a)
      for (unsigned int c = 0; c < dim; ++c)
        if (of.idealization.is_axisymmetric())
          motion[a][c] = c == 1 ? t[c] : 0.;
        else
          motion[a][c] += t[c];
    return motion;
  }
};
TYPED_TEST_SUITE(SemiAnalyticDerivatives, AllCases);

TYPED_TEST(SemiAnalyticDerivatives, HaveTheOrderOfTheirStencil)
{
  constexpr int dim   = TestFixture::dim;
  const auto   &of    = this->elements[0];
  const auto    exact = this->exact(of, this->V, this->u);
  // what doubling the step does, above round-off and below higher orders
  struct Order
  {
    Differences differences;
    double      step, ratio;
  };
  for (const Order &order :
       {Order{Differences::forward, 1e-4, 2.}, Order{Differences::backward, 1e-4, 2.},
        Order{Differences::central, 1e-3, 4.}, Order{Differences::fourth_order, 1e-2, 16.}})
    for (const bool refined : {false, true})
      {
        const auto error = [&](const double step) {
          return distance<dim>(this->differences(of, order.differences, refined, step, this->V,
                                                 this->u),
                               exact);
        };
        // cells of higher degree are smaller to their nodes
        const double step = order.step / (TestFixture::degree * TestFixture::degree);
        EXPECT_NEAR(error(2. * step) / error(step), order.ratio, 0.05 * order.ratio)
          << snug::to_text(order.differences) << (refined ? ", refined" : "");
      }
}

TYPED_TEST(SemiAnalyticDerivatives, ApproachTheExactOnes)
{
  constexpr int dim = TestFixture::dim;
  for (const auto &of : this->elements)
    for (const bool refined : {false, true})
      {
        const auto exact = this->exact(of, this->V, this->u);
        EXPECT_LT(distance<dim>(this->differences(of, Differences::central, refined, tiny, this->V,
                                                  this->u),
                                exact),
                  1e-7 * norm<dim>(exact))
          << of.name();
      }
}

TYPED_TEST(SemiAnalyticDerivatives, RefinedOnesAreExactForRigidMotions)
{
  // at any step, where the others have the error of their stencil
  constexpr int dim = TestFixture::dim;
  for (const auto &of : this->elements)
    {
      const auto motion = this->rigid(of);
      const auto exact  = this->exact(of, this->V, motion);
      const auto error  = [&](const bool refined) {
        return distance<dim>(this->differences(of, Differences::forward, refined, 1e-2, this->V,
                                                motion),
                              exact);
      };
      const double size = norm<dim>(this->exact(of, this->V, this->u));
      EXPECT_LT(error(true), 1e-12 * size) << of.name();
      if (!of.idealization.is_axisymmetric())
        {
          EXPECT_GT(error(false), 1e-4 * size) << of.name();
        }
    }
}

TYPED_TEST(SemiAnalyticDerivatives, VelocityOfATranslationDoesNotMatter)
{
  constexpr int dim = TestFixture::dim;
  for (const auto &of : this->elements)
    {
      auto V = this->V;
      for (auto &v : V)
        for (unsigned int c = 0; c < dim; ++c)
          if (of.may_translate(c))
            v[c] += 1e3;
      const auto expected =
        this->differences(of, Differences::forward, false, tiny, this->V, this->u);
      EXPECT_LT(distance<dim>(this->differences(of, Differences::forward, false, tiny, V, this->u),
                              expected),
                1e-6 * norm<dim>(expected))
        << of.name();
    }
}
} // namespace
