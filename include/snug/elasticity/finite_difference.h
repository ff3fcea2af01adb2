#ifndef snug_elasticity_finite_difference_h
#define snug_elasticity_finite_difference_h

#include <snug/base/choice.h>

#include <deal.II/base/tensor.h>

#include <functional>
#include <vector>

namespace snug::elasticity {
/// A derivative as a sum of values, f' ~ sum_k weight_k f(place_k step)
/// / step.
struct Stencil
{
  std::vector<double> places, weights;
};

/// Rows "forward", "backward", "central" and "fourth order".
const ChoiceTable<Stencil()> &stencil_table();

/// f <- a vector per node, computed from the node positions X.
template <int dim>
using NodeFunction = std::function<void(const std::vector<dealii::Tensor<1, dim>> &X,
                                        std::vector<dealii::Tensor<1, dim>>       &f)>;

/// The derivative of f at X along V by @p stencil; the step multiplies V.
template <int dim>
std::vector<dealii::Tensor<1, dim>> difference(const Stencil                             &stencil,
                                               const NodeFunction<dim>                   &f,
                                               const std::vector<dealii::Tensor<1, dim>> &X,
                                               const std::vector<dealii::Tensor<1, dim>> &V,
                                               double                                     step);
} // namespace snug::elasticity

#endif
