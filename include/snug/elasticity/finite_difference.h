#ifndef snug_elasticity_finite_difference_h
#define snug_elasticity_finite_difference_h

#include <deal.II/base/tensor.h>

#include <functional>
#include <vector>

namespace snug
{
  namespace elasticity
  {
    /// f <- a vector per node, computed from the node positions X.
    template <int dim>
    using NodeFunction =
      std::function<void(const std::vector<dealii::Tensor<1, dim>> &X,
                         std::vector<dealii::Tensor<1, dim>>       &f)>;

    /**
     * (f(X + step V) - f(X - step V)) / (2 step): the semi-analytic
     * alternative to the exact derivatives of Element and FaceLoad. The error
     * is O(step^2) + O(round-off / step); best is a step that moves nodes by
     * about 1e-5 of the cell. The step multiplies V.
     */
    template <int dim>
    std::vector<dealii::Tensor<1, dim>>
    central_difference(const NodeFunction<dim>                   &f,
                       const std::vector<dealii::Tensor<1, dim>> &X,
                       const std::vector<dealii::Tensor<1, dim>> &V,
                       double                                     step);
  } // namespace elasticity
} // namespace snug

#endif
