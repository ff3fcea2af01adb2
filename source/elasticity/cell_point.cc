#include <snug/elasticity/cell_point.h>

#include <deal.II/base/exceptions.h>

namespace snug
{
  namespace elasticity
  {
    template <int dim>
    dealii::Tensor<2, dim>
    jacobian(const LagrangePoint<dim>                  &shape,
             const std::vector<dealii::Tensor<1, dim>> &X)
    {
      AssertDimension(X.size(), shape.gradients.size());
      dealii::Tensor<2, dim> J;
      for (unsigned int a = 0; a < X.size(); ++a)
        J += outer_product(X[a], shape.gradients[a]);
      return J;
    }

    template <int dim>
    CellPoint<dim>::CellPoint(const LagrangePoint<dim> &shape, const Nodes &X)
      : shape(shape)
    {
      const dealii::Tensor<2, dim> J       = jacobian(shape, X);
      const dealii::Tensor<2, dim> inverse = invert(J);

      dV = shape.weight * determinant(J);
      for (unsigned int a = 0; a < X.size(); ++a)
        gradients[a] = shape.gradients[a] * inverse;
    }

    template <int dim>
    dealii::Tensor<2, dim>
    CellPoint<dim>::gradient(const Nodes &u) const
    {
      AssertDimension(u.size(), shape.values.size());
      dealii::Tensor<2, dim> result;
      for (unsigned int a = 0; a < u.size(); ++a)
        result += outer_product(u[a], gradients[a]);
      return result;
    }

    template <int dim>
    dealii::Tensor<1, dim>
    CellPoint<dim>::value(const Nodes &u) const
    {
      AssertDimension(u.size(), shape.values.size());
      dealii::Tensor<1, dim> result;
      for (unsigned int a = 0; a < u.size(); ++a)
        result += shape.values[a] * u[a];
      return result;
    }

    template dealii::Tensor<2, 2>
    jacobian(const LagrangePoint<2> &,
             const std::vector<dealii::Tensor<1, 2>> &);
    template dealii::Tensor<2, 3>
    jacobian(const LagrangePoint<3> &,
             const std::vector<dealii::Tensor<1, 3>> &);
    template struct CellPoint<2>;
    template struct CellPoint<3>;
  } // namespace elasticity
} // namespace snug
