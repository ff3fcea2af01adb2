#include <snug/elasticity/cell_point.h>
#include <snug/elasticity/element.h>
#include <snug/elasticity/stress.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace snug
{
  namespace elasticity
  {
    template <int dim>
    Element<dim>::Element(const unsigned int degree)
      : degree(degree)
      , gauss(lagrange_gauss_points<dim>(degree))
      , nodes(lagrange_nodes<dim>(degree))
    {
      Assert(degree == 1 || degree == 2,
             dealii::ExcMessage("Elements have degree 1 or 2."));
      const unsigned int n_padded = (n_nodes() + 3) / 4 * 4;
      for (const auto &shape : gauss)
        for (unsigned int d = 0; d < dim; ++d)
          for (unsigned int a = 0; a < n_padded; ++a)
            reference_gradients.push_back(a < n_nodes() ? shape.gradients[a][d]
                                                        : 0.);
    }

    template <int dim>
    unsigned int
    Element<dim>::n_nodes() const
    {
      return nodes.size();
    }

    template <int dim>
    void
    Element<dim>::internal_force(const Nodes    &X,
                                 const Material &material,
                                 const Nodes    &u,
                                 Nodes          &r) const
    {
      r.assign(n_nodes(), {});
      for (const auto &shape : gauss)
        {
          const CellPoint<dim> point(shape, X);
          const auto           force =
            point.dV * cauchy_stress(material, point.gradient(u));
          for (unsigned int a = 0; a < n_nodes(); ++a)
            r[a] += force * point.gradients[a];
        }
    }

    template <int dim>
    void
    Element<dim>::body_force(const Nodes                  &X,
                             const dealii::Tensor<1, dim> &b,
                             Nodes                        &f) const
    {
      f.assign(n_nodes(), {});
      for (const auto &shape : gauss)
        {
          const double dV = shape.weight * determinant(jacobian(shape, X));
          for (unsigned int a = 0; a < n_nodes(); ++a)
            f[a] += dV * shape.values[a] * b;
        }
    }

    template <int dim>
    double
    Element<dim>::volume(const Nodes &X) const
    {
      double sum = 0.;
      for (const auto &shape : gauss)
        sum += shape.weight * determinant(jacobian(shape, X));
      return sum;
    }

    template <int dim>
    dealii::SymmetricTensor<2, dim>
    Element<dim>::stress(const Nodes              &X,
                         const Material           &material,
                         const Nodes              &u,
                         const dealii::Point<dim> &point,
                         double                   &out_of_plane) const
    {
      const auto           shape = lagrange_point<dim>(degree, point);
      const CellPoint<dim> cell_point(shape, X);
      const auto           gradient = cell_point.gradient(u);
      out_of_plane = (dim == 2) ? material.lame_lambda() * trace(gradient) : 0.;
      return cauchy_stress(material, gradient);
    }

    template <int dim>
    double
    Element<dim>::quality(const Nodes &X) const
    {
      double smallest = std::numeric_limits<double>::max();
      double mean     = 0.;
      for (const auto *points : {&gauss, &nodes})
        for (const auto &shape : *points)
          {
            const double det = determinant(jacobian(shape, X));
            smallest         = std::min(smallest, det);
            mean += shape.weight * std::abs(det);
          }
      return mean > 0. ? smallest / mean : 0.;
    }

    template class Element<2>;
    template class Element<3>;
  } // namespace elasticity
} // namespace snug
