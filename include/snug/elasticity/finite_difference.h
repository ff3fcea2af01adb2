#ifndef snug_elasticity_finite_difference_h
#define snug_elasticity_finite_difference_h

#include <snug/base/values.h>

#include <deal.II/base/tensor.h>

#include <functional>
#include <vector>

namespace snug::elasticity {
/// A derivative as a sum of values, f' ~ sum_k weight_k f(place_k step) / step.
struct Stencil
{
  std::vector<double> places, weights;
};

/// Finite difference formulas. Their errors are of order h, h, h^2 and h^4.
enum class Differences
{
  forward,
  backward,
  central,
  fourth_order
};
inline Names names(Differences)
{
  return {{"forward", "(f(h) - f(0)) / h"},
          {"backward", "(f(0) - f(-h)) / h"},
          {"central", "(f(h) - f(-h)) / 2h"},
          {"fourth order", "(f(-2h) - 8 f(-h) + 8 f(h) - f(2h)) / 12h"}};
}
Stencil stencil(Differences differences);

/// Function that computes f, one vector per node, from the node positions X.
template <int dim>
using NodeFunction = std::function<void(const std::vector<dealii::Tensor<1, dim>> &X,
                                        std::vector<dealii::Tensor<1, dim>>       &f)>;

/// Return the derivative of f at X along V by @p stencil. The step multiplies V.
template <int dim>
std::vector<dealii::Tensor<1, dim>> difference(const Stencil                             &stencil,
                                               const NodeFunction<dim>                   &f,
                                               const std::vector<dealii::Tensor<1, dim>> &X,
                                               const std::vector<dealii::Tensor<1, dim>> &V,
                                               double                                     step);
} // namespace snug::elasticity

#endif
