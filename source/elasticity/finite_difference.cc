#include <snug/base/assertions.h>
#include <snug/elasticity/finite_difference.h>


namespace snug::elasticity {
Stencil stencil(const Differences differences)
{
  static const Stencil stencils[] = {{{0., 1.}, {-1., 1.}},
                                     {{-1., 0.}, {-1., 1.}},
                                     {{-1., 1.}, {-1. / 2., 1. / 2.}},
                                     {{-2., -1., 1., 2.},
                                      {1. / 12., -8. / 12., 8. / 12., -1. / 12.}}};
  return stencils[static_cast<unsigned int>(differences)];
}

template <int dim>
std::vector<dealii::Tensor<1, dim>> difference(const Stencil                             &stencil,
                                               const NodeFunction<dim>                   &f,
                                               const std::vector<dealii::Tensor<1, dim>> &X,
                                               const std::vector<dealii::Tensor<1, dim>> &V,
                                               const double                               step)
{
  SNUG_ASSERT_EQUAL(X.size(), V.size());
  SNUG_ASSERT(step > 0., "the step must be positive");
  std::vector<dealii::Tensor<1, dim>> at, values, sum;
  for (unsigned int k = 0; k < stencil.places.size(); ++k)
    {
      at = X;
      for (unsigned int a = 0; a < X.size(); ++a)
        // Start from X each time, so that rounding of the moves does not add up.
        at[a] += stencil.places[k] * step * V[a];
      f(at, values);
      // The number of vectors of f may differ from the number of nodes in X.
      sum.resize(values.size());
      for (unsigned int a = 0; a < values.size(); ++a)
        sum[a] += stencil.weights[k] / step * values[a];
    }
  return sum;
}

template std::vector<dealii::Tensor<1, 2>> difference(const Stencil &,
                                                      const NodeFunction<2> &,
                                                      const std::vector<dealii::Tensor<1, 2>> &,
                                                      const std::vector<dealii::Tensor<1, 2>> &,
                                                      double);
template std::vector<dealii::Tensor<1, 3>> difference(const Stencil &,
                                                      const NodeFunction<3> &,
                                                      const std::vector<dealii::Tensor<1, 3>> &,
                                                      const std::vector<dealii::Tensor<1, 3>> &,
                                                      double);
} // namespace snug::elasticity
