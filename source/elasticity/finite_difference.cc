#include <snug/elasticity/finite_difference.h>

#include <deal.II/base/exceptions.h>

namespace snug
{
  namespace elasticity
  {
    template <int dim>
    std::vector<dealii::Tensor<1, dim>>
    central_difference(const NodeFunction<dim>                   &f,
                       const std::vector<dealii::Tensor<1, dim>> &X,
                       const std::vector<dealii::Tensor<1, dim>> &V,
                       const double                               step)
    {
      AssertDimension(X.size(), V.size());
      Assert(step > 0., dealii::ExcMessage("The step must be positive."));

      std::vector<dealii::Tensor<1, dim>> forward(X), backward(X), f_forward,
        f_backward;
      for (unsigned int a = 0; a < X.size(); ++a)
        {
          forward[a] += step * V[a];
          backward[a] -= step * V[a];
        }
      f(forward, f_forward);
      f(backward, f_backward);

      AssertDimension(f_forward.size(), f_backward.size());
      for (unsigned int a = 0; a < f_forward.size(); ++a)
        f_forward[a] = (f_forward[a] - f_backward[a]) / (2. * step);
      return f_forward;
    }

    template std::vector<dealii::Tensor<1, 2>>
    central_difference(const NodeFunction<2> &,
                       const std::vector<dealii::Tensor<1, 2>> &,
                       const std::vector<dealii::Tensor<1, 2>> &,
                       double);
    template std::vector<dealii::Tensor<1, 3>>
    central_difference(const NodeFunction<3> &,
                       const std::vector<dealii::Tensor<1, 3>> &,
                       const std::vector<dealii::Tensor<1, 3>> &,
                       double);
  } // namespace elasticity
} // namespace snug
