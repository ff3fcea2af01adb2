#include <snug/contact/tributary.h>

#include <deal.II/base/quadrature_lib.h>

namespace snug
{
  namespace contact
  {
    template <int dim>
    std::vector<double>
    tributary_areas(const mesh::Surface<dim>                 &surface,
                    const std::vector<unsigned int>          &faces,
                    const FaceShape<dim>                     &shape,
                    const typename mesh::Surface<dim>::Field &positions)
    {
      const dealii::QGauss<dim - 1>   quadrature(shape.degree() + 2);
      typename FaceShape<dim>::Values values;
      std::vector<double>             share(surface.n_nodes(), 0.);
      for (const unsigned int f : faces)
        {
          const auto &nodes = surface.faces()[f].nodes;
          for (unsigned int q = 0; q < quadrature.size(); ++q)
            {
              shape.evaluate(quadrature.point(q), values);
              dealii::Tensor<1, dim> x;
              for (unsigned int k = 0; k < nodes.size(); ++k)
                x += values.value[k] * positions[nodes[k]];
              const double area =
                quadrature.weight(q) * surface.idealization().weight(x) *
                area_vector(tangents<dim>(values, nodes, positions)).norm();
              for (unsigned int k = 0; k < nodes.size(); ++k)
                share[nodes[k]] += values.value[k] * area;
            }
        }
      for (unsigned int node = 0; node < share.size(); ++node)
        for (const auto &master : surface.masters(node))
          share[master.first] += master.second * share[node];
      return share;
    }

    template std::vector<double>
    tributary_areas(const mesh::Surface<2> &,
                    const std::vector<unsigned int> &,
                    const FaceShape<2> &,
                    const mesh::Surface<2>::Field &);
    template std::vector<double>
    tributary_areas(const mesh::Surface<3> &,
                    const std::vector<unsigned int> &,
                    const FaceShape<3> &,
                    const mesh::Surface<3>::Field &);
  } // namespace contact
} // namespace snug
