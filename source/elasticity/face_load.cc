#include <snug/elasticity/face_load.h>

#include <deal.II/base/exceptions.h>

#include <array>

namespace snug
{
  namespace elasticity
  {
    namespace
    {
      /// t_i = dx / d xi_i of the positions (or velocities) of a face's nodes.
      template <int dim>
      std::array<dealii::Tensor<1, dim>, dim - 1>
      tangents(const LagrangePoint<dim - 1>              &shape,
               const std::vector<dealii::Tensor<1, dim>> &X)
      {
        AssertDimension(X.size(), shape.values.size());
        std::array<dealii::Tensor<1, dim>, dim - 1> t;
        for (unsigned int a = 0; a < X.size(); ++a)
          for (unsigned int i = 0; i < dim - 1; ++i)
            t[i] += shape.gradients[a][i] * X[a];
        return t;
      }

      /// sum_a N_a x_a.
      template <int dim>
      dealii::Tensor<1, dim>
      interpolate(const LagrangePoint<dim - 1>              &shape,
                  const std::vector<dealii::Tensor<1, dim>> &x)
      {
        AssertDimension(x.size(), shape.values.size());
        dealii::Tensor<1, dim> sum;
        for (unsigned int a = 0; a < x.size(); ++a)
          sum += shape.values[a] * x[a];
        return sum;
      }

      /// m = (t_y, -t_x): outer normal times dA / d xi.
      dealii::Tensor<1, 2>
      area_vector(const std::array<dealii::Tensor<1, 2>, 1> &t)
      {
        return cross_product_2d(t[0]);
      }

      /// m = t_1 x t_2.
      dealii::Tensor<1, 3>
      area_vector(const std::array<dealii::Tensor<1, 3>, 2> &t)
      {
        return cross_product_3d(t[0], t[1]);
      }

      /// m' along tangents V_,i.
      dealii::Tensor<1, 2>
      area_vector_derivative(const std::array<dealii::Tensor<1, 2>, 1> &,
                             const std::array<dealii::Tensor<1, 2>, 1> &v)
      {
        return cross_product_2d(v[0]);
      }

      dealii::Tensor<1, 3>
      area_vector_derivative(const std::array<dealii::Tensor<1, 3>, 2> &t,
                             const std::array<dealii::Tensor<1, 3>, 2> &v)
      {
        return cross_product_3d(v[0], t[1]) + cross_product_3d(t[0], v[1]);
      }

      /// d/dt_i (c . m) for a fixed vector c.
      std::array<dealii::Tensor<1, 2>, 1>
      area_vector_transpose(const std::array<dealii::Tensor<1, 2>, 1> &,
                            const dealii::Tensor<1, 2> &c)
      {
        return {{-cross_product_2d(c)}};
      }

      std::array<dealii::Tensor<1, 3>, 2>
      area_vector_transpose(const std::array<dealii::Tensor<1, 3>, 2> &t,
                            const dealii::Tensor<1, 3>                &c)
      {
        return {{cross_product_3d(t[1], c), cross_product_3d(c, t[0])}};
      }
    } // namespace

    template <int dim>
    FaceLoad<dim>::FaceLoad(const unsigned int        degree,
                            const mesh::Idealization &idealization)
      : idealization(idealization)
      , gauss(lagrange_gauss_points<dim - 1>(degree))
    {
      Assert(degree == 1 || degree == 2,
             dealii::ExcMessage("Faces have degree 1 or 2."));
    }

    template <int dim>
    void
    FaceLoad<dim>::force(const Nodes                  &X,
                         const double                  pressure,
                         const dealii::Tensor<1, dim> &traction,
                         Nodes                        &f) const
    {
      f.assign(X.size(), {});
      for (const auto &shape : gauss)
        {
          const auto   m    = area_vector(tangents<dim>(shape, X));
          const auto   load = m.norm() * traction - pressure * m;
          const double weight =
            shape.weight * idealization.weight(interpolate<dim>(shape, X));
          for (unsigned int a = 0; a < X.size(); ++a)
            f[a] += weight * shape.values[a] * load;
        }
    }

    template <int dim>
    void
    FaceLoad<dim>::force_derivative(const Nodes                  &X,
                                    const Nodes                  &V,
                                    const double                  pressure,
                                    const dealii::Tensor<1, dim> &traction,
                                    Nodes                        &f) const
    {
      const auto weight_gradient = idealization.weight_gradient<dim>();
      f.assign(X.size(), {});
      for (const auto &shape : gauss)
        {
          const auto t = tangents<dim>(shape, X);
          const auto m = area_vector(t);
          const auto m_derivative =
            area_vector_derivative(t, tangents<dim>(shape, V));
          const auto load = m.norm() * traction - pressure * m;
          const auto load_derivative =
            (m * m_derivative) / m.norm() * traction - pressure * m_derivative;
          const double weight = idealization.weight(interpolate<dim>(shape, X));
          const double weight_derivative =
            weight_gradient * interpolate<dim>(shape, V);
          for (unsigned int a = 0; a < X.size(); ++a)
            f[a] += shape.weight * shape.values[a] *
                    (weight * load_derivative + weight_derivative * load);
        }
    }

    template <int dim>
    void
    FaceLoad<dim>::add_force_gradient(const Nodes                  &X,
                                      const double                  pressure,
                                      const dealii::Tensor<1, dim> &traction,
                                      const Nodes                  &u,
                                      const double                  factor,
                                      Nodes &gradient) const
    {
      AssertDimension(u.size(), X.size());
      AssertDimension(gradient.size(), X.size());
      for (const auto &shape : gauss)
        {
          const auto displacement = interpolate<dim>(shape, u);
          const auto t            = tangents<dim>(shape, X);
          const auto m            = area_vector(t);
          const auto gradient_m =
            (displacement * traction) / m.norm() * m - pressure * displacement;
          const auto gradient_t = area_vector_transpose(t, gradient_m);
          const auto gradient_x =
            ((m.norm() * traction - pressure * m) * displacement) *
            idealization.weight_gradient<dim>();
          const double weight = idealization.weight(interpolate<dim>(shape, X));
          for (unsigned int a = 0; a < X.size(); ++a)
            {
              gradient[a] +=
                factor * shape.weight * shape.values[a] * gradient_x;
              for (unsigned int i = 0; i < dim - 1; ++i)
                gradient[a] += factor * shape.weight * weight *
                               shape.gradients[a][i] * gradient_t[i];
            }
        }
    }

    template <int dim>
    std::vector<double>
    FaceLoad<dim>::areas(const Nodes &X) const
    {
      std::vector<double> areas(X.size());
      for (const auto &shape : gauss)
        {
          const double dA = shape.weight *
                            idealization.weight(interpolate<dim>(shape, X)) *
                            area_vector(tangents<dim>(shape, X)).norm();
          for (unsigned int a = 0; a < X.size(); ++a)
            areas[a] += shape.values[a] * dA;
        }
      return areas;
    }

    template class FaceLoad<2>;
    template class FaceLoad<3>;
  } // namespace elasticity
} // namespace snug
