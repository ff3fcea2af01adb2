#include <snug/elasticity/cell_point.h>
#include <snug/elasticity/element.h>
#include <snug/elasticity/stress.h>

#include <deal.II/base/exceptions.h>

namespace snug
{
  namespace elasticity
  {
    template <int dim>
    void
    Element<dim>::internal_force_derivative(const Nodes    &X,
                                            const Nodes    &V,
                                            const Material &material,
                                            const Nodes    &u,
                                            Nodes          &r) const
    {
      r.assign(n_nodes(), {});
      for (const auto &shape : gauss)
        {
          const CellPoint<dim>         point(shape, X);
          const auto                   grad_V = point.gradient(V);
          const auto                   grad_u = point.gradient(u);
          const dealii::Tensor<2, dim> stress = cauchy_stress(material, grad_u);
          // derivative of (det J stress g_a) = det J (change g_a)
          const dealii::Tensor<2, dim> change =
            cauchy_stress<dim>(material, -1. * grad_u * grad_V) +
            trace(grad_V) * stress - stress * transpose(grad_V);
          for (unsigned int a = 0; a < n_nodes(); ++a)
            r[a] += point.dV * change * point.gradients[a];
        }
    }

    template <int dim>
    void
    Element<dim>::add_energy_gradient(const Nodes    &X,
                                      const Material &material,
                                      const Nodes    &u,
                                      const Nodes    &w,
                                      const double    factor,
                                      Nodes          &gradient) const
    {
      AssertDimension(gradient.size(), n_nodes());
      for (const auto &shape : gauss)
        {
          const CellPoint<dim>         point(shape, X);
          const auto                   grad_u = point.gradient(u);
          const auto                   grad_w = point.gradient(w);
          const dealii::Tensor<2, dim> stress_u =
            cauchy_stress(material, grad_u);
          const dealii::Tensor<2, dim> stress_w =
            cauchy_stress(material, grad_w);
          const dealii::Tensor<2, dim> energy_momentum =
            scalar_product(stress_u, grad_w) *
              dealii::unit_symmetric_tensor<dim>() -
            transpose(grad_w) * stress_u - transpose(grad_u) * stress_w;
          for (unsigned int a = 0; a < n_nodes(); ++a)
            gradient[a] +=
              factor * point.dV * energy_momentum * point.gradients[a];
        }
    }

    template <int dim>
    void
    Element<dim>::body_force_derivative(const Nodes                  &X,
                                        const Nodes                  &V,
                                        const dealii::Tensor<1, dim> &b,
                                        Nodes                        &f) const
    {
      f.assign(n_nodes(), {});
      for (const auto &shape : gauss)
        {
          const CellPoint<dim> point(shape, X);
          const double         change = point.dV * trace(point.gradient(V));
          for (unsigned int a = 0; a < n_nodes(); ++a)
            f[a] += change * shape.values[a] * b;
        }
    }

    template <int dim>
    void
    Element<dim>::add_body_force_gradient(const Nodes                  &X,
                                          const dealii::Tensor<1, dim> &b,
                                          const Nodes                  &u,
                                          const double                  factor,
                                          Nodes &gradient) const
    {
      AssertDimension(gradient.size(), n_nodes());
      for (const auto &shape : gauss)
        {
          const CellPoint<dim> point(shape, X);
          const double         work = factor * point.dV * (point.value(u) * b);
          for (unsigned int a = 0; a < n_nodes(); ++a)
            gradient[a] += work * point.gradients[a];
        }
    }

    template <int dim>
    void
    Element<dim>::add_volume_gradient(const Nodes &X,
                                      const double factor,
                                      Nodes       &gradient) const
    {
      AssertDimension(gradient.size(), n_nodes());
      for (const auto &shape : gauss)
        {
          const CellPoint<dim> point(shape, X);
          for (unsigned int a = 0; a < n_nodes(); ++a)
            gradient[a] += factor * point.dV * point.gradients[a];
        }
    }

    template void
    Element<2>::internal_force_derivative(const Nodes &,
                                          const Nodes &,
                                          const Material &,
                                          const Nodes &,
                                          Nodes &) const;
    template void
    Element<2>::add_energy_gradient(const Nodes &,
                                    const Material &,
                                    const Nodes &,
                                    const Nodes &,
                                    double,
                                    Nodes &) const;
    template void
    Element<2>::body_force_derivative(const Nodes &,
                                      const Nodes &,
                                      const dealii::Tensor<1, 2> &,
                                      Nodes &) const;
    template void
    Element<2>::add_body_force_gradient(const Nodes &,
                                        const dealii::Tensor<1, 2> &,
                                        const Nodes &,
                                        double,
                                        Nodes &) const;
    template void
    Element<2>::add_volume_gradient(const Nodes &, double, Nodes &) const;
    template void
    Element<3>::internal_force_derivative(const Nodes &,
                                          const Nodes &,
                                          const Material &,
                                          const Nodes &,
                                          Nodes &) const;
    template void
    Element<3>::add_energy_gradient(const Nodes &,
                                    const Material &,
                                    const Nodes &,
                                    const Nodes &,
                                    double,
                                    Nodes &) const;
    template void
    Element<3>::body_force_derivative(const Nodes &,
                                      const Nodes &,
                                      const dealii::Tensor<1, 3> &,
                                      Nodes &) const;
    template void
    Element<3>::add_body_force_gradient(const Nodes &,
                                        const dealii::Tensor<1, 3> &,
                                        const Nodes &,
                                        double,
                                        Nodes &) const;
    template void
    Element<3>::add_volume_gradient(const Nodes &, double, Nodes &) const;
  } // namespace elasticity
} // namespace snug
